"""The wall at the tip of a balloon, which is thicker where the former was dipped deepest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

TIP_THICKENING = 0.5
"""Share by which the wall is thicker at the tip."""
TIP_LENGTH = 1.0
"""Length over which that fades, in radii at the knot."""


def tip_thickening(from_tip: ArrayLike, radius: float) -> NDArray[np.float64]:
    """Return how many times as thick a wall is as elsewhere, by its distances from the tip, m, of any shape.

    `radius`: of the balloon at its knot, m.
    """
    return np.asarray(1.0 + TIP_THICKENING * np.exp(-np.asarray(from_tip) / (TIP_LENGTH * radius)))
