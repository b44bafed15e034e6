"""Roots by halving: the same number of steps everywhere, so the same bits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from balloon_usd.balloon.rubber import Floats


def halved(
    short: Callable[[Floats], NDArray[np.bool_]], low: Floats | float, high: Floats | float, times: int
) -> Floats:
    """Return where `short` stops being true between two ends, for each of them and of their shape.

    scipy.optimize finds other last bits, and takes longer to import than all roots of a plan take.
    """
    with np.errstate(invalid="ignore"):
        for _ in range(times):
            middle = np.asarray(0.5 * (low + high))
            below = short(middle)
            low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.asarray(0.5 * (low + high))
