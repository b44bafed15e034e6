"""Roots of many functions at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.balloon.rubber import Floats

_MOST_STEPS = 200
_WIDTH = 4.0 * float(np.finfo(np.float64).eps)


def root(excess: Callable[[Floats], Floats], low: Floats | float, high: Floats | float) -> Floats:
    """Return where `excess` falls through zero between two ends, for each of them and of their shape.

    An excess that is no number counts as below zero; without a change of sign the nearer end is returned.
    Chandrupatla 1997: inverse quadratic interpolation where it is safe, else halving: a fifth of the steps
    of halving alone. scipy.optimize takes longer to import than all roots of a plan take.
    """
    newest, other = np.broadcast_arrays(np.asarray(low, np.float64), np.asarray(high, np.float64))
    with np.errstate(all="ignore"):
        at_newest, at_other = excess(newest), excess(other)
        found = np.where(at_newest > 0.0, other, newest)
        searched = (at_newest > 0.0) & ~(at_other > 0.0)
        share: Floats | float = 0.5
        for _ in range(_MOST_STEPS):
            if not searched.any():
                break
            tried = newest + share * (other - newest)
            at_tried = excess(tried)
            same = (at_tried > 0.0) == (at_newest > 0.0)
            third, at_third = np.where(same, newest, other), np.where(same, at_newest, at_other)
            other, at_other = np.where(same, other, newest), np.where(same, at_other, at_newest)
            newest, at_newest = tried, at_tried
            best = np.where(np.abs(at_newest) < np.abs(at_other), newest, other)
            found = np.where(searched, best, found)
            least = _WIDTH * np.abs(best) / np.abs(other - newest)
            searched &= (least < 0.5) & (at_newest != 0.0)
            share = np.clip(_share(newest, other, third, at_newest, at_other, at_third), least, 1.0 - least)
    return np.asarray(found)


def _share(x1: Floats, x2: Floats, x3: Floats, f1: Floats, f2: Floats, f3: Floats) -> Floats:
    """Return how far from x1 towards x2 the next point lies."""
    xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
    safe = (phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi)
    inverse = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
    return np.where(safe, inverse, 0.5)
