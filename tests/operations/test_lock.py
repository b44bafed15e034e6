"""The lock twist of any joints: in whichever order they are written, all are there when they are twisted into one."""

from __future__ import annotations

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from balloon_usd.operations.disjoint_sets import DisjointSets
from balloon_usd.operations.moves import Bring, Gather, SetNet, Weld
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

BALLOONS, BUBBLES = "abc", 4
JOINTS = [f"{balloon}{k}.end" for balloon in BALLOONS for k in range(BUBBLES)]
HEAD = "format: 1\nname: knots\nunits: cm\nballoons:\n" + "".join(
    f"  {balloon}: {{size: 260, length: 36, tail: 12}}\n" for balloon in BALLOONS
)


def recipe(*locks):
    """A recipe of three rows of bubbles, some joints of which are locked."""
    rows = "".join(
        f"  - bubbles: {{{', '.join(f'{balloon}{k}: 12' for k in range(BUBBLES))}}}\n    balloon: {balloon}\n"
        for balloon in BALLOONS
    )
    steps = "".join(f"  - lock: {{joints: [{', '.join(lock)}]}}\n" for lock in locks)
    return f"{HEAD}steps:\n{rows}{steps}"


def welded_in_place(figure):
    """Whether the joints of every twist had been brought to one place."""
    rings = figure.table.rings
    place = dict(enumerate(range(len(rings))))
    joined = DisjointSets()
    found = []
    for move in figure.choreography.moves:
        if isinstance(move, Gather):
            # What hangs on the end that moves goes along.
            moving, to = move.corners[0], move.corners[-1]
            along = {k for k in place if k <= moving and rings[k].balloon == rings[moving].balloon}
        elif isinstance(move, Bring):
            moving, to, along = move.ring, move.to, set()
        else:
            if isinstance(move, Weld):
                found.append(len({place[ring] for ring in move.rings}) == 1)
                joined.merge(move.rings)
            continue
        here = place[moving]
        for ring, there in place.items():
            one = joined.root(ring) == joined.root(moving)
            if one or (ring in along and there == here):
                place[ring] = place[to]
    return found


@settings(deadline=None)
@given(st.lists(st.sampled_from(JOINTS), min_size=2, max_size=6, unique=True))
def test_all_joints_of_a_lock_are_in_one_place_when_they_are_twisted(joints):
    try:
        figure = plan(Recipe.parse(recipe(joints)))
    except RecipeError:
        assume(False)
    # Hands lead all joints of a net to their places at once.
    assume(not any(isinstance(move, SetNet) for move in figure.choreography.moves))
    found = welded_in_place(figure)
    assert found
    assert all(found)


def test_balloons_that_share_several_joints_have_their_own_ones_twisted_first():
    figure = plan(Recipe.parse(recipe(["a0.end", "b0.end"], ["a1.end", "b1.end", "a2.end", "b3.end"])))
    names = [ring.name for ring in figure.table.rings]
    welds = [
        [names[ring] for ring in move.rings] for move in figure.choreography.moves if isinstance(move, Weld)
    ]
    assert welds[1:] == [
        ["a1.end", "a2.end"],
        ["b1.end", "b3.end"],
        ["a1.end", "b1.end", "a2.end", "b3.end"],
    ]
