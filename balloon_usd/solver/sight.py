"""Sights: what was seen of all sculptures of a flat state at one time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Sight:
    """Flat arrays of all sculptures, one after another, that do not change any more: frames are views of
    them.
    """

    points: NDArray[np.float32]
    """Vertex positions, (V, 3) float32, m."""
    stretch: NDArray[np.float32]
    """Largest principal stretch at every vertex, (V,) float32."""
    pressure: NDArray[np.float32]
    """Gauge pressure of every bubble, (bubbles,) float32, Pa."""
    volume: NDArray[np.float32]
    """Gas volume of every bubble, (bubbles,) float32, m3."""
