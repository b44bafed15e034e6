"""Where the joints of a chain go while its ends are brought together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.operations.moves import ACROSS, POINTS
from balloon_usd.solver.motions.closing import ClosingChain, central_angles
from balloon_usd.solver.motions.smooth import smooth

ALONG, UP, LEFT = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]), np.array([0.0, -1.0, 0.0])
GAP = 0.005
sides = st.lists(st.floats(0.02, 0.2), min_size=3, max_size=8)


def test_a_chain_begins_straight_along_the_balloon():
    pose = ClosingChain(np.array([0.1, 0.07, 0.12]), ALONG, UP, LEFT, GAP).pose(0.0)
    assert pose[:, 0] == pytest.approx([-0.29, -0.19, -0.12, 0.0])
    assert pose[:, 1:] == pytest.approx(0.0)


def test_a_closed_pair_of_bubbles_points_where_it_was_told_with_its_ends_across_the_balloon():
    pose = ClosingChain(np.array([0.1, 0.1]), ALONG, UP, LEFT, GAP).pose(1.0)
    assert pose[1] == pytest.approx([0.0, -GAP / 2, 0.1], abs=2e-3)
    assert pose[0] == pytest.approx([0.0, -GAP, 0.0], abs=1e-4)


def closed_pair(point):
    """Joints of a pair that was told to go somewhere."""
    ways = np.array(POINTS[point]), np.array(ACROSS[point])
    return ClosingChain(np.array([0.1, 0.1]), ALONG, *ways, GAP).pose(1.0)


@pytest.mark.parametrize("point", ["up", "down", "forward", "back"])
def test_the_first_bubble_of_a_pair_comes_to_lie_left(point):
    assert closed_pair(point)[0] == pytest.approx([0.0, -GAP, 0.0], abs=1e-4)


def test_a_pair_that_points_left_is_the_mirror_image_of_one_that_points_right():
    assert closed_pair("left") * (1.0, -1.0, 1.0) == pytest.approx(closed_pair("right"), abs=1e-12)
    assert closed_pair("left")[0] == pytest.approx([0.0, 0.0, GAP], abs=1e-4)


def test_bubbles_of_unequal_length_do_not_tilt_the_closed_pair():
    pose = ClosingChain(np.array([0.11, 0.1]), ALONG, UP, LEFT, GAP).pose(1.0)
    assert pose[0][2] == pytest.approx(0.0, abs=1e-3)


@given(sides, st.floats(0.0, 1.0))
def test_bubbles_keep_their_lengths_on_the_way(lengths, progress):
    given_lengths = np.array(lengths)
    if given_lengths.max() > 0.9 * (given_lengths.sum() - given_lengths.max()):
        return
    pose = ClosingChain(given_lengths, ALONG, UP, LEFT, GAP).pose(progress)
    found = np.linalg.norm(np.diff(pose, axis=0), axis=1)
    assert found == pytest.approx(given_lengths, abs=1.1 * GAP)


@given(sides)
def test_a_closed_chain_lies_on_a_circle(lengths):
    given_lengths = np.array(lengths)
    angles = central_angles(given_lengths)
    assert angles.sum() == pytest.approx(2.0 * np.pi, rel=1e-6)
    if given_lengths.max() < 0.9 * (given_lengths.sum() - given_lengths.max()):
        radius = given_lengths / (2.0 * np.sin(angles / 2.0))
        assert radius == pytest.approx(radius[0], rel=1e-4)


def test_a_single_side_cannot_close():
    with pytest.raises(ValueError, match="two or more sides"):
        central_angles(np.array([0.1]))


def test_smooth_progress_starts_and_ends_at_rest():
    assert smooth(0.0) == 0.0
    assert smooth(1.0) == 1.0
    assert smooth(1e-3) < 1e-7
    assert 1.0 - smooth(1.0 - 1e-3) < 1e-7
