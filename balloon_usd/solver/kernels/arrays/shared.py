"""Device arrays of every model: meshes, joints, hands, contacts, checks and the state itself.

"Joint" is any ring that hands can hold or close, whether or not it parts two segments. Indices count over all
balloons of all sculptures. Vectors of `contact_force` lie as `device.soa` says.
"""

import warp as wp

from balloon_usd.plan.welding import MOST_WELDED
from balloon_usd.solver.kernels.arrays.rows import TARGETS, Axes, Finger, Spin
from balloon_usd.solver.kernels.arrays.table import array, array_struct
from balloon_usd.solver.kernels.device.chunk_rows import CHUNK_QUADS, REACH_ROWS


@array_struct
class Sculptures:
    """Where every sculpture begins among the balloons, vertices and so on of all."""

    world_balloon: wp.array[int] = array("sculpture starts", meaning="first balloon")
    world_vertex: wp.array[int] = array("sculpture starts", meaning="first vertex")
    world_quad: wp.array[int] = array("sculpture starts", meaning="first quad")
    world_chunk: wp.array[int] = array("sculpture starts", meaning="first chunk")
    world_segment: wp.array[int] = array("sculpture starts", meaning="first segment")
    world_joint: wp.array[int] = array("sculpture starts", meaning="first joint")
    world_block: wp.array[int] = array("sculpture starts", meaning="first block of a GPU that advances it")
    world_welds: wp.array[int] = array("sculptures", meaning="number of welds")
    world_guests: wp.array[int] = array("sculptures", meaning="number of balloons that lie in others")
    middle: wp.array[wp.vec3] = array("sculptures", unit="m", meaning="scratch: middle of mass")
    velocity: wp.array[wp.vec3] = array("sculptures", unit="m/s", meaning="scratch: of that")
    spin: wp.array[wp.vec3] = array("sculptures", unit="rad/s", meaning="scratch: angular velocity")
    barrier_counts: wp.array[int] = array("sculptures", meaning="blocks that came to a barrier so far")
    barrier_rounds: wp.array[int] = array("sculptures", meaning="times that threads of a CPU have met")


@array_struct
class Mesh:
    """Quads, their vertices, and the rings, segments and chunks that they form."""

    quads: wp.array[wp.vec4i] = array("quads", meaning="its four vertices, counter-clockwise from outside")
    quad_segment: wp.array[int] = array("quads", meaning="its segment")
    quad_balloon: wp.array[int] = array("quads", meaning="its balloon")
    quad_host: wp.array[int] = array("quads", meaning="balloon in which its own lies; -1 for none")
    quad_world: wp.array[int] = array("quads", meaning="its sculpture")
    quad_ring: wp.array[int] = array("quads", meaning="ring of its first vertex")
    quad_neck: wp.array[int] = array(
        "quads", meaning="joint in whose neck it lies, one for all that are meant to join; -1 for none"
    )
    quad_place: wp.array[wp.vec3] = array("quads", unit="m", meaning="unstressed place of its middle")
    quad_outward: wp.array[wp.vec3] = array(
        "quads", meaning="its unstressed outward direction; 0: its inside never meets itself"
    )
    corners: wp.array[wp.vec4i] = array(
        "corner rows",
        meaning="4 quad + corner of each quad at a vertex; -1: none; -2 - row in the fourth: goes on there",
    )
    vertex_balloon: wp.array[int] = array("vertices", meaning="its balloon")
    vertex_segment: wp.array[int] = array("vertices", meaning="its segment; -1 on a ring between two")
    vertex_joint: wp.array[int] = array("vertices", meaning="the joint that moves it; -1 for none")
    vertex_ring: wp.array[int] = array("vertices", meaning="its ring")
    vertex_neck: wp.array[int] = array(
        "vertices", meaning="joint in whose neck it lies, one for all that are meant to join; -1 for none"
    )
    vertex_place: wp.array[wp.vec3] = array("vertices", unit="m", meaning="its unstressed place")
    vertex_outward: wp.array[wp.vec3] = array("vertices", meaning="its unstressed outward direction, or 0")
    mass: wp.array[float] = array(
        "vertices", unit="kg", meaning="its mass, scaled where the time step asks it"
    )
    ring_first: wp.array[int] = array("rings", meaning="first vertex")
    ring_around: wp.array[int] = array("rings", meaning="number of vertices")
    ring_cos_sin: wp.array[wp.vec2] = array("vertices", meaning="cosine and sine of its place round its ring")
    segment_quad: wp.array[int] = array("segments", meaning="first quad")
    segment_quad_end: wp.array[int] = array("segments", meaning="end of its quads")
    segment_origin: wp.array[int] = array("segments", meaning="a vertex of it, near which volumes are summed")
    segment_chunk: wp.array[int] = array("segment starts", meaning="first chunk")
    start_joint: wp.array[int] = array("segments", meaning="joint that parts it from the last; -1 for none")
    end_joint: wp.array[int] = array("segments", meaning="joint that parts it from the next; -1 for none")
    chunk_quad: wp.array[int] = array("chunk starts", meaning="first of its at most 32 quads")
    chunk_origin: wp.array[int] = array("chunks", meaning="the origin of its segment")


@array_struct
class Balloons:
    """What differs between balloons."""

    balloon_world: wp.array[int] = array("balloons", meaning="its sculpture")
    balloon_host: wp.array[int] = array("balloons", meaning="balloon in which it lies; -1 for none")
    balloon_nested: wp.array[int] = array("balloons", meaning="1 where it lies in another, or another in it")
    balloon_radius: wp.array[float] = array("balloons", unit="m", meaning="unstressed radius")
    gravity: wp.array[wp.vec3] = array("balloons", unit="m/s2", meaning="pull of gravity")
    drag: wp.array[float] = array("balloons", unit="1/s", meaning="drag of the air")
    packed_drag: wp.array[float] = array(
        "balloons", unit="1/s", meaning="drag on rubber that is folded up in a neck, besides"
    )
    friction: wp.array[float] = array("balloons", meaning="Coulomb friction")
    contact_offset: wp.array[float] = array(
        "balloons", unit="m", meaning="distance at which its walls begin to press"
    )
    contact_arc: wp.array[float] = array(
        "balloons", unit="1/m", meaning="growth of that distance with the area of the face that is touched"
    )
    touching: wp.array[int] = array("balloons", meaning="1: its walls may touch anything; 2: what they touch")


@array_struct
class Joints:
    """Rings that hands can hold or close."""

    joint_first: wp.array[int] = array("joints", meaning="first vertex")
    joint_around: wp.array[int] = array("joints", meaning="number of vertices")
    joint_parts: wp.array[int] = array("joints", meaning="1 where it parts two segments")
    joint_beside: wp.array[wp.vec2i] = array("joints", meaning="segments before and after it")
    joint_carried: wp.array[int] = array("joints", meaning="vertices before its first that move with it")
    joint_mass: wp.array[float] = array("joints", unit="kg", meaning="mass of its vertices")
    ring_middle: wp.array[wp.vec3] = array("joints", unit="m", meaning="middle of its vertices")
    ring_area: wp.array[wp.vec3] = array("joints", unit="m2", meaning="vector area of the fan that closes it")
    ring_axes: wp.array[Axes] = array("joints", meaning="its in-plane axes")
    ring_velocity: wp.array[wp.vec3] = array("joints", unit="m/s", meaning="velocity of its middle")


@array_struct
class Welds:
    """Joints that are twisted into one."""

    joint_weld: wp.array[int] = array("joints", meaning="its weld + 1; 0 for none")
    joint_leader: wp.array[int] = array("joints", meaning="first joint of its weld; itself if in none")
    weld_joint: wp.array2d[int] = array("welds", MOST_WELDED, meaning="its joints")
    weld_size: wp.array[int] = array("welds", meaning="number of joints")
    weld_reach: wp.array[float] = array("welds", unit="m", meaning="largest distance of two joints")
    weld_gap: wp.array[float] = array("welds", unit="m", meaning="least distance of two joints")
    weld_shift: wp.array[wp.vec3] = array(
        "joints", unit="m", meaning="how far its weld has just moved a joint"
    )


@array_struct
class Hands:
    """What hands do in a frame."""

    hand: wp.array[int] = array("joints", meaning="mode: 0 free, or one of `joints`")
    hand_from: wp.array[wp.vec3] = array("joints", unit="m", meaning="where it is at the start of the frame")
    hand_to: wp.array[wp.vec3] = array("joints", unit="m", meaning="where it is at the end of the frame")
    hand_free: wp.array[wp.vec3] = array(
        "joints", meaning="unit direction in which it does not hold; 0: none"
    )
    hand_force: wp.array[float] = array("joints", unit="N", meaning="largest force of a leading hand")
    hand_stiffness: wp.array[float] = array("joints", unit="N/m", meaning="stiffness of a leading hand")
    hand_load: wp.array[wp.vec3] = array("joints", unit="N", meaning="force that the hand feels")
    radius_from: wp.array[float] = array("joints", unit="m", meaning="radius at the start; 0: not closed")
    radius_to: wp.array[float] = array(
        "joints", unit="m", meaning="radius at the end of the frame; 0: not closed"
    )
    spins: wp.array[Spin] = array("spins", unit="SI", meaning="a turn of some vertices")
    vertex_spin: wp.array[int] = array("vertices", meaning="the spin that turns it + 1; 0 for none")
    leading: wp.array[float] = array(
        "balloons", unit="m/s", meaning="speed at which its walls are led out of others"
    )
    floating: wp.array[int] = array(
        "balloons", meaning="1 where nothing outside acts on its sculpture, which so has no momentum"
    )
    fingers: wp.array[Finger] = array("balloons", unit="SI", meaning="a finger that presses on its wall")
    finger_share: wp.array[float] = array("vertices", meaning="share of the finger's force")
    finger_slip: wp.array[wp.vec3] = array(
        "vertices", unit="m", meaning="deflection of its friction on a round fingertip"
    )
    finger_push: wp.array[wp.vec3] = array("vertices", unit="m/s", meaning="velocity that the hand gives it")


@array_struct
class Contacts:
    """Walls that touch, and the surface as it was when they were searched for."""

    watched: wp.array[int] = array(
        "sculptures", meaning="frames for which its walls are still kept apart at every search; 0: none"
    )
    crossed: wp.array[int] = array(
        "vertices", meaning="1 where its wall crosses another all the same, and where nothing keeps it apart"
    )
    normal: wp.array[wp.vec3] = array("vertices", meaning="outward unit normal")
    area: wp.array[float] = array("vertices", unit="m2", meaning="share of the wall's area")
    quad_middle: wp.array[wp.vec3] = array("quads", unit="m", meaning="its middle")
    quad_area: wp.array[wp.vec3] = array("quads", unit="m2", meaning="its vector area, outward")
    quad_velocity: wp.array[wp.vec3] = array("quads", unit="m/s", meaning="velocity of its middle")
    reach_rows: wp.array2d[float] = array(
        "chunks",
        REACH_ROWS * CHUNK_QUADS,
        unit="m",
        meaning="middles of its quads, and how far beside and how high above these they may be touched",
    )
    chunk_low: wp.array[wp.vec3] = array(
        "chunks", unit="m", meaning="lowest coordinates of what its quads reach"
    )
    chunk_high: wp.array[wp.vec3] = array("chunks", unit="m", meaning="highest coordinates of that")
    group_low: wp.array[wp.vec3] = array(
        "chunks", unit="m", meaning="lowest coordinates of what 16 chunks reach, by their group; on a CPU"
    )
    group_high: wp.array[wp.vec3] = array("chunks", unit="m", meaning="highest coordinates of that")
    ring_radius: wp.array[float] = array("rings", unit="m", meaning="girth over 2 pi")
    vertex_own: wp.array[wp.vec2i] = array("vertices", meaning="run of quads about it that it never touches")
    target: wp.array2d[int] = array("vertices", TARGETS, meaning="quads that it may touch; -1 for none")
    slip: wp.array2d[wp.vec3] = array(
        "vertices", TARGETS, unit="m", meaning="deflection of its friction on them"
    )
    contact_force: wp.array2d[float] = array(3 * TARGETS, "vertices", unit="N", meaning="force of them on it")
    contact_place: wp.array[wp.vec2] = array("contacts", meaning="where on the quad, -1/2 to 1/2")
    hit_count: wp.array[int] = array("quads", meaning="contacts on it")
    hit_first: wp.array[int] = array("quads", meaning="the first of these in `hits`")
    hits: wp.array[int] = array("contacts", meaning="contacts by quad: 2 vertex + target")
    hit_last: wp.array[int] = array("quads", meaning="contact that was entered last; -1 for none")
    hit_before: wp.array[int] = array("contacts", meaning="the one entered before it on its quad; -1: none")
    listed_count: wp.array[int] = array("sculptures", meaning="contacts in `hits`")
    pair_count: wp.array[int] = array("sculptures", meaning="contacts")
    pairs: wp.array[int] = array("contacts", meaning="contacts of each sculpture, from 2 of its first vertex")
    pressed_count: wp.array[int] = array("sculptures", meaning="quads that are touched")
    pressed: wp.array[int] = array("quads", meaning="these of each sculpture, from its first quad")


@array_struct
class Checks:
    """What is looked at after every frame."""

    stretch: wp.array[float] = array("vertices", meaning="largest principal stretch of the wall")
    stretch_limit: wp.array[float] = array("balloons", meaning="stretch above which something is wrong")
    x_checked: wp.array[wp.vec3] = array("vertices", unit="m", meaning="where it was at the last check")
    suspects: wp.array[int] = array("sculptures", meaning="1 where something may be wrong")


@array_struct
class State:
    """Positions and velocities."""

    x: wp.array[wp.vec3] = array("vertices", unit="m", meaning="its position")
    v: wp.array[wp.vec3] = array("vertices", unit="m/s", meaning="its velocity")
    slowness: wp.array[float] = array(
        "vertices", unit="s/m", meaning="inverse of its largest speed, where walls would cross; 0: none"
    )
    reaction: wp.array[wp.vec3] = array(
        "vertices", unit="N", meaning="force of walls that it would cross, until it does not"
    )
    x_next: wp.array[wp.vec3] = array("vertices", unit="m", meaning="scratch: its next position")
    volume: wp.array[float] = array("segments", unit="m3", meaning="its volume")
