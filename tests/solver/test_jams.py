"""A jam that lasts is a failure, and says which bubbles are in each other's way."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.frame_arrays import Place
from balloon_usd.solver.latex.jams import LONGEST_JAM, Jams
from tests.solver.locked_pair import locked_pair
from tests.solver.small_plan import small

FPS = 24.0
MOST = round(LONGEST_JAM * FPS)
"""Frames that a jam lasts."""


@pytest.fixture
def jams():
    """Of a bubble and a rest, and of a locked pair, one after the other in the arrays of a frame."""
    plans = small(), locked_pair()
    ends = np.cumsum([len(plan.bubbles) for plan in plans]).tolist()
    bubbles = slice(0, ends[0]), slice(ends[0], ends[1])
    return Jams(plans, [Place((), each, ()) for each in bubbles], FPS), plans, bubbles


def jammed(bubbles: slice, of_these: list[int], count: int) -> np.ndarray:
    found = np.zeros(count, dtype=np.int32)
    found[np.array(of_these, dtype=int) + bubbles.start] = 1
    return found


def test_a_jam_that_lasts_names_the_bubbles_in_each_others_way(jams):
    watch, plans, bubbles = jams
    count = bubbles[1].stop
    for k in range(MOST):
        assert watch.causes() == {}
        watch.note(jammed(bubbles[1], [1, 2] if k > 2 else [1], count))
    names = [bubble.name for bubble in plans[1].bubbles]
    assert list(watch.causes()) == [1]
    assert watch.causes()[1].startswith(f"{names[1]} and {names[2]} are jammed: for 0.75 s ")


def test_a_bubble_that_only_joins_in_the_end_is_not_named(jams):
    watch, plans, bubbles = jams
    for k in range(MOST):
        watch.note(jammed(bubbles[1], [1, 0] if k > MOST - 3 else [1], bubbles[1].stop))
    assert watch.causes()[1].startswith(f"{plans[1].bubbles[1].name} is jammed: ")


def test_a_jam_that_comes_loose_is_forgotten(jams):
    watch, _, bubbles = jams
    for k in range(3 * MOST):
        watch.note(jammed(bubbles[1], [] if k % MOST == MOST - 1 else [1, 2], bubbles[1].stop))
        assert watch.causes() == {}
