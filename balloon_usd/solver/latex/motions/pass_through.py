"""Bringing a bubble into a closed ring of others."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.motions.into_ring import IN_PLANE, IntoRing, RingPlane
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

SPREAD = 0.2
"""Share of the time after which the ring is spread."""
ENTERS = 0.12
"""Share from which on the bubble swings."""
PASSED = 0.6
"""Share at which it has passed, and both begin to turn back."""
RELEASED = 0.55
"""Share from which on the ring is let close."""
ALIGNED = 0.35
"""Share of its swing at which a bubble that hung aside has come into the plane of the swing."""
ON_AXIS = 0.3
"""Distance from the plane in which the bubble swings, in that of the farthest, within which a place of the
ring is led in that plane only, and comes nearer as the sides are spread.
"""
BENT_WITHIN = math.radians(60.0)
"""Angle to the plane of the ring within which a bubble that is too long for the hole is bent."""
CLEFT = 0.25
"""Way from the joint at the far end of a ring to where its sides part, in widths of what passes."""


class PassThrough(IntoRing):
    """A bubble that is swung about its held end through a ring of others."""

    def __init__(self, move: moves.PassThrough, sculpture: LatexSculpture) -> None:
        """Take hold of both and of all that hangs on them."""
        super().__init__(move, sculpture, len(move.led))
        self._way = _Way(self._began, self._whole, move)
        self._spread, shares = self._spread_aside(self._way.plane, move.width)
        self._on_axis = self._opening[np.abs(shares) < ON_AXIS]

    def advance(self, share: float) -> None:
        """Spread the ring, swing the bubble through, let the ring close, and turn both back."""
        spread = smooth(share / SPREAD) * (1.0 - smooth((share - RELEASED) / (1.0 - RELEASED)))
        back = self._way.back(smooth((share - PASSED) / (1.0 - PASSED)))
        ring = (self._ring + spread * self._spread) @ back.T
        self._lead(ring, self._way.places(smooth((share - ENTERS) / (PASSED - ENTERS))) @ back.T)
        self._hands.free[self._on_axis] = back @ self._way.plane.inward


class _Way:
    """Where the rings of the bubble go, seen from its held end."""

    def __init__(self, began: Floats, ring: Floats, move: moves.PassThrough) -> None:
        """Find the plane in which it swings.

        `began`: its rings, away from its held end; `ring`: those that it passes, in order round; (N, 3), m.
        """
        self._length = float(np.linalg.norm(began[-1]))
        self._points = began[-1] / self._length
        self.plane = RingPlane.of(ring, self._points)
        normal, inward = self.plane.normal, self.plane.inward
        self._began, self._move = began, move
        self._shares = np.linalg.norm(began, axis=1)[:, None] / self._length
        within = self._points - self.plane.aside * float(self._points @ self.plane.aside)
        flat = float(np.linalg.norm(within))
        # What hangs straight aside comes up to the ring first.
        self._within = within / flat if flat > IN_PLANE else normal
        self._aligning = turn_between(self._points, self._within)
        self._sweep = math.atan2(float(self._within @ normal), float(self._within @ inward)) + move.beyond
        self._passing = self._free_depth(ring)
        self._back = self._way_back()

    def _free_depth(self, ring: Floats) -> float:
        """Return how far from its held end its other end passes the ring, m."""
        far = float((ring @ self.plane.inward).max())
        inside = sum(each @ self.plane.inward > 0.9 * far for each in ring) > 1
        free = far - (0.5 * self._move.tube if inside else CLEFT * self._move.width)
        return min(self._length, max(free, self._move.width))

    def _way_back(self) -> tuple[Floats, float]:
        """Return the axis and the angle (rad) of the turn after which it points where it shall."""
        if self._move.point is None and float(self._points @ self._within) > 1.0 - IN_PLANE:
            return self.plane.aside, self._sweep
        target = self._points if self._move.point is None else np.array(self._move.point)
        return turn_between(turn_about(self.plane.aside, -self._sweep) @ self._within, target)

    def back(self, progress: float) -> Floats:
        """Return the turn of all, (3, 3), until the bubble points where it shall; `progress`: 0 to 1."""
        axis, angle = self._back
        return turn_about(axis, progress * angle)

    def places(self, progress: float) -> Floats:
        """Return where its rings are, (N, 3), m; `progress`: 0 where they began, 1 beyond the ring.

        One that is too long for the hole is bent on its way, its middle ahead.
        """
        move = self._move
        angle = self._sweep * (1.0 - progress) - move.beyond
        if move.dip > 0.0:
            chord = self._length + (self._passing - self._length) * smooth(progress)
            bow = move.dip * smooth(1.0 - angle / BENT_WITHIN)
        else:
            bent = max(0.0, math.cos(0.5 * math.pi * min(abs(angle) / BENT_WITHIN, 1.0)))
            chord = self._length + bent * (self._passing - self._length)
            # Of a flat arc: its length is chord + 8/3 bow^2 / chord.
            bow = math.sqrt(0.375 * chord * (self._length - chord))
        axis, most = self._aligning
        aligned = turn_about(axis, most * smooth(progress / ALIGNED))
        ahead = -np.cross(self.plane.aside, self._within)
        straight = (self._began * (chord / self._length)) @ aligned.T
        bowed = straight + 4.0 * bow * self._shares * (1.0 - self._shares) * ahead
        turned: Floats = bowed @ turn_about(self.plane.aside, -self._sweep * progress).T
        return turned
