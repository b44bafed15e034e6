"""A press: where the finger comes, how long it takes, and what the other hand holds meanwhile."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import LetGo, Loosen, Press
from balloon_usd.recipe import RecipeError

CM = 0.01
TUBE = """
balloons: {{main: {{size: 260, tail: 10}}}}
steps:
  - bubbles: {{a: 9, b: 12}}
  - {}
"""
CAPSULE = """
balloons: {{main: {{size: 260, capsule: 20}}}}
steps:
  - {}
physics: {{model: kosaka}}
"""


def press_of(figure) -> Press:
    return next(move for move in figure.choreography.moves if isinstance(move, Press))


def held_names(figure) -> list[str]:
    return [figure.table.rings[ring].name for ring in press_of(figure).holds]


def test_a_finger_comes_from_above_onto_the_middle_for_a_second(planned):
    figure = planned(TUBE.format("press: {bubble: b, depth: 1.2}"))
    move, bubble = press_of(figure), figure.bubbles[1]
    assert move.along == pytest.approx(0.5 * (bubble.rest_start + bubble.rest_end))
    assert (move.balloon, move.point, move.seconds) == ("main", (0.0, 0.0, -1.0), 1.0)
    assert (move.depth, move.force) == (0.012, 0.0)


def test_a_force_direction_and_time_are_taken_from_the_recipe(planned):
    move = press_of(planned(TUBE.format("{press: {bubble: b, force: 2 N}, point: left, seconds: 3}")))
    assert (move.depth, move.force, move.point, move.seconds) == (0.0, 2.0, (0.0, -1.0, 0.0), 3.0)


def test_hands_hold_on_while_the_shape_returns_and_then_let_go(planned):
    moves = planned(TUBE.format("{press: {bubble: b, depth: 1}, seconds: 3}")).choreography.moves
    at = next(k for k, move in enumerate(moves) if isinstance(move, Press))
    assert moves[at + 1].seconds == pytest.approx(0.8)
    assert moves[at + 1].start == pytest.approx(moves[at].end)
    assert isinstance(moves[at + 2], Loosen)
    assert isinstance(moves[at + 3], LetGo)


@pytest.mark.parametrize(
    ("at", "held"),
    [(6, ["a.end", "b.end"]), (3, ["b.end"]), (9, ["a.end"])],
)
def test_the_other_hand_holds_the_ends_that_are_not_near_the_finger(planned, at, held):
    assert held_names(planned(TUBE.format(f"press: {{bubble: b, at: {at}, depth: 1}}"))) == held


def test_of_a_tip_the_last_guide_ring_is_held(planned):
    figure = planned(CAPSULE.format("press: {bubble: main_rest, at: 10, depth: 1.2}"))
    assert press_of(figure).along == pytest.approx(10 * CM)
    assert held_names(figure) == ["main.knot", "main_rest.1"]


NECKED = """
balloons: {{main: {{size: 260, capsule: 28}}}}
steps:
  - bubbles: {{a: 8, b: 6}}
  - {}
physics: {{model: kosaka}}
"""


def test_a_place_before_any_neck_of_a_capsule_is_as_far_along_its_wall(planned):
    assert press_of(planned(NECKED.format("press: {bubble: a, at: 2, depth: 1}"))).along == pytest.approx(
        2 * CM
    )


def test_the_middle_of_a_bubble_with_two_necks_is_that_of_its_wall(planned):
    figure = planned(NECKED.format("press: {bubble: b, depth: 1}"))
    bubble = figure.bubbles[1]
    assert press_of(figure).along == pytest.approx(0.5 * (bubble.rest_start + bubble.rest_end))


def test_a_place_beyond_a_neck_of_a_capsule_is_farther_along_its_wall(planned):
    figure = planned(NECKED.format("press: {bubble: main_rest, at: 5, depth: 1}"))
    rest = figure.bubbles[-1]
    necked = rest.rest_length - rest.length
    assert press_of(figure).along == pytest.approx(rest.rest_start + 5 * CM + necked)


def test_the_tip_of_a_capsule_is_at_its_end(planned):
    figure = planned(NECKED.format("press: {bubble: main_rest, force: 1}"))
    strip = figure.strips["main"]
    rest = figure.bubbles[-1]
    assert strip.rest_place(rest, rest.length) == pytest.approx(strip.capsule_length)


def test_a_place_on_the_rest_is_not_on_its_flat_tail(planned):
    figure = planned(TUBE.format("press: {bubble: main_rest, at: 90, depth: 1}"))
    rest = figure.bubbles[-1]
    share = (press_of(figure).along - rest.rest_start) / rest.rest_length
    assert 90 * CM / rest.length * 0.75 > share > 90 * CM / rest.length * 0.6


@pytest.mark.parametrize(
    ("press", "said"),
    [
        (
            "{bubble: b, at: 12, depth: 1}",
            "steps[1].press.at: 12 cm does not lie inside b, expected less than 12 cm",
        ),
        ("{bubble: b, depth: 6}", "steps[1].press.depth: 6 cm goes through a 260, expected less than 5 cm"),
    ],
)
def test_a_finger_beside_or_through_the_balloon_is_refused_at_its_place(planned, press, said):
    with pytest.raises(RecipeError) as caught:
        planned(TUBE.format(f"press: {press}"))
    assert said in str(caught.value)


def test_the_whole_balloon_can_be_bent_and_pushed_when_nothing_is_made_of_it(planned):
    figure = planned("""
        balloons: {main: {size: 260, tail: 10}}
        steps: [{bend: {main_rest: 60}}, {press: {bubble: main_rest, force: 1}}, {wait: 1}]
        """)
    assert [bubble.name for bubble in figure.bubbles] == ["main_rest"]
    assert figure.cautions == ()
