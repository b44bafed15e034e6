"""Device arrays of the latex model: rubber, chambers of gas, struts, packing cores, forces and crossings.

Vectors of `corner_force` and `volume_gradient` lie as `device.soa` says.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import CurveSegment, Law
from balloon_usd.solver.kernels.arrays.table import array, array_struct
from balloon_usd.solver.kernels.device.chunk_rows import CHUNK_QUADS, SPHERE_ROWS


@array_struct
class Rubber:
    """The wall: its rest state, its law and what it remembers."""

    quad_law: wp.array[int] = array("quads", meaning="its rubber")
    rest_inverse: wp.array[wp.mat22] = array("quads", unit="1/m", meaning="inverse of its edges at rest")
    hourglass: wp.array[wp.vec4] = array("quads", unit="N^1/2/m^1/2", meaning="its hourglass vector")
    rubber_volume: wp.array[float] = array("quads", unit="m3", meaning="volume of its rubber")
    quad_length: wp.array[float] = array("quads", meaning="rest length of its segment that it is made for")
    peak_energy: wp.array[float] = array(
        "quads", unit="J/m3", meaning="largest energy that it has noted so far"
    )
    laws: wp.array[Law] = array("balloons", unit="SI", meaning="its rubber")
    curves: wp.array[CurveSegment] = array(
        "curve segments", unit="Pa, J/m3", meaning="cubics of the Ogden sums"
    )
    softening_rate: wp.array[float] = array("balloons", meaning="share of a new peak noted in one substep")
    true_mass: wp.array[float] = array("vertices", unit="kg", meaning="mass of its rubber, for gravity")


@array_struct
class Chambers:
    """Gas: segments whose common neck is fully open form one chamber, called by its last segment. Gas flows
    along edges, each a neck between two segments of a balloon.
    """

    balloon_segment: wp.array[int] = array("balloons", meaning="first segment")
    balloon_segment_end: wp.array[int] = array("balloons", meaning="end of its segments")
    inlet: wp.array[int] = array("balloons", meaning="segment into which it is pumped")
    chamber_first: wp.array[int] = array("segments", meaning="first segment of its chamber")
    chamber_last: wp.array[int] = array("segments", meaning="last segment of its chamber")
    host_segment: wp.array[int] = array("segments", meaning="segment in which its balloon lies; -1 for none")
    first_guest: wp.array[int] = array("segment starts", meaning="first of the segments that lie in it")
    guests: wp.array[int] = array("guests", meaning="segments that lie in others, in the order of those")
    blowing: wp.array[int] = array("balloons", meaning="1 where gas flows through a closing neck")
    open_from: wp.array[float] = array("joints", unit="m2", meaning="open area at the start of the frame")
    open_to: wp.array[float] = array("joints", unit="m2", meaning="open area at its end")
    rest_length: wp.array[float] = array(
        "segments", meaning="its length at rest, as a share of that between two closed necks"
    )
    neck_flow: wp.array[float] = array(
        "joints", unit="mol/s", meaning="gas that a hand pushes through it, from before to behind"
    )
    pump_flow: wp.array[float] = array(
        "balloons", unit="mol/s", meaning="flow of the pump; negative: out of it"
    )
    pump_limit: wp.array[float] = array("balloons", unit="Pa", meaning="gauge pressure at which it stops")
    pump_goal: wp.array[wp.float64] = array("balloons", unit="mol", meaning="amount at which it stops")
    chunk_share: wp.array[float] = array("chunks", unit="m3", meaning="scratch: volume from its origin")
    chamber_volume: wp.array[float] = array(
        "segments", unit="m3", meaning="of the chamber that it is the last of"
    )
    balloon_edge: wp.array[int] = array("balloon starts", meaning="first edge")
    flow_from: wp.array[int] = array("flow edges", meaning="chamber that it leads from")
    flow_to: wp.array[int] = array("flow edges", meaning="chamber that it leads to; the same: no flow")
    flow_joint: wp.array[int] = array("flow edges", meaning="joint that is its neck")
    flow: wp.array[wp.float64] = array(
        "flow edges", unit="mol", meaning="scratch: gas that flows along it in a substep"
    )
    chamber_end: wp.array[int] = array(
        "segment starts", meaning="of the chamber that it is the last of: first end of an edge"
    )
    flow_ends: wp.array[int] = array(
        "flow ends", meaning="edges at each chamber in order: edge + 1, negative where it leads from there"
    )
    amount: wp.array[wp.float64] = array("segments", unit="mol", meaning="its gas")
    pressure: wp.array[float] = array("segments", unit="Pa", meaning="pressure of its gas above that outside")


@array_struct
class Struts:
    """Friction between joints of a figure: springs that yield."""

    joint_struts: wp.array2d[int] = array(
        "joints", "slots for struts", meaning="its struts + 1, negative at their second ends; 0 for none"
    )
    strut_joint: wp.array[wp.vec2i] = array("struts", meaning="joints at its ends; -1 for an unused one")
    strut_stiffness: wp.array[float] = array("struts", unit="N/m", meaning="its stiffness")
    strut_damping: wp.array[float] = array("struts", unit="N s/m", meaning="its damping")
    strut_yield: wp.array[float] = array("struts", unit="N", meaning="force beyond which it gives way")
    strut_length: wp.array[float] = array("struts", unit="m", meaning="its length at rest")
    strut_force: wp.array[wp.vec3] = array("struts", unit="N", meaning="its force on its first end")


@array_struct
class Cores:
    """Rings of balloons that pack, in order along them."""

    world_core: wp.array[int] = array("sculpture starts", meaning="first packing ring")
    core_ring: wp.array[int] = array("packing rings", meaning="its ring")
    core_next: wp.array[int] = array("packing rings", meaning="1 where the next is of the same balloon")
    core_radius: wp.array[float] = array(
        "packing rings", unit="m", meaning="radius to which its rubber packs"
    )
    core_row: wp.array[float] = array("packing rings", unit="m", meaning="unstressed distance to the next")
    core_order: wp.array[wp.vec3] = array(
        "packed vertices", unit="N", meaning="force towards its place in order"
    )
    core_push: wp.array[wp.vec3] = array("packed vertices", unit="N", meaning="force of the core on it")
    core_thrust: wp.array[wp.vec3] = array(
        "packing rings", unit="N", meaning="force on each vertex of the next"
    )


@array_struct
class Forces:
    """Forces of the wall, and those of contacts beside `Contacts`."""

    corner_force: wp.array2d[float] = array(4 * 3, "quads", unit="N", meaning="forces on its corners")
    volume_gradient: wp.array2d[float] = array(4 * 3, "quads", unit="m2", meaning="volume by its corners")
    pair_corners: wp.array[wp.vec4i] = array("contacts", meaning="vertices of the quad that is touched")
    pair_limits: wp.array[wp.vec4] = array(
        "contacts", unit="SI", meaning="stiffness, damping, friction, reach beside"
    )
    wall_load: wp.array[float] = array("segments", unit="N", meaning="normal forces of other walls on it")


@array_struct
class Crossings:
    """Walls that would go through each other, or have, and how they are kept apart."""

    x_safe: wp.array[wp.vec3] = array(
        "vertices", unit="m", meaning="where it was when walls were last kept apart"
    )
    safe_seconds: wp.array[float] = array("sculptures", unit="s", meaning="time from then to the next time")
    way_led: wp.array[wp.vec3] = array(
        "vertices", meaning="way on which it is led out of others, as long as its share in what is led"
    )
    x_apart: wp.array[wp.vec3] = array("vertices", unit="m", meaning="scratch: where it is kept apart")
    x_coming: wp.array[wp.vec3] = array("vertices", unit="m", meaning="scratch: that in the coming round")
    segment_shift: wp.array[float] = array(
        "segments", unit="m", meaning="how far its wall was led out of others in this frame, at most"
    )
    segment_jammed: wp.array[int] = array(
        "segments", meaning="1 where its wall could not be kept apart from others in this frame"
    )
    sphere_rows: wp.array2d[float] = array(
        "chunks",
        SPHERE_ROWS * CHUNK_QUADS,
        unit="m",
        meaning="middles of its quads, and how far from these their corners are at most",
    )
    restless: wp.array[int] = array("vertices", meaning="1 where it moved in the last round or would cross")
    chunk_restless: wp.array[int] = array(
        "chunks", meaning="mask of those of its quads that have a restless corner"
    )
    looked_chunks: wp.array[int] = array("chunks", meaning="scratch: those of sculptures that are looked at")
    looked_count: wp.array[int] = array(1, meaning="number of these, on a GPU")
    box_low: wp.array[wp.vec3] = array("chunks", unit="m", meaning="lowest coordinates of its quads")
    box_high: wp.array[wp.vec3] = array("chunks", unit="m", meaning="highest coordinates of its quads")
    way_back: wp.array[wp.vec4i] = array(
        "vertices",
        meaning="how it is led out of walls that it has gone through, and its share, 65536 to 1; or motions "
        "that it shares, 100 million to 1 m, and how many",
    )
    pushed: wp.array[wp.vec3i] = array(
        "vertices", meaning="mass by way on which pairs that would cross push it apart, 10^12 to 1 kg m"
    )
    smoothing: wp.array[float] = array("vertices", meaning="how much it is smoothed; 1 at a crossing")
    smoothing_next: wp.array[float] = array("vertices", meaning="scratch: that in the coming round")
    pierced_count: wp.array[int] = array("sculptures", meaning="edges found that pierce a face")
    crossed_count: wp.array[int] = array("sculptures", meaning="those that did before already")
    untangling_round: wp.array[int] = array(
        "sculptures", meaning="its round, from 1; 0: not yet; below: as `untangling` says"
    )
    put_back: wp.array[int] = array(
        "sculptures", meaning="times in a row that it was put back to where its walls were last apart"
    )
    untangling: wp.array[int] = array(1, meaning="1 while any sculpture needs another round")
    tangled: wp.array[int] = array(1, meaning="1 where walls of any sculpture still cross")
    any_watched: wp.array[int] = array(1, meaning="1 while any sculpture is watched")
