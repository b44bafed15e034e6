"""Walls that have gone through each other all the same are led apart: round after round they go back, and the
wall about them is smoothed, more and farther around the longer it takes.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Joints, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.physics.motion import lying
from balloon_usd.solver.kernels.physics.piercing_edge import PER_UNIT

NOT_LOOKED = wp.constant(-1)
"""Round of a sculpture whose walls are not looked at this time."""
FAILED = wp.constant(-2)
"""Round of a sculpture whose walls still cross after the last one."""
APART = wp.constant(-3)
"""Round of a sculpture whose walls do not cross."""
MOST_ROUNDS = wp.constant(96)
"""Rounds after which walls that still cross are left as they are."""
FIRM_ROUNDS = wp.constant(40)
"""Rounds in which closed rings stay where they are: joints shall not come apart."""
FARTHEST = wp.constant(4.0)
"""How far a vertex is led at most, in distances at which walls begin to press. Of three ears in a row on a
260, with 6 one loses half of its volume for a frame; with 2 walls cross in 38 frames, with 4 in none.
"""
STEP = wp.constant(1.0 / 6.0)
"""How far a vertex is led in a round, in the same."""
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
LEAST = wp.constant(0.01)
"""Smoothing below which a vertex stays where it is."""
NEGLIGIBLE = wp.constant(2.0e-6)
"""How far a vertex has to go in a round to be moved at all, and so to be looked at again, m: a tenth of the
time of a crown of 54 bubbles. What lies is moved by less: it is put back exactly, or comes nearer for ever.
"""


@wp.kernel
def next_round(crossings: Crossings):
    """Let another round follow where edges pierce faces, up to the last; nothing is found in it yet."""
    world = wp.tid()
    if world == 0:
        crossings.looked_count[0] = 0
    done = crossings.untangling_round[world]
    if done >= 0:
        if crossings.pierced_count[world] == 0:
            done = APART
        elif done == MOST_ROUNDS:
            done = FAILED
        else:
            done += 1
            wp.atomic_max(crossings.untangling, 0, 1)
        crossings.untangling_round[world] = done
        crossings.pierced_count[world] = 0


@wp.func
def round_of(i: int, mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Return the round of a vertex's sculpture, from 1; below where it takes part in none."""
    return int_at(crossings.untangling_round, int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i)))


@wp.func
def segment_of(i: int, mesh: Mesh):
    """Return a segment of a vertex: at a joint one of the two."""
    return mesh.quad_segment[wp.max(mesh.corners[i][0], 0) // 4]


@wp.func
def closed(i: int, mesh: Mesh, joints: Joints, hands: Hands):
    """Return whether a vertex is of a closed ring."""
    joint = int_at(mesh.vertex_joint, i)
    if joint < 0:
        return False
    return int_at(joints.joint_parts, joint) == 1 and float_at(hands.radius_to, joint) > 0.0


@wp.func
def about(i: int, mesh: Mesh, crossings: Crossings):
    """Return where the neighbours of a vertex are kept apart in the mean (m), how they have moved there (m),
    and the most that it or one of them is smoothed.
    """
    place = wp.vec3(0.0)
    motion = wp.vec3(0.0)
    smoothing = float_at(crossings.smoothing, i)
    count = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(mesh.corners, row)
        for k in range(4):
            if slots[k] >= 0:
                c = vec4i_at(mesh.quads, slots[k] // 4)
                # Every neighbour is met twice, in the quads on both sides of the edge to it.
                before = c[(slots[k] + 3) % 4]
                after = c[(slots[k] + 1) % 4]
                place_before = vec3_at(crossings.x_apart, before)
                place_after = vec3_at(crossings.x_apart, after)
                place += place_before + place_after
                motion += place_after - vec3_at(crossings.x_safe, after)
                motion += place_before - vec3_at(crossings.x_safe, before)
                smoothing = wp.max(smoothing, float_at(crossings.smoothing, before))
                smoothing = wp.max(smoothing, float_at(crossings.smoothing, after))
                count += 2.0
        row = -2 - slots[3]
    return place / count, motion / count, smoothing


@wp.func
def way_of_vertex(i: int, most: float, crossings: Crossings):
    """Return how a vertex goes back (m), at most so far (m); its share in what is led says how far."""
    sums = crossings.way_back[i]
    way = wp.vec3(float(sums[0]), float(sums[1]), float(sums[2])) / PER_UNIT
    # Each edge counts twice, with the faces on both its sides.
    share = wp.min(0.5 * float(sums[3]) / PER_UNIT, 1.0)
    return way * (most * share / wp.max(wp.length(way), UNDECIDED))


@wp.kernel
def draw_back(
    mesh: Mesh,
    balloons: Balloons,
    joints: Joints,
    hands: Hands,
    contacts: Contacts,
    crossings: Crossings,
    state: State,
):
    """Write where every vertex is after a round: its way back, and nearer to the middle of its neighbours."""
    i = wp.tid()
    done = round_of(i, mesh, balloons, crossings)
    crossings.smoothing_next[i] = 0.0
    if done <= 0:
        return
    if done == 1:
        contacts.crossed[i] = wp.where(crossings.way_back[i][3] > 0, 1, 0)
        crossings.way_led[i] = way_of_vertex(i, 1.0, crossings)
    if done <= FIRM_ROUNDS and closed(i, mesh, joints, hands):
        return
    middle, _, smoothing = about(i, mesh, crossings)
    smoothing *= SPREAD
    offset = float_at(balloons.contact_offset, int_at(mesh.vertex_balloon, i))
    shift = wp.vec3(0.0)
    if crossings.way_back[i][3] != 0:
        smoothing = 1.0
        shift = way_of_vertex(i, STEP * offset, crossings)
    crossings.smoothing_next[i] = smoothing
    share = wp.clamp(MORE * float(done - UNSMOOTHED_ROUNDS), 0.0, MOST_SMOOTHED)
    apart = vec3_at(crossings.x_apart, i)
    apart += shift + share * smoothing * (middle - apart)
    off = apart - vec3_at(state.x, i)
    most = FARTHEST * offset
    crossings.x_coming[i] = vec3_at(state.x, i) + off * wp.min(most / wp.max(wp.length(off), most), 1.0)


@wp.kernel
def end_round(mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Let every vertex that is smoothed be where it goes in a round: it, and what would cross, is looked at
    again.
    """
    i = wp.tid()
    if round_of(i, mesh, balloons, crossings) > 0:
        smoothing = crossings.smoothing_next[i]
        goes = bool(False)
        if smoothing > LEAST:
            least = wp.where(lying(i, mesh, balloons), 0.0, NEGLIGIBLE)
            goes = wp.length(crossings.x_coming[i] - crossings.x_apart[i]) > least
        crossings.restless[i] = wp.where(crossings.way_back[i][3] > 0 or goes, 1, 0)
        crossings.way_back[i] = wp.vec4i(0)
        crossings.smoothing[i] = smoothing
        if goes:
            crossings.x_apart[i] = crossings.x_coming[i]


@wp.kernel
def end_untangling(
    mesh: Mesh, balloons: Balloons, hands: Hands, contacts: Contacts, crossings: Crossings, state: State
):
    """Let every vertex be where it was led; where walls still cross it goes a step on the way found first,
    but stays where it was put back to: there walls are only too near.
    """
    i = wp.tid()
    crossings.way_back[i] = wp.vec4i(0)
    done = round_of(i, mesh, balloons, crossings)
    shift = crossings.x_apart[i] - state.x[i]
    if done == APART:
        contacts.crossed[i] = 0
    elif done == FAILED:
        balloon = mesh.vertex_balloon[i]
        world = balloons.balloon_world[balloon]
        seconds = crossings.safe_seconds[world]
        if crossings.put_back[world] > 0 and crossings.crossed_count[world] == 0:
            contacts.crossed[i] = 0
            seconds = 0.0
        shift = seconds * hands.leading[balloon] * crossings.way_led[i]
    far = wp.length(shift)
    if far > 0.0:
        wp.atomic_max(crossings.segment_shift, segment_of(i, mesh), far)
        state.x[i] = state.x[i] + shift
        crossings.x_safe[i] = state.x[i]
