"""Round balloons that are blown up farther than they will be: rubber that was stretched so is softer."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.burst import burst_load
from balloon_usd.balloon.roots import root
from balloon_usd.balloon.rubber import UnloadedRubber

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Floats, Rubber
    from balloon_usd.balloon.sizes import BalloonSize

EGG_LOAD = 0.8
"""Load of a round balloon that is blown up beyond full, in that of a ball as wide: 0.78 to 0.80 in
simulations of both sizes, up to 82 % of what bursts them.
"""
_LARGEST_STRETCH = 12.0
"""Stretch of a ball beyond which none is sought."""


def softened_by(rubber: Rubber, size: BalloonSize, width: float) -> UnloadedRubber:
    """Return the rubber of a round balloon that was blown up to a width (m), as in a ball."""
    stretch = 0.5 * width / size.radius
    return UnloadedRubber(rubber, float(rubber.energy(stretch, stretch)))


def load_of(rubber: Rubber, size: BalloonSize, width: float) -> float:
    """Return the load of a round balloon that is blown up to a width (m), 1 where it bursts."""
    stretch = 0.5 * width / size.radius
    wall = 4.0 * math.pi * size.radius**2 * size.thickness
    return EGG_LOAD * burst_load(rubber, [wall], [rubber.energy(stretch, stretch)])


def bursting_width(rubber: Rubber, size: BalloonSize, load: float = 1.0) -> float:
    """Return the width (m) at which a round balloon bursts, or has another load."""

    def left(width: Floats) -> Floats:
        return np.asarray(load - load_of(rubber, size, float(width)))

    flat = 2.0 * size.radius
    return float(root(left, 1.5 * flat, _LARGEST_STRETCH * flat))
