"""A tail ball: which tips are refused, with what would work."""

from __future__ import annotations

import re

import pytest

from balloon_usd.operations.moves import StretchTip
from balloon_usd.recipe import RecipeError

TUBE = """
balloons: {{main: {{size: 260, length: 18, tail: {tail}}}}}
steps:
  - bubbles: {{a: 8}}
  - ear: {{b: 3}}
  - rest: tail
  - tail_ball: {{tail: {ball}}}
physics: {{softening: {soft}}}
"""


def figure(planned, tail=10, ball=2.5, soft="true"):
    return planned(TUBE.format(tail=tail, ball=ball, soft=soft))


def test_the_tip_of_the_rest_is_stretched(planned):
    moves = figure(planned).choreography.moves
    (move,) = (move for move in moves if isinstance(move, StretchTip))
    assert (move.bubble, move.length) == ("tail", pytest.approx(0.025))


@pytest.mark.parametrize("ball", [1, 2.3, 9])
def test_a_tip_that_is_too_short_or_longer_than_the_tail_is_refused_with_what_would_do(planned, ball):
    with pytest.raises(RecipeError) as caught:
        figure(planned, ball=ball)
    least, most = map(float, re.search(r"expected ([\d.]+) cm to ([\d.]+) cm", str(caught.value)).groups())
    assert figure(planned, ball=least)
    assert figure(planned, ball=most)


def test_a_tail_that_is_used_up_is_refused_with_one_that_is_long_enough(planned):
    with pytest.raises(RecipeError, match=r"of flat tail are left of tail, expected 3\.6 cm of it or more"):
        figure(planned, tail=4)


def test_rubber_that_does_not_soften_makes_no_ball(planned):
    with pytest.raises(RecipeError, match="stays too hard where it has been stretched"):
        figure(planned, soft="false")
