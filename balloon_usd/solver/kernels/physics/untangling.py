"""Untangling: walls that have gone through each other are led back a little, and are shown where they no
more cross: round after round they go back, and the wall about them is smoothed, more and farther around the
longer it takes.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Mesh
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.physics.piercing_walls import PER_UNIT

MOST_ROUNDS = wp.constant(96)
"""Rounds after which walls that still cross are shown as they are."""
STEP = wp.constant(1.0 / 6.0)
"""How far a vertex is shown farther back in a round, in the distance at which walls begin to press."""
UNDECIDED = wp.constant(1.0e-3)
"""Sum of ways, for a share of 1, below which they cancel: so a vertex goes less than a whole step."""
SMOOTHED = wp.constant(0.1)
"""How far a vertex goes to the middle of its neighbours in the first round, as a share of that way."""
MORE = wp.constant(0.02)
"""What is added to that share in every round."""
MOST_SMOOTHED = wp.constant(0.5)
"""Largest share."""
SPREAD = wp.constant(0.85)
"""How much a vertex is smoothed, in what its neighbours were in the last round."""
LEAST = wp.constant(0.01)
"""Smoothing below which a vertex stays where it is."""


@wp.kernel
def begin_untangling(crossings: Crossings):
    """Let every sculpture be looked at; nothing is found yet."""
    world = wp.tid()
    crossings.untangling_round[world] = 0
    crossings.pierced_count[world] = 0


@wp.kernel
def next_round(crossings: Crossings):
    """Let another round follow where edges pierce faces, up to the last; nothing is found in it yet."""
    world = wp.tid()
    if crossings.untangling_round[world] >= 0:
        if crossings.pierced_count[world] > 0 and crossings.untangling_round[world] < MOST_ROUNDS:
            crossings.untangling_round[world] = crossings.untangling_round[world] + 1
            wp.atomic_max(crossings.untangling, 0, 1)
        else:
            crossings.untangling_round[world] = -1
        crossings.pierced_count[world] = 0


@wp.func
def way_of_vertex(i: int, most: float, crossings: Crossings):
    """Return how a vertex goes back (m), at most so far (m); its share in what is led says how far."""
    sums = crossings.way_back[i]
    way = wp.vec3(float(sums[0]), float(sums[1]), float(sums[2])) / PER_UNIT
    # Each edge counts twice, with the faces on both its sides.
    share = wp.min(0.5 * float(sums[3]) / PER_UNIT, 1.0)
    return way * (most * share / wp.max(wp.length(way), UNDECIDED))


@wp.kernel
def lead_back_slowly(
    frame_seconds: float, mesh: Mesh, hands: Hands, crossings: Crossings, x: wp.array[wp.vec3]
):
    """Move every vertex its way back within a frame."""
    i = wp.tid()
    if crossings.way_back[i][3] != 0:
        far = frame_seconds * hands.leading[mesh.vertex_balloon[i]]
        x[i] = x[i] + way_of_vertex(i, far, crossings)


@wp.func
def round_of(i: int, mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Return the round of a vertex's sculpture, -1 where none is left."""
    return int_at(crossings.untangling_round, int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i)))


@wp.kernel
def draw_back(mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Write where every vertex is shown after a round: its way back, and nearer to the middle of its
    neighbours.
    """
    i = wp.tid()
    if i == 0:
        crossings.untangling[0] = 0
    done = round_of(i, mesh, balloons, crossings)
    if done < 0:
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
    shift = wp.vec3(0.0)
    if crossings.way_back[i][3] != 0:
        smoothing = 1.0
        far = STEP * float_at(balloons.contact_offset, int_at(mesh.vertex_balloon, i))
        shift = way_of_vertex(i, far, crossings)
        crossings.way_back[i] = wp.vec4i(0)
    crossings.smoothing_next[i] = smoothing
    share = wp.min(SMOOTHED + MORE * float(done - 1), MOST_SMOOTHED)
    x = vec3_at(crossings.x_shown, i)
    crossings.x_coming[i] = x + shift + share * smoothing * (middle / count - x)


@wp.kernel
def go_back(mesh: Mesh, balloons: Balloons, crossings: Crossings):
    """Show every vertex that is smoothed where it is after a round."""
    i = wp.tid()
    if round_of(i, mesh, balloons, crossings) < 0:
        return
    smoothing = crossings.smoothing_next[i]
    crossings.smoothing[i] = smoothing
    if smoothing > LEAST:
        crossings.x_shown[i] = crossings.x_coming[i]


@wp.kernel
def end_untangling(crossings: Crossings):
    """Forget where walls were smoothed."""
    crossings.smoothing[wp.tid()] = 0.0
