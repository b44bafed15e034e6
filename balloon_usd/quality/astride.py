"""How far a bubble lies between two others, or in the hole of a loop."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from balloon_usd.quality.solid_angle import WHOLE, solid_angles

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

ASTRIDE = 0.25
"""Share beyond which a bubble is held by others: one that lies on two that touch each other has 0.33, one in
the midst of a hole 0.5, and 0.36 to 0.46 in simulations, and below 0.1 where it has slipped out.
"""
WIDE = 0.5
"""Share of its largest radius from which on a ring of a bubble counts: its caps touch at a common joint."""
TOUCHES = 0.3
"""Largest distance of walls that touch, in the radius of a bubble: rings are no walls, and walls lie apart by
the distance at which they begin to press, 2.8 mm on a 260 in draft.
"""


class Tube(NamedTuple):
    """Where the wide rings of a bubble are."""

    middles: Floats
    """(R, 3), m."""
    radii: Floats
    """(R,), m."""

    @classmethod
    def of(cls, corners: Floats) -> Self:
        """Find those of the rings of a bubble; `corners`: (R, N, 3), m."""
        middles = corners.mean(axis=1)
        radii = np.linalg.norm(corners - middles[:, None], axis=2).mean(axis=1)
        wide = radii >= WIDE * radii.max()
        return cls(middles[wide], radii[wide])

    def nearest(self, other: Tube) -> tuple[float, Floats]:
        """Return how far its wall is from that of another where they are nearest, in its radius there, and
        the unit way there, (3,).
        """
        between = other.middles[None] - self.middles[:, None]
        far = np.linalg.norm(between, axis=2)
        gaps = far - self.radii[:, None] - other.radii[None]
        at = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        return float(gaps[at] / self.radii[at[0]]), between[at] / max(float(far[at]), 1e-9)


def share_between(own: Tube, one: Tube, other: Tube) -> float:
    """Return the angle between the ways from a bubble to the nearest walls of two others, in half turns; 0
    where it does not touch both.
    """
    gaps, ways = zip(*(own.nearest(side) for side in (one, other)), strict=True)
    if max(gaps) > TOUCHES:
        return 0.0
    return math.acos(max(-1.0, min(1.0, float(ways[0] @ ways[1])))) / math.pi


def share_in_hole(own: Tube, loop: Tube) -> float:
    """Return the share of the solid angle round the middle of a bubble that a loop fills, 0.5 in its plane;
    0 where they do not touch.
    """
    if own.nearest(loop)[0] > TOUCHES:
        return 0.0
    return abs(float(solid_angles(own.middles.mean(axis=0)[None], loop.middles)[0])) / WHOLE
