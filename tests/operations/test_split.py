"""Split ears: what is refused, and what hands do."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Gather, Halve, Pinch, Spin, Weld
from balloon_usd.operations.split import Split
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

TOES = "{left_toe: 3.5, right_toe: 3.5}"
WORK = (Pinch, Spin, Gather, Weld, Halve)


def test_hands_make_one_ear_and_then_pinch_it_between_its_cheeks():
    planned = plan(Recipe.parse(Split.example))
    rings = planned.table.rings
    own = [move for move in planned.choreography.moves if move.step == 1 and isinstance(move, WORK)]
    assert [type(move) for move in own] == [Pinch, Spin, Gather, Weld, Halve, Gather, Weld]
    # Nothing but the fingers parts both halves until both ends are one.
    assert [rings[own[k].ring].name for k in (0, 1, 4)] == ["right_toe.end", "right_toe.end", "left_toe.end"]
    first, second = (frozenset(rings[ring].name for ring in own[k].rings) for k in (3, 6))
    assert first == {"leg.end", "right_toe.end"}
    assert "left_toe.end" in second
    ends = {end for joint in planned.recipe.piece.joints for end in map(str, joint) if len(joint) > 2}
    assert ends == {
        "leg.end",
        "left_toe.start",
        "left_toe.end",
        "right_toe.start",
        "right_toe.end",
        "heel.start",
    }


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("{toe: 2.5}", "steps[1].split: 1 bubbles, expected the two halves of one ear"),
        ("{a: 2, b: 2, c: 2}", "steps[1].split: 3 bubbles, expected the two halves of one ear"),
        ("{leg: 2, toe: 2}", 'bubble "leg" was made at steps[0].bubbles.leg, expected a new name'),
        ("{a: 0, b: 2}", "steps[1].split.a: 0 is out of range"),
    ],
)
def test_what_is_no_two_new_halves_is_refused(value, told):
    with pytest.raises(RecipeError) as refused:
        Recipe.parse(Split.example.replace(TOES, value).replace("  - rest: heel\n", ""))
    assert told in str(refused.value)


def test_the_model_of_springs_makes_an_ear_instead():
    with pytest.raises(RecipeError, match="expected ear"):
        Recipe.parse(Split.example + "physics: {model: kosaka}\n")
