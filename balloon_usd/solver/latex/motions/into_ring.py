"""What hands take hold of to bring a bubble into a closed ring of others, and how the two lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

WIDENED = 0.35
"""How far each side of a ring is spread, in widths of the bubble that passes: spread by a half, its far end
came so near that the free end of the bubble went over it, and not through.
"""
PUSHING, SPREADING = 30.0, 25.0
"""Largest force of a hand on a ring of the bubble, and on one of the ring that it passes, N: half of what a
thumb and a finger press. With 20 and 15 one roll of three got stuck.
"""
IN_PLANE = 0.1
"""Sine of the angle to the plane of a ring below which a bubble lies on neither side of it."""


class RingPlane(NamedTuple):
    """How a ring lies, seen from a joint of it: unit directions, (3,)."""

    inward: Floats
    """Into its hole."""
    normal: Floats
    """Across it, to the side on which the bubble lies that shall pass."""
    aside: Floats
    """In its plane, across the way into its hole: the axis about which the bubble swings back."""

    @classmethod
    def of(cls, ring: Floats, points: Floats) -> Self:
        """Return that of a ring, (N, 3), m, in order round it; `points`: unit direction of the bubble."""
        hole = ring.mean(axis=0)
        inward = unit(hole)
        around = ring - hole
        normal = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
        normal = unit(normal - inward * float(normal @ inward))
        # One in the hole is on neither side; one behind it swings over the side that it is nearer to.
        least = -IN_PLANE if float(points @ inward) > 0.0 else 0.0
        if float(points @ normal) < least:
            normal = -normal
        return cls(inward, normal, np.cross(inward, normal))


class IntoRing(Motion):
    """A bubble that is led about its held end through a ring of others, which is spread meanwhile."""

    def __init__(
        self, move: moves.PassThrough, sculpture: LatexSculpture, firm: int, strength: float = 1.0
    ) -> None:
        """Take hold of both and of all that hangs on them.

        `firm`: how many rings of the bubble are held firmly; `strength`: share of the full forces of hands.
        """
        hands, joints, middle = sculpture.hands, sculpture.joints, sculpture.frame.middle
        self._hands = hands
        hands.touch(sculpture.bodies)
        base = joints[move.base]
        merged = {base, *(joint for weld in hands.welds_of([base]) for joint in weld)}
        opening = [ring for ring in move.opening if joints[ring] not in merged]
        self._led, self._opening = (np.array([joints[r] for r in rings]) for rings in (move.led, opening))
        # Struts would hold the pose against the hands, which hold all of it now.
        sculpture.struts.loosen(set(joints))
        hands.grip(base, middle)
        self._carried = sculpture.carry((*opening, move.led[-1], move.base))
        for joint in (*self._led, *self._opening):
            hands.lead(int(joint), middle)
        hands.lead_firmly(self._led[:firm], strength * PUSHING)
        hands.lead_firmly(self._opening, strength * SPREADING)

        self._base: Floats = middle[base].astype(np.float64)
        self._began: Floats = middle[self._led] - self._base
        """Where the rings of the bubble are, away from its held end, (N, 3), m."""
        self._ring: Floats = middle[self._opening] - self._base
        """The same of what is spread of the ring that they pass."""
        self._whole: Floats = middle[[joints[ring] for ring in move.opening]] - self._base
        """The same of all of that ring, in order round it."""

    def _spread_aside(self, plane: RingPlane, width: float) -> tuple[Floats, Floats]:
        """Return how far the ring is spread for a bubble of a width, (N, 3), m, and how far aside each place
        of it lies, in that of the farthest, (N,).
        """
        aside = self._ring @ plane.aside
        shares = aside / max(float(np.abs(aside).max()), 1e-6)
        return WIDENED * width * shares[:, None] * plane.aside, shares

    def _lead(self, ring: Floats, led: Floats) -> None:
        """Set where the hands go, with what hangs on both; (N, 3) each, m, from the held end."""
        hands = self._hands
        hands.goal[self._opening], hands.goal[self._led] = self._base + ring, self._base + led
        shifts = np.concatenate([ring - self._ring, (led - self._began)[-1:]])
        hands.goal[self._carried.joints] = self._carried.goals(shifts)
