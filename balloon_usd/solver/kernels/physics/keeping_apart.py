"""Walls that would go through each other: since they were last apart they have moved as one, so they still
are (rigid impact zones, Bridson, Fedkiw & Anderson 2002, but that zones are as soft as the wall about them).
"""

import warp as wp

from balloon_usd.solver.frame import LEAST_SLOWNESS
from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Joints, Mesh, State
from balloon_usd.solver.kernels.device.array_access import int_at, vec3_at
from balloon_usd.solver.kernels.physics.joints import held
from balloon_usd.solver.kernels.physics.motion import SLOW, lying
from balloon_usd.solver.kernels.physics.piercing_edge import PER_METRE
from balloon_usd.solver.kernels.physics.reaction import reaction_after
from balloon_usd.solver.kernels.physics.surface import velocity_of_spin
from balloon_usd.solver.kernels.physics.untangling import (
    FAILED,
    LEAST,
    MOST_SMOOTHED,
    NOT_LOOKED,
    SPREAD,
    about,
    closed,
    round_of,
    segment_of,
)

MORE = wp.constant(0.02)
"""How much more a vertex moves as its neighbours do in every round, as a share of the difference."""
HELD_ROUNDS = wp.constant(12)
"""Rounds in which closed rings go where hands bring them, whatever is in the way. With 64 an ear of a 160
loses nine tenths of its gas and others jam; with none creases beside them are stretched twelve times.
"""
FREE_ROUNDS = wp.constant(6)
"""The same where no hand holds them exactly."""
SMOOTHED_ROUNDS = wp.constant(32)
"""Rounds in which what would have crossed in an earlier one moves nearly as what is beside it again. After
them it goes on as it did then, else some pairs never agree; from the first on, that stretched creases thirty
times.
"""
STUCK = wp.constant(2)
"""How often in a row a sculpture is put back until it sticks."""
MOVED_ROUNDS = wp.constant(72)
"""Rounds in which what would cross moves as one in a sculpture that sticks; after them it stays where it was.
Done sooner, it holds gas and hands up: a trunk turned inside out.
"""
FADING = wp.constant(0.95)
"""Share of the slowness that is left each time that walls are kept apart."""
LEAST_LEFT = wp.constant(LEAST_SLOWNESS)
"""Slowness from which on there is none, s/m."""
MOST_PUT_BACK = wp.constant(8)
"""How often in a row a sculpture is put back."""
WATCHED_FRAMES = wp.constant(12)
"""Frames for which walls of a sculpture are kept apart at every search, not only at the end of the frame."""


@wp.kernel
def begin_keeping_apart(frame_ends: int, contacts: Contacts, crossings: Crossings):
    """Let the walls of every sculpture be looked at: at the end of a frame of all, else of those watched."""
    world = wp.tid()
    looked = frame_ends == 1 or contacts.watched[world] > 0
    crossings.untangling_round[world] = wp.where(looked, 0, NOT_LOOKED)
    crossings.pierced_count[world] = 0
    crossings.crossed_count[world] = 0
    if world == 0:
        crossings.tangled[0] = 0
        crossings.any_watched[0] = 0


@wp.kernel
def begin_moves(crossings: Crossings, x: wp.array[wp.vec3]):
    """Let every vertex be where it went; nothing is shared yet, and all have to be looked at."""
    i = wp.tid()
    crossings.x_apart[i] = x[i]
    crossings.restless[i] = 1
    crossings.smoothing[i] = 0.0
    crossings.pushed[i] = wp.vec3i(0)


@wp.kernel
def begin_move_rounds(frame_ends: int, contacts: Contacts, crossings: Crossings):
    """Let rounds follow where walls would cross that did not, and watch these sculptures."""
    world = wp.tid()
    if world == 0:
        crossings.looked_count[0] = 0
    if crossings.pierced_count[world] > 0:
        crossings.untangling_round[world] = 1
        contacts.watched[world] = WATCHED_FRAMES + frame_ends
        wp.atomic_max(crossings.untangling, 0, 1)


@wp.func
def motion_of(i: int, crossings: Crossings):
    """Return how a vertex moves: with all that it would cross, if anything (m)."""
    sums = crossings.way_back[i]
    if sums[3] > 0:
        return wp.vec3(float(sums[0]), float(sums[1]), float(sums[2])) / (PER_METRE * float(sums[3]))
    return vec3_at(crossings.x_apart, i) - vec3_at(crossings.x_safe, i)


@wp.kernel
def move_together(mesh: Mesh, balloons: Balloons, joints: Joints, hands: Hands, crossings: Crossings):
    """Write where every vertex goes after a round: what would cross moves as one, what is beside it nearly;
    what would have crossed in an earlier round goes on as it did then, after some rounds.

    What lies does not move at all where it would cross, and is not smoothed: beside a closed ring that joints
    move every time that was drawn out into spikes of 60 mm. Of a sculpture that sticks nothing moves in the
    last rounds, which always ends. A closed ring moves as those of its vertices that would cross: as
    the mean of all, it took a hundred rounds. Closed rings stay what they are, and move first as without
    this, longest where hands hold them.
    """
    i = wp.tid()
    crossings.smoothing_next[i] = 0.0
    done = round_of(i, mesh, balloons, crossings)
    if done <= 0:
        return
    first = int(i)
    around = int(1)
    if closed(i, mesh, joints, hands):
        joint = int_at(mesh.vertex_joint, i)
        if done <= wp.where(held(int_at(hands.hand, joint)) == 1, HELD_ROUNDS, FREE_ROUNDS):
            return
        first = int_at(joints.joint_first, joint)
        around = int_at(joints.joint_around, joint)
    motion = wp.vec3(0.0)
    led = wp.vec3(0.0)
    crossing = float(0.0)
    beside = wp.vec3(0.0)
    smoothing = float(0.0)
    crossed = int(0)
    for v in range(first, first + around):
        own = motion_of(v, crossings)
        motion += own / float(around)
        if crossings.way_back[v][3] > 0:
            led += own
            crossing += 1.0
        if crossings.smoothing[v] == 1.0:
            crossed = 1
        _, beside_one, smoothed = about(v, mesh, crossings)
        beside += beside_one / float(around)
        smoothing = wp.max(smoothing, smoothed)
    smoothing *= SPREAD
    lies = lying(i, mesh, balloons)
    if crossing > 0.0:
        smoothing = 1.0
        motion = led / crossing
        stuck = crossings.put_back[int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i))] > STUCK
        if lies or (stuck and done > MOVED_ROUNDS):
            motion = wp.vec3(0.0)
    elif crossed == 1 and done > SMOOTHED_ROUNDS:
        smoothing = 1.0
    elif not lies:
        motion += wp.min(MORE * float(done), MOST_SMOOTHED) * smoothing * (beside - motion)
    crossings.smoothing_next[i] = smoothing
    crossings.x_coming[i] = vec3_at(crossings.x_safe, i) + motion


@wp.func
def is_put_back(world: int, between_searches: float, crossings: Crossings):
    """Return whether a sculpture goes back to where its walls were last apart: nothing kept them so since."""
    return (
        crossings.untangling_round[world] == FAILED
        and crossings.put_back[world] < MOST_PUT_BACK
        and crossings.safe_seconds[world] == between_searches
    )


@wp.kernel
def end_keeping_apart(
    between_searches: float,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    contacts: Contacts,
    crossings: Crossings,
    state: State,
):
    """Let every vertex that moved with others be where that led it, as fast as that was, slow for a while,
    and pressed by what it would have crossed; it is safe there.
    """
    i = wp.tid()
    world = int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i))
    if crossings.untangling_round[world] == NOT_LOOKED:
        return
    if crossings.untangling_round[world] == FAILED and crossings.way_back[i][3] > 0:
        crossings.segment_jammed[segment_of(i, mesh)] = 1
    if is_put_back(world, between_searches, crossings):
        crossings.way_back[i] = wp.vec4i(0)
        state.x[i] = crossings.x_safe[i]
        state.v[i] = -velocity_of_spin(i, state.x[i], hands)
        return
    back = crossings.x_apart[i] - state.x[i]
    reaction = reaction_after(i, crossings.safe_seconds[world], mesh, hands, crossings, state)
    if wp.length_sq(back) > 0.0:
        way = crossings.x_apart[i] - crossings.x_safe[i]
        state.x[i] = crossings.x_apart[i]
        # Turns by hands are no part of the velocity.
        state.v[i] = way / crossings.safe_seconds[world] - velocity_of_spin(i, state.x[i], hands)
    if hands.floating[mesh.vertex_balloon[i]] == 1:
        state.slowness[i] = 0.0
    elif crossings.smoothing[i] > LEAST:
        state.slowness[i] = 1.0 / SLOW
    elif state.slowness[i] > 0.0:
        slowness = FADING * state.slowness[i]
        state.slowness[i] = wp.where(slowness > LEAST_LEFT, slowness, 0.0)
    if wp.length_sq(reaction) > 0.0:
        # Else a step does not look whether there is any.
        state.slowness[i] = wp.max(state.slowness[i], LEAST_LEFT)
    state.reaction[i] = reaction
    if crossings.untangling_round[world] == FAILED:
        contacts.crossed[i] = wp.max(contacts.crossed[i], wp.min(crossings.way_back[i][3], 1))
        crossings.way_back[i] = wp.vec4i(0)
    elif crossings.crossed_count[world] == 0:
        contacts.crossed[i] = 0
    crossings.x_safe[i] = state.x[i]


@wp.kernel
def begin_untangling(frame_ends: int, between_searches: float, crossings: Crossings):
    """Count how often in a row every sculpture was put back, and let walls be led apart that still cross;
    where they did before already, once a frame.
    """
    world = wp.tid()
    if is_put_back(world, between_searches, crossings):
        crossings.put_back[world] += 1
    elif crossings.untangling_round[world] != NOT_LOOKED:
        crossings.put_back[world] = 0
    old = frame_ends == 1 and crossings.crossed_count[world] > 0
    if old or crossings.untangling_round[world] == FAILED:
        crossings.untangling_round[world] = 0
        crossings.pierced_count[world] = 0
        wp.atomic_max(crossings.tangled, 0, 1)


@wp.kernel
def go_on_watching(
    frame_ends: int, between_searches: float, frame_seconds: float, contacts: Contacts, crossings: Crossings
):
    """Count down the frames for which sculptures are watched, and write when they are looked at next."""
    world = wp.tid()
    left = contacts.watched[world]
    if frame_ends == 1:
        left = wp.max(left - 1, 0)
        contacts.watched[world] = left
    crossings.safe_seconds[world] = wp.where(left > 0, between_searches, frame_seconds)
    wp.atomic_max(crossings.any_watched, 0, left)
