"""How legs are bent so that all feet stand on one plane."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.levelling import MOST, Feet, feet_of, levelling_turns
from balloon_usd.solver.rotations import rotation

BALL = 0.01 * np.stack(
    [
        [np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)]
        for a in np.linspace(0.0, np.pi, 40)
        for b in np.linspace(0.0, 2.0 * np.pi, 40)
    ]
)
"""Vertices of a foot about its middle, m."""
PLACES = np.array([[0.0, -0.02, 0.0], [0.0, 0.02, 0.0], [0.16, -0.02, 0.0], [0.16, 0.02, 0.0]])
"""Middles of four feet, m."""
JOINTS = np.array([[0.0, 0.0, 0.1], [0.16, 0.0, 0.1]])
"""Where the fore and the hind legs hang, m."""
PAIRS = (0, 0, 1, 1)


def feet(*heights: float) -> list[np.ndarray]:
    """Four feet so far above the ground, m."""
    return [BALL + place + [0.0, 0.0, high] for place, high in zip(PLACES, heights, strict=True)]


def bent(walls: list[np.ndarray], turns: np.ndarray) -> list[np.ndarray]:
    """The same with their legs turned."""
    return [
        JOINTS[leg] + (points - JOINTS[leg]) @ rotation(turns[leg]).T
        for points, leg in zip(walls, PAIRS, strict=True)
    ]


def test_feet_on_one_plane_are_level_however_the_figure_leans():
    lean = rotation(np.array([0.1, -0.2, 0.0]))
    found = Feet.on_plane([points @ lean.T for points in feet(0.0, 0.0, 0.0, 0.0)], np.eye(3))
    assert np.abs(found.height).max() < 2e-5
    # How far it is turned about the vertical does not matter.
    assert found.turn @ lean @ [0.0, 0.0, 1.0] == pytest.approx([0.0, 0.0, 1.0], abs=2e-3)


def test_legs_are_bent_until_all_feet_touch_one_plane():
    walls = feet(0.0, 0.0, 0.004, 0.0)
    assert np.abs(Feet.on_plane(walls, np.eye(3)).height).max() == pytest.approx(0.001, rel=0.05)
    turns = levelling_turns(walls, PAIRS, JOINTS, np.eye(3))
    # Both pairs turn, each the other way, about the line from one to the other.
    assert turns[0, 0] == pytest.approx(-turns[1, 0], rel=0.1)
    assert np.abs(turns[:, 0]).max() < 0.08
    assert np.abs(Feet.on_plane(bent(walls, turns), np.eye(3)).height).max() < 3e-5


def test_a_foot_of_no_leg_stays_where_it_is():
    walls = feet(0.0, 0.0, 0.004, 0.0)
    turns = levelling_turns(walls, (-1, -1, 0, 0), JOINTS[1:], np.eye(3))
    after = bent(walls, np.array([[0.0, 0.0, 0.0], *turns]))
    assert np.abs(Feet.on_plane(after, np.eye(3)).height).max() < 3e-5


def test_no_leg_is_bent_far():
    turns = levelling_turns(feet(0.0, 0.0, 0.05, 0.0), PAIRS, JOINTS, np.eye(3))
    assert np.linalg.norm(turns, axis=1).max() == pytest.approx(MOST)


def test_feet_are_what_touches_the_ground_and_what_is_like_it_and_nearly_does():
    walls = dict(zip(("a", "b", "c", "nose"), feet(0.0, 0.0, 0.004, 0.003), strict=True))
    alike = [frozenset({"a", "b", "c"}), frozenset({"nose"})]
    assert feet_of(walls, alike, 5e-4, 0.012) == ("a", "b", "c")
    assert feet_of(walls, alike, 5e-4, 0.002) == ("a", "b")
    assert feet_of(walls, [], 5e-4, 0.012) == ("a", "b")
