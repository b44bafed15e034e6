"""When latex bursts: the load of a whole wall, from the elastic energy in all its parts.

A wall tears at its weakest place, a thin spot or a pinhole. Such places are scattered over the rubber, so a
small part of it bears more than all of it would: the weakest link of Weibull 1939. The length over which
rubber tears is about 0.2 mm (Volokh 2011), the thickness of the wall and below any mesh, so a mean
over that length would change nothing.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.roots import root
from balloon_usd.balloon.rubber import BURST_STRETCH
from balloon_usd.balloon.tube_theory import LARGEST_STRETCH

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from balloon_usd.balloon.rubber import Rubber

SCATTER = 8.0
"""Weibull's exponent of the energy at which latex bursts: it scatters by 15 % (judged)."""

ALONG = 5.39
"""Stretch along a closed tube of "ogden" whose hoop stretch is `BURST_STRETCH`."""
WHOLE = 1.87e-6
"""Rubber of a 260, m3, for which `BURST_STRETCH` holds: a quarter of it bears 19 % more energy."""


@lru_cache(maxsize=64)
def burst_energy(rubber: Rubber) -> float:
    """Return the energy, J/m3, at which a 260 of this rubber bursts that is stretched alike all over.

    In "ogden" it is 24.8 MJ/m3. A strip with that energy is stretched to 8.4 times its length: the elongation
    of 750 % that ASTM D3577 asks of natural latex.
    """
    return float(rubber.energy(BURST_STRETCH, ALONG))


@lru_cache(maxsize=64)
def least_burst_stretch(rubber: Rubber) -> float:
    """Return the stretch in all directions at which a wall of this rubber has its `burst_energy`."""
    limit = burst_energy(rubber)
    return float(root(lambda stretch: limit - rubber.energy(stretch, stretch), 1.0, LARGEST_STRETCH))


def burst_load(rubber: Rubber, volumes: ArrayLike, energies: ArrayLike) -> float:
    """Return the load of a wall, 1 where it bursts: of a 260 with one energy, that over `burst_energy`.

    Args:
        rubber: of the wall.
        volumes: of the rubber in parts of the wall, m3.
        energies: of these parts, J/m3, of the same shape; parts left out have none.
    """
    relative = np.asarray(energies, dtype=np.float64) / burst_energy(rubber)
    return float(np.sum(np.asarray(volumes) / WHOLE * relative**SCATTER) ** (1.0 / SCATTER))
