from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from balloon_usd.balloon.rubber import BURST_STRETCH
from balloon_usd.stage import StageError
from balloon_usd.stage.stretch_color import RAMP, SHADES, stretch_colors
from tests.stage.tubes import sculpture


def oklab(linear: NDArray[np.float32]) -> NDArray[np.float64]:
    """Colours (N, 3), linear rgb, as lightness, green to red, blue to yellow (Ottosson 2020)."""
    to_cones = [[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
                [0.0883024619, 0.2817188376, 0.6299787005]]  # fmt: skip
    to_lab = [[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099],
              [0.0259040371, 0.7827717662, -0.8086757660]]  # fmt: skip
    return np.cbrt(linear.astype(np.float64) @ np.transpose(to_cones)) @ np.transpose(to_lab)


def color(stretch: float, highest: float = 7.0) -> NDArray[np.float32]:
    return stretch_colors(np.array([stretch], dtype=np.float32), highest)[0]


def test_slack_is_blue_the_middle_pale_yellow_and_bursting_red() -> None:
    slack, middle, bursting = color(1.0), color(4.0), color(7.0)
    assert slack[2] > 5 * max(slack[0], slack[1])
    assert min(middle[0], middle[1]) > 0.8 > middle[2]
    assert bursting[0] > 8 * max(bursting[1], bursting[2])


def test_beyond_its_ends_the_ramp_stays_at_them() -> None:
    assert np.array_equal(color(0.2), color(1.0))
    assert np.array_equal(color(40.0), color(7.0))


def test_another_sculpture_may_have_another_range() -> None:
    assert np.array_equal(color(2.0, highest=3.0), color(4.0))


def test_steps_of_the_ramp_look_alike() -> None:
    steps = np.linalg.norm(np.diff(oklab(RAMP[::8]), axis=0), axis=1)
    assert steps.max() < 1.6 * steps.min()
    neighbours = np.linalg.norm(np.diff(oklab(RAMP), axis=0), axis=1)
    assert neighbours.max() < 0.01


def test_lightness_rises_to_the_middle_and_falls_again() -> None:
    light = np.diff(oklab(RAMP)[:, 0])
    assert (light[: SHADES // 2 - 1] > 0.0).all()
    assert (light[SHADES // 2 :] < 0.0).all()


def test_the_ramp_ends_where_latex_bursts() -> None:
    assert sculpture().highest_stretch == BURST_STRETCH


@pytest.mark.parametrize("highest", [1.0, float("inf"), float("nan")])
def test_a_range_that_is_none_is_refused(highest: float) -> None:
    with pytest.raises(StageError, match='"dog": highest stretch is'):
        sculpture(highest_stretch=highest)
