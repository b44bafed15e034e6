"""Untangling: walls that have gone through each other are led back a little, and are shown where they no
more cross: round after round they go back, and the wall about them is smoothed, more and farther around the
longer it takes.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Joints, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.physics.motion import LYING
from balloon_usd.solver.kernels.physics.piercing_walls import PER_UNIT

MOST_ROUNDS = wp.constant(96)
"""Rounds after which walls that still cross are shown as they are."""
FIRM_ROUNDS = wp.constant(40)
"""Rounds in which closed rings stay where they are: joints shall not look as if they came apart."""
FARTHEST = wp.constant(6.0)
"""How far from where it is a vertex is shown at most, in the same: about half of a bubble's radius."""
STEP = wp.constant(1.0 / 6.0)
"""How far a vertex is shown farther back in a round, in the distance at which walls begin to press."""
FAILED = wp.constant(-2)
"""Round of a sculpture whose walls still cross after the last one: it is shown as it is."""
UNDECIDED = wp.constant(1.0e-3)
"""Sum of ways, for a share of 1, below which they cancel: so a vertex goes less than a whole step."""
UNSMOOTHED_ROUNDS = wp.constant(4)
"""Rounds in which nothing is smoothed: what hardly crosses is hardly moved."""
MORE = wp.constant(0.02)
"""How much farther a vertex goes to the middle of its neighbours in every round, as a share of that way."""
MOST_SMOOTHED = wp.constant(0.5)
"""Largest share."""
SPREAD = wp.constant(0.85)
"""How much a vertex is smoothed, in what its neighbours were in the last round."""
KEPT_SECONDS = wp.constant(0.5)
"""Time in which the shift of what is shown fades by a factor of e where nothing crosses any more, s."""
LEAST_SHIFT = wp.constant(1.0e-5)
"""Shift below which a vertex is shown where it is, m."""
LEAST = wp.constant(0.01)
"""Smoothing below which a vertex stays where it is."""


@wp.kernel
def begin_untangling(crossings: Crossings):
    """Let every sculpture be looked at; nothing is found yet."""
    world = wp.tid()
    crossings.untangling_round[world] = 0
    crossings.pierced_count[world] = 0


@wp.kernel
def begin_rounds(crossings: Crossings):
    """Let rounds follow where edges pierce faces, and where walls are shown elsewhere than they are."""
    world = wp.tid()
    if crossings.pierced_count[world] + crossings.shifted[world] > 0:
        wp.atomic_max(crossings.untangling, 0, 1)
    else:
        crossings.untangling_round[world] = -1
    crossings.pierced_count[world] = 0
    crossings.shifted[world] = 0


@wp.kernel
def next_round(crossings: Crossings):
    """Let another round follow where edges pierce faces, up to the last; nothing is found in it yet."""
    world = wp.tid()
    if crossings.untangling_round[world] >= 0:
        if crossings.pierced_count[world] > 0 and crossings.untangling_round[world] < MOST_ROUNDS:
            crossings.untangling_round[world] = crossings.untangling_round[world] + 1
            wp.atomic_max(crossings.untangling, 0, 1)
        else:
            crossings.untangling_round[world] = wp.where(crossings.pierced_count[world] > 0, FAILED, -1)
        crossings.pierced_count[world] = 0


@wp.func
def way_of_vertex(i: int, most: float, crossings: Crossings):
    """Return how a vertex goes back (m), at most so far (m); its share in what is led says how far."""
    sums = crossings.way_back[i]
    way = wp.vec3(float(sums[0]), float(sums[1]), float(sums[2])) / PER_UNIT
    # Each edge counts twice, with the faces on both its sides.
    share = wp.min(0.5 * float(sums[3]) / PER_UNIT, 1.0)
    return way * (most * share / wp.max(wp.length(way), UNDECIDED))


@wp.func
def kept(i: int, frame_seconds: float, mesh: Mesh, balloons: Balloons, state: State):
    """Return the share of the last frame's shift that a vertex keeps: less where it moves, all if it lies."""
    b = int_at(mesh.vertex_balloon, i)
    if int_at(balloons.touching, b) == LYING:
        return 1.0
    moved = frame_seconds * wp.length(vec3_at(state.v, i)) / float_at(balloons.contact_offset, b)
    return wp.exp(-frame_seconds / KEPT_SECONDS) / (1.0 + moved * moved)


@wp.func
def round_of(i: int, mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Return the round of a vertex's sculpture, from 1; below 0 where none is left."""
    return int_at(crossings.untangling_round, int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i)))


@wp.kernel
def keep_ways(crossings: Crossings):
    """Keep the ways back of where walls are: those found next are of where they are shown."""
    i = wp.tid()
    crossings.way_led[i] = way_of_vertex(i, 1.0, crossings)
    crossings.way_back[i] = wp.vec4i(0)


@wp.kernel
def lead_back_slowly(
    frame_seconds: float, mesh: Mesh, hands: Hands, crossings: Crossings, x: wp.array[wp.vec3]
):
    """Move every vertex the way back that was found in the last frame, as far as it is led in one."""
    i = wp.tid()
    way = crossings.way_led[i]
    if wp.length_sq(way) > 0.0:
        x[i] = x[i] + frame_seconds * hands.leading[mesh.vertex_balloon[i]] * way


@wp.kernel
def begin_showing(frame_seconds: float, mesh: Mesh, balloons: Balloons, crossings: Crossings, state: State):
    """Write where every vertex is shown if no walls cross there: where it is, but for what it keeps of the
    last frame's shift.
    """
    i = wp.tid()
    shift = crossings.shown_shift[i]
    if wp.length_sq(shift) > 0.0:
        shift = kept(i, frame_seconds, mesh, balloons, state) * shift
    crossings.x_shown[i] = state.x[i] + shift
    crossings.smoothing[i] = 0.0


@wp.kernel
def end_showing(mesh: Mesh, balloons: Balloons, crossings: Crossings, x: wp.array[wp.vec3]):
    """Write how far every vertex is shown from where it is, and where any is, by sculpture and segment."""
    i = wp.tid()
    shift = crossings.x_shown[i] - x[i]
    far = wp.length(shift)
    if far < LEAST_SHIFT or round_of(i, mesh, balloons, crossings) == FAILED:
        shift = wp.vec3(0.0)
        crossings.x_shown[i] = x[i]
    else:
        wp.atomic_max(crossings.shifted, balloons.balloon_world[mesh.vertex_balloon[i]], 1)
        wp.atomic_max(crossings.segment_shift, mesh.quad_segment[wp.max(mesh.corners[i][0], 0) // 4], far)
    crossings.shown_shift[i] = shift


@wp.func
def closed(i: int, mesh: Mesh, joints: Joints, hands: Hands):
    """Return whether a vertex is of a closed ring."""
    joint = int_at(mesh.vertex_joint, i)
    if joint < 0:
        return False
    return int_at(joints.joint_parts, joint) == 1 and float_at(hands.radius_to, joint) > 0.0


@wp.kernel
def draw_back(
    mesh: Mesh,
    balloons: Balloons,
    joints: Joints,
    hands: Hands,
    crossings: Crossings,
    x: wp.array[wp.vec3],
):
    """Write where every vertex is shown after a round: its way back, and nearer to the middle of its
    neighbours.
    """
    i = wp.tid()
    done = round_of(i, mesh, balloons, crossings)
    if done <= 0:
        return
    middle = wp.vec3(0.0)
    count = float(0.0)
    smoothing = float_at(crossings.smoothing, i)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(mesh.corners, row)
        for k in range(4):
            if slots[k] >= 0:
                c = vec4i_at(mesh.quads, slots[k] // 4)
                # Every neighbour is met twice, in the quads on both sides of the edge to it.
                before = c[(slots[k] + 3) % 4]
                after = c[(slots[k] + 1) % 4]
                middle += vec3_at(crossings.x_shown, before) + vec3_at(crossings.x_shown, after)
                count += 2.0
                smoothing = wp.max(smoothing, float_at(crossings.smoothing, before))
                smoothing = wp.max(smoothing, float_at(crossings.smoothing, after))
        row = -2 - slots[3]
    smoothing *= SPREAD
    if done <= FIRM_ROUNDS and closed(i, mesh, joints, hands):
        smoothing = 0.0
        crossings.way_back[i] = wp.vec4i(0)
    shift = wp.vec3(0.0)
    if crossings.way_back[i][3] != 0:
        smoothing = 1.0
        far = STEP * float_at(balloons.contact_offset, int_at(mesh.vertex_balloon, i))
        shift = way_of_vertex(i, far, crossings)
        crossings.way_back[i] = wp.vec4i(0)
    crossings.smoothing_next[i] = smoothing
    share = wp.clamp(MORE * float(done - UNSMOOTHED_ROUNDS), 0.0, MOST_SMOOTHED)
    shown = vec3_at(crossings.x_shown, i)
    shown += shift + share * smoothing * (middle / count - shown)
    off = shown - vec3_at(x, i)
    most = FARTHEST * float_at(balloons.contact_offset, int_at(mesh.vertex_balloon, i))
    crossings.x_coming[i] = vec3_at(x, i) + off * wp.min(most / wp.max(wp.length(off), most), 1.0)


@wp.kernel
def go_back(mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Show every vertex that is smoothed where it is after a round."""
    i = wp.tid()
    if round_of(i, mesh, balloons, crossings) <= 0:
        return
    smoothing = crossings.smoothing_next[i]
    crossings.smoothing[i] = smoothing
    if smoothing > LEAST:
        crossings.x_shown[i] = crossings.x_coming[i]
