"""Ears that are folded small: their walls never go through themselves, nor through each other."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.operations.moves import Loosen
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.watched import crossings, watched

EAR = """
format: 1
name: ear
units: cm
balloons:
  main: {size: 260, inflated: 28}
steps:
  - bubbles: {body: 8}
  - ear: {ear: 4}
  - rest: rest
"""
FASTEST_LYING = 1.3e-3
"""Largest speed of what lies, m/s, and a little for what is kept apart."""
FLUTTER = 3e-4
"""Change of a vertex's way from frame to frame that is seen, m."""
IN_A_ROW = """
format: 1
name: in_a_row
units: cm
balloons:
  main: {{size: {size}, inflated: {inflated}}}
steps:
  - bubbles: {{body: {body}}}
  - ear: {{first: {ear}}}
  - ear: {{second: {ear}}}
  - ear: {{third: {ear}}}
  - rest: rest
"""


def test_an_ear_as_long_as_wide_never_goes_through_itself():
    assert not crossings(watched(Recipe.parse(EAR)))


def test_ears_that_press_on_each_other_lie_still_while_hands_loosen_their_grip():
    # How many vertices flutter is chance, so three like figures: of six 0 to 47 each, and 137 to 277 where
    # rubber that is folded up in necks is not braked.
    for inflated in (55.9, 56, 56.1):
        planned = plan(Recipe.parse(IN_A_ROW.format(size=646, inflated=inflated, body=18, ear=9)))
        assert _fluttering(planned) < 60


def _fluttering(planned):
    """How many vertices flutter in the last second in which hands loosen their grip; then all must lie still."""
    loosened = next(move for move in planned.choreography.moves if isinstance(move, Loosen))
    fps = planned.recipe.fps
    last_second = range(round((loosened.end - 1.0) * fps), round(loosened.end * fps))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    frames = {frame.time_code: frame.points[0] for (frame,) in simulation.frames()}
    lying = [frames[code] for code in range(round((loosened.end - 0.15) * fps), planned.frame_count + 1)]
    assert np.linalg.norm(np.diff(lying, axis=0), axis=2).max() * fps < FASTEST_LYING
    turns = np.linalg.norm(np.diff([frames[code] for code in last_second], n=2, axis=0), axis=2).mean(axis=0)
    return int((turns > FLUTTER).sum())


@pytest.mark.long
@pytest.mark.parametrize(
    ("size", "inflated", "body", "ear"),
    [(160, 48, 6, 3), (260, 54, 8, 4), (350, 60, 10, 5), (646, 60, 18, 9)],
)
def test_three_ears_in_a_row_never_go_through_each_other(size, inflated, body, ear):
    text = IN_A_ROW.format(size=size, inflated=inflated, body=body, ear=ear)
    quality = watched(Recipe.parse(text))
    assert not crossings(quality)
    found = quality.data()
    assert found is not None
    assert found["joints"]["lost"] == []
