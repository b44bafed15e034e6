"""The automatic rule: all constants of the thesis's model from the balloon's size and how it shall look.

The thesis gives neither units of time nor its constants; they were tuned by hand. Here they follow from what
an artist knows, in this order:

- lengths (re, the offset regions, gamma) are the experiment's, scaled with the balloon's radius;
- ks, kd and alpha are as stiff and as damped as the time step bears, so that nothing rings and nothing
drifts;
- beta stops a particle just before the wall against all its neighbours behind it;
- the push of the air on the rubber and the springs' natural lengths follow from the wanted swelling and
tension: a net of that tension carries just that push when the balloon has swollen as wanted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.capsule_mesh import EXPERIMENT_RADIUS
from balloon_usd.plan.particles import experiment_spacing
from balloon_usd.solver.kernels.kosaka.offset_regions import REACHES_OVER

if TYPE_CHECKING:
    from balloon_usd.recipe.kosaka import Kosaka

SUBSTEPS = 6
"""Substeps in a frame at 24 frames per second."""

RE, AIR_OFFSET, LEAK_OFFSET = 0.010, 0.010, 0.010
"""The thesis's lengths for its capsule, m (Kosaka 2008, 4.1)."""
CONTACT_OFFSET = 0.002 / 0.0050
"""The thesis's thickness of the contact region, in widths of a face round its capsule: a coarser net needs a
thicker one.
"""
GAMMA = 0.3
"""Way back of a leaked particle, in thicknesses of the inner offset region."""
SPRING_STEP = 0.1
"""Stiffness of the springs in units of one over the squared time step: unstable above 0.6."""
SPRING_DAMPING = 0.1
"""Damping of the springs in units of one over the time step."""
CALMING = 0.15
"""Damping across the springs in units of one over the time step; the thesis has none, and its net trembles.
"""
AIR_STEP = 0.005
"""Repulsion in units of one over the squared time step."""
BETA = 1.5
"""Push on a particle at the wall, in the repulsion of all evenly spread ones behind it."""
GRADING = 1.0
"""How far the push fades with depth in the offset region; 0 is the thesis's."""
GRADED_AWAY = 0.6
"""Mean share of the push that grading takes away: the integral of 1 - (1 - s)^3 (1 + 3 s) over the region."""
NATURAL = 0.5
"""Natural length of the springs round the balloon, in their length at rest: below one they stay taut in a
neck.
"""
KEPT_OFF = 0.735
"""Share of the push that arrives: a push on the air stronger than its repulsion keeps it off the wall a
little (measured on the experiment's capsule).
"""
DRAG = 12.0
"""Drag on air, 1/s: the thesis has none, and its air never comes to rest. Real air weighs nearly nothing."""
RUBBER_DRAG = 10.0
"""Drag on the rubber, 1/s; not in the thesis."""
PINCH_LIMIT = 0.5
"""Largest external force, in radii of the balloon per squared time step."""
ELONGATION_LIMIT = 2.0
"""Largest elongation of a spring, in its length at rest."""
FASTEST_AIR = 0.4
"""Farthest that an air particle moves in one step, in re: it must not jump over the offset regions."""
MARGIN = 0.25
"""Margin (skin) of the neighbour lists, in re."""


@dataclass(frozen=True)
class Parameters:
    """All constants of one balloon, after the rule or as the recipe sets them."""

    ks: float
    """1/s2 (eq. 3.1)"""
    kd: float
    """1/s (eq. 3.1)"""
    alpha: float
    """1/s2 (eq. 3.4)"""
    beta: float
    """m/s2 (eq. 3.12)"""
    push: float | None
    """m/s2 (eq. 3.10); None follows from the swelling."""
    gamma: float
    """m (eq. 3.13)"""
    re: float
    """m (eq. 3.3)"""
    air_offset: float
    """m"""
    contact_offset: float
    """m"""
    leak_offset: float
    """m"""
    spacing: float
    """Distance of neighbouring particles once spread, m."""
    natural: float
    """Natural length of springs round the balloon, as a share of their length at rest."""
    swell: float
    """How much thicker the air makes the balloon, as a share."""
    calming: float
    """1/s"""
    grading: float
    """How far the push fades with depth, 0 to 1."""
    drag: float
    """1/s"""
    force_limit: float
    """m/s2"""
    elongation_limit: float
    """As a share of the natural length."""

    @property
    def density(self) -> float:
        """Particles per volume once spread, 1/m3."""
        return self.spacing**-3


def parameters(given: Kosaka, radius: float, width: float, dt: float) -> Parameters:
    """Return the constants of one balloon: the recipe's own, and the rule's where it has none.

    Args:
        given: what the recipe sets.
        radius: of the blown-up balloon (m).
        width: of a face round it (m).
        dt: time step (s).
    """
    scale = radius / EXPERIMENT_RADIUS
    spacing = given.spacing or experiment_spacing(radius)
    re = given.re or RE * scale
    alpha = _first(given.alpha, AIR_STEP / dt**2)
    natural = _first(given.natural, NATURAL)
    return Parameters(
        ks=_first(given.ks, SPRING_STEP / dt**2),
        kd=_first(given.kd, SPRING_DAMPING / dt),
        alpha=alpha,
        beta=_first(
            given.beta, BETA * wall_repulsion(alpha, re, spacing) / overlap(_first(given.grading, GRADING))
        ),
        push=given.push,
        gamma=_first(given.gamma, GAMMA * AIR_OFFSET * scale),
        re=re,
        air_offset=_first(given.air_offset, AIR_OFFSET * scale),
        contact_offset=_first(given.contact_offset, CONTACT_OFFSET * width),
        leak_offset=_first(given.leak_offset, LEAK_OFFSET * scale),
        spacing=spacing,
        natural=natural,
        swell=given.swell,
        calming=_first(given.calming, CALMING / dt),
        grading=_first(given.grading, GRADING),
        drag=_first(given.drag, DRAG),
        force_limit=_first(given.force_limit, PINCH_LIMIT * radius / dt**2),
        elongation_limit=_first(given.elongation_limit, (1.0 + ELONGATION_LIMIT) / natural - 1.0),
    )


def wall_repulsion(alpha: float, re: float, spacing: float) -> float:
    """Return the repulsion (m/s2) that a particle at a plane wall feels from a half-space of evenly spread
    ones: the integral of eq. 3.4 over the half sphere of radius re, pi alpha re^4 / (12 spacing^3).
    """
    return math.pi * alpha * re**4 / (12.0 * spacing**3)


def pressure_of_push(law: Parameters) -> float:
    """Return the acceleration of vertices per wall area (1/(m s2)) that evenly spread air gives per unit of
    its push (eq. 3.10).

    Every triangle of area A has density * A * offset particles in its region; each pushes with shares that
    add up to one, and a vertex takes the mean over its triangles (eq. 3.11): a third of the push per particle
    in one triangle, over the two triangles' areas that belong to it.
    """
    sharp = (1.0 - law.grading) * overlap(0.0)
    graded = law.grading * overlap(1.0) * (1.0 - GRADED_AWAY)
    return (sharp + graded) * law.density * law.air_offset / 6.0


def overlap(grading: float) -> float:
    """Return how many triangles' regions a particle beside a plane wall counts in, on average.

    Each reaches W beyond its triangle, in barycentric shares: sharp regions cover (1 + 3 W)^2 times the wall;
    regions that fade sideways over that, for W above a third, (1 + 3 W)^3 / (18 W) times.
    """
    reach = 1.0 + 3.0 * REACHES_OVER
    return (1.0 - grading) * reach**2 + grading * reach**3 / (18.0 * REACHES_OVER)


def _first(given: float | None, rule: float) -> float:
    return rule if given is None else given
