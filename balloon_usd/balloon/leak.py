"""Leak: the gas that permeates through stretched latex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

BARRER = 3.348e-16
"""Unit of permeability, mol m / (m2 s Pa)."""
NITROGEN = 8.0
"""Permeability of natural rubber, barrer (handbook value; stretched rubber lets through less)."""
OXYGEN = 23.0
"""The same."""
AIR = 0.79 * NITROGEN + 0.21 * OXYGEN
"""Permeability of natural rubber for air, barrer: each gas is driven by its share of the pressure."""


def conductance(area: ArrayLike, rubber: ArrayLike) -> NDArray[np.float64]:
    """Return how much air a piece of wall lets through for each pascal of gauge pressure, mol/(s Pa).

    Permeability times area over thickness, the thickness being that of rubber which keeps its volume.

    Args:
        area: of the stretched piece (m2).
        rubber: volume of its rubber (m3).
    """
    squared = np.square(np.asarray(area, dtype=np.float64))
    return np.asarray(AIR * BARRER * squared / np.asarray(rubber, dtype=np.float64))
