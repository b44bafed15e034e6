"""Closing a chain of bubbles: where its joints go while its two ends are brought together.

The joints of a closed chain lie on a circle; on the way every joint has the same share of its final turning
angle, so that the bubbles keep their lengths. The held end stays at the origin, the other end comes along the
balloon, the chain rises to the side that it shall point to, and is turned across the balloon at the end, as a
maker does.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.smooth import smooth

Floats = NDArray[np.float64]

TURN_ACROSS_FROM = 0.45
"""Progress at which the chain begins to be turned across the balloon."""
LONGEST_SIDE = 0.98
"""A side longer than this share of all the others together cannot close; it is taken as this long."""


def central_angles(lengths: Floats) -> Floats:
    """Return the angles (radians) under which the circle round a closed polygon sees its sides.

    `lengths`: (sides,) m, at least two.

    Raises:
        ValueError: fewer than two sides, or a length that is not positive.
    """
    if len(lengths) < 2 or np.any(lengths <= 0.0):
        raise ValueError("a closed chain needs two or more sides of positive length")
    if len(lengths) == 2:
        return np.full(2, math.pi)
    sides = lengths.copy()
    longest = int(np.argmax(sides))
    sides[longest] = min(sides[longest], LONGEST_SIDE * (sides.sum() - sides[longest]))
    others = np.delete(sides, longest)
    inside = np.sum(np.arcsin(np.minimum(others / sides[longest], 1.0))) >= 0.5 * math.pi
    low, high = 0.5 * sides[longest], 1e3 * sides.sum()
    for _ in range(100):
        radius = math.sqrt(low * high)
        half = np.arcsin(np.minimum(sides / (2 * radius), 1.0))
        rest = float(half.sum() - half[longest])
        excess = rest + half[longest] - math.pi if inside else half[longest] - rest
        low, high = (radius, high) if excess > 0.0 else (low, radius)
    angles = 2.0 * np.arcsin(np.minimum(sides / (2 * radius), 1.0))
    if not inside:
        angles[longest] = 2.0 * math.pi - angles.sum() + angles[longest]
    return angles


class ClosingChain:
    """A chain of bubbles whose ends are brought together."""

    def __init__(
        self,
        lengths: Floats,
        along: Floats,
        point: Floats,
        across: Floats,
        gap: float,
        *,
        turned: bool = True,
    ) -> None:
        """Take the sides from the first joint to the last, (sides,) m.

        `along`: unit direction of the balloon beyond the held joint. `point`: unit direction, across `along`,
        to which the chain rises. `across`: unit direction, across both, in which its first side lies in the
        end. `gap`: distance that stays between first and last joint, m. `turned`: whether the chain is turned
        across the balloon in the end.
        """
        if len(lengths) == 2:
            # Two sides lie on each other when closed: as unequal sides they would tilt.
            lengths = np.full(2, lengths.mean())
        self._sides: list[float] = lengths[::-1].tolist()
        self._angles: list[float] = central_angles(lengths)[::-1].tolist()
        self._back, self._point, self._across = -along, point, across
        self._gap = gap
        self._turn = 0.5 * math.pi if turned else 0.0

    def pose(self, progress: float) -> Floats:
        """Return the joints, (sides + 1, 3) float64, m, relative to the held last one.

        `progress`: 0 straight, 1 closed.
        """
        share = min(max(progress, 0.0), 1.0) * (1.0 - 1e-4)
        flat = self._flat(share)
        far = math.hypot(*flat[-1])
        cosine, sine = flat[-1][0] / far, flat[-1][1] / far
        slack = max(self._gap - far, 0.0) / len(self._sides)
        across = self.across(share)
        # Numbers one by one: for so few joints, arrays take three times as long.
        places = [(cosine * x + sine * y + slack * k, cosine * y - sine * x) for k, (x, y) in enumerate(flat)]
        return np.asarray(np.array(places[::-1]) @ np.array([across, self._point]))

    def across(self, progress: float) -> Floats:
        """Return the unit direction, (3,), across its point, from the held joint to the first one."""
        turned = self._turn * smooth((progress - TURN_ACROSS_FROM) / (1.0 - TURN_ACROSS_FROM))
        return math.cos(turned) * self._back + math.sin(turned) * self._across

    def _flat(self, share: float) -> list[tuple[float, float]]:
        """Return the joints in the plane of the chain, from the held one on, m.

        `share`: of its turning angles that the chain has.
        """
        x = y = heading = 0.0
        joints = [(x, y)]
        for k, side in enumerate(self._sides):
            if k:
                heading -= share * 0.5 * (self._angles[k - 1] + self._angles[k])
            x, y = x + side * math.cos(heading), y + side * math.sin(heading)
            joints.append((x, y))
        return joints
