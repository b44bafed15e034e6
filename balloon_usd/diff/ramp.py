"""Distances as colours."""

from __future__ import annotations

from math import floor, log10
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

STOPS = ((226, 226, 222), (255, 214, 92), (250, 136, 42), (214, 40, 58), (112, 14, 88))
"""From where nothing moved to the largest distance, sRGB: each is darker than the one before."""
ROUNDING = 1e-3
STEPS = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


def ramp(shares: Floats) -> Floats:
    """Return sRGB 0..255 (N, 3) for shares (N,) of the largest distance."""
    places = np.linspace(0.0, 1.0, len(STOPS))
    stops = np.array(STOPS, dtype=np.float64)
    return np.stack([np.interp(shares, places, stops[:, channel]) for channel in range(3)], axis=-1)


def linear(colors: Floats) -> NDArray[np.float32]:
    """Turn sRGB 0..255 into linear rgb 0..1 (IEC 61966-2-1)."""
    share = colors / 255.0
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4).astype(np.float32)


def end_of_scale(largest: float) -> float:
    """Return the next round number that is not below a distance (m), but for its rounding."""
    if largest <= 0.0:
        return 1e-3
    power = 10.0 ** floor(log10(largest))
    # What is 8 mm but for rounding must not end at 10.
    return next(step * power for step in STEPS if step * power >= largest * (1.0 - ROUNDING))
