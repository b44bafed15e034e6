"""Elements of device arrays that have several numbers each, and how many slots some arrays have."""

import warp as wp

TARGETS = 2
"""Walls that one vertex may touch at a time."""
STRUT_SLOTS = 24
"""Struts that may end at one joint of any scene; nets of many bubbles have more."""
SPINS = 8
"""Sets of vertices that may turn at a time, for each sculpture of a scene."""

Axes = wp.types.matrix(shape=(3, 2), dtype=float)
"""The two in-plane unit axes of a ring, as columns."""

CurveSegment = wp.types.matrix(shape=(2, 4), dtype=float)
"""One cubic of a spline, of stress and of energy: coefficients of the powers of the share of the way from its
spline knot to the next.
"""


@wp.struct
class Finger:
    """One finger on one balloon; `start` and `end` are where its tip is at both ends of the frame."""

    start: wp.vec3
    """m"""
    end: wp.vec3
    """m"""
    along: wp.vec3
    """Unit direction in which it presses."""
    load_start: float
    """Force at the start of the frame besides what depth asks for, N."""
    load_end: float
    """The same at its end, N."""
    stiff: float
    """Stiffness per touched vertex behind the tip, in vertex masses per squared time step; 0 for force alone.
    """
    radius: float
    """Radius of a round tip that pushes what is inside it, m; 0 where it presses on a patch of vertices."""
    flat: int
    """1 where a disc of that radius presses, the palm of a hand, and the other comes towards it; else 0."""
    velocity: wp.vec3
    """Velocity of a round tip, m/s."""
    palm: wp.vec3
    """Middle of the palm that lies against the far side, across the finger, at the start of the frame, m."""
    segment: int
    """Segment that a round tip and the palm touch; they pass through all others."""


@wp.struct
class Spin:
    """A rigid turn of some vertices about an axis through a point."""

    point: wp.vec3
    """The point, m."""
    axis: wp.vec3
    """Unit axis."""
    rate: float
    """Angular velocity, rad/s."""
    drift: wp.vec3
    """Velocity besides, m/s."""
    free: int
    """1 where they turn freely and are only displaced: their momentum stays as it is."""


@wp.struct
class Law:
    """One rubber: its curve and a Gent term, softening, and the numerical guards that go with them."""

    first_segment: int
    """First segment of the curve of its Ogden terms."""
    last_segment: int
    """Its last segment."""
    zero_segment: int
    """Segment that the bits of a squared stretch count from."""
    step_bits: int
    """Bits of a squared stretch that lie within a segment."""
    step_share: float
    """One of what these bits count, as a share of the segment."""
    most: float
    """Squared stretch at which the law is continued by its value, so that locking stays below a few times
    the rest stiffness.
    """
    gent_mu: float
    """Modulus of the Gent term, Pa; 0 leaves it out."""
    gent_limit: float
    """Gent's Jm: the largest I1 - 3."""
    soft_depth: float
    """1/r of Ogden & Roxburgh 1999; 0 switches softening off."""
    soft_steepness: float
    """1/c of Ogden & Roxburgh 1999."""
    viscosity: float
    """Resistance to the rate of strain, Pa s."""
    hourglass_damping: float
    """Damping of the hourglass mode per stiffness, s."""


@wp.struct
class Constants:
    """Constants of springs and air particles of one balloon; forces are accelerations, as of unit mass."""

    ks: float
    """Stiffness of the springs, 1/s2 (eq. 3.1)."""
    kd: float
    """Damping of the springs, 1/s (eq. 3.1)."""
    alpha: float
    """Repulsion of air particles, 1/s2 (eq. 3.4)."""
    beta: float
    """Push of the rubber on an air particle, m/s2 (eq. 3.12)."""
    push: float
    """Push of an air particle on the rubber, m/s2: the unit of eq. 3.10."""
    gamma: float
    """How far a leaked air particle is moved back, m (eq. 3.13)."""
    re: float
    """Reach of the repulsion, m (eq. 3.3)."""
    air_offset: float
    """Thickness of the inner offset region, for air and rubber, m."""
    contact_offset: float
    """Thickness of the offset region for rubber and rubber, m."""
    leak_offset: float
    """Thickness of the outer offset region, for leaked air, m."""
    calming: float
    """Damping of what the two ends of a spring move across it, 1/s; not in the thesis."""
    grading: float
    """How far the push of eqs. 3.10 and 3.12 fades with depth: 0 not at all, as in the thesis, 1 to nothing.
    """
    drag: float
    """Drag on air, 1/s; not in the thesis."""
    force_limit: float
    """Largest external force, m/s2."""
    elongation_limit: float
    """Largest elongation of a spring, in natural lengths."""
    air_speed: float
    """Largest speed of an air particle, m/s: it must not outrun the search."""


@wp.struct
class Drift:
    """The motion of one cluster: that of its ends, and evenly from one to the other between them."""

    start: wp.vec3
    """m"""
    end: wp.vec3
    """m"""
    start_speed: wp.vec3
    """m/s"""
    end_speed: wp.vec3
    """m/s"""
    start_inward: wp.vec3
    """Unit direction from a frozen joint at its start into the bubble; 0 where there is none."""
    end_inward: wp.vec3
    """The same of its end."""
    neck: float
    """Radius of its necks, m."""
    start_gain: wp.vec3
    """m/s2"""
    end_gain: wp.vec3
    """m/s2"""
    joints: wp.vec2i
    """Its frozen joints; -1 for none."""


@wp.struct
class Touch:
    """How walls press on each other."""

    pressure: float
    """Least contact pressure where the distance at which walls press is used up, Pa."""
    margin: float
    """Further distance within which walls are watched between two searches, m."""
    ahead: float
    """Time for which a wall that moves is watched farther, s: that between two searches."""
    apart: float
    """Unstressed distance within one bubble, in R0, within which its wall never meets itself."""
    across: float
    """Unstressed distance along a bubble, in R0, within which the inside of its wall may meet itself."""


@wp.struct
class Air:
    """The gas around and inside."""

    atmosphere: float
    """Ambient pressure, Pa."""
    molar_energy: wp.float64
    """R T, J/mol."""
    density: float
    """Density, kg/m3."""
    discharge: float
    """Discharge coefficient of a neck."""
    equalise: float
    """Largest share of a pressure difference that a neck may even out in one substep."""
