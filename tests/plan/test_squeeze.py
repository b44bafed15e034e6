"""A squeeze: where hands press, how far, how long, and what fingers hold meanwhile."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Press

TUBE = """
balloons: {{main: {{size: 260, tail: 10}}}}
steps:
  - bubbles: {{a: 9, b: 12}}
  - {}
"""


def squeeze_of(figure) -> Press:
    return next(move for move in figure.choreography.moves if isinstance(move, Press))


def test_two_palms_press_on_the_middle_of_a_bubble_by_a_share_of_its_width(planned):
    figure = planned(TUBE.format("squeeze: {bubble: b, by: 40 %}"))
    move, bubble = squeeze_of(figure), figure.bubbles[1]
    assert move.flat
    assert move.along == pytest.approx(0.5 * (bubble.rest_start + bubble.rest_end))
    assert move.depth == pytest.approx(0.4 * 2.0 * figure.strips["main"].inflated_radius, rel=1e-6)
    assert (move.balloon, move.point, move.seconds, move.force) == ("main", (0.0, 0.0, -1.0), 1.5, 0.0)


def test_a_direction_and_a_time_are_taken_from_the_recipe(planned):
    move = squeeze_of(planned(TUBE.format("{squeeze: {bubble: b, by: 20}, point: left, seconds: 3}")))
    assert (move.point, move.seconds) == ((0.0, -1.0, 0.0), 3.0)


def test_fingers_hold_both_ends_of_what_is_squeezed(planned):
    figure = planned(TUBE.format("squeeze: {bubble: b, by: 20}"))
    assert [figure.table.rings[ring].name for ring in squeeze_of(figure).holds] == ["a.end", "b.end"]


def test_a_finger_that_presses_is_not_flat(planned):
    assert not squeeze_of(planned(TUBE.format("press: {bubble: b, depth: 1}"))).flat
