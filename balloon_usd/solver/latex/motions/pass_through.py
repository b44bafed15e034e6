"""Bringing a bubble into a closed ring of others."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
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
WIDENED = 0.35
"""How far each side of a ring is spread, in widths of the bubble that passes: spread by a half, its far end
came so near that the free end of the bubble went over it, and not through.
"""
PUSHING, SPREADING = 30.0, 25.0
"""Largest force of a hand on a ring of the bubble, and on one of the ring that it passes, N: half of what a
thumb and a finger press. With 20 and 15 one roll of three got stuck.
"""
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
IN_PLANE = 0.1
"""Sine of the angle to that plane below which a bubble lies on neither side of it."""


class PassThrough(Motion):
    """A bubble that is swung about its held end through a ring of others."""

    def __init__(self, move: moves.PassThrough, sculpture: LatexSculpture) -> None:
        """Take hold of both and of all that hangs on them."""
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
        hands.lead_firmly(self._led, PUSHING)
        hands.lead_firmly(self._opening, SPREADING)

        self._base: Floats = middle[base].astype(np.float64)
        self._began: Floats = middle[self._led] - self._base
        self._ring: Floats = middle[self._opening] - self._base
        whole = middle[[joints[ring] for ring in move.opening]] - self._base
        self._way = _Way(self._began, whole, move)
        aside = self._ring @ self._way.aside
        widest = max(float(np.abs(aside).max()), 1e-6)
        self._spread = WIDENED * move.width * (aside / widest)[:, None] * self._way.aside
        self._on_axis = self._opening[np.abs(aside) < ON_AXIS * widest]

    def advance(self, share: float) -> None:
        """Spread the ring, swing the bubble through, let the ring close, and turn both back."""
        spread = smooth(share / SPREAD) * (1.0 - smooth((share - RELEASED) / (1.0 - RELEASED)))
        back = self._way.back(smooth((share - PASSED) / (1.0 - PASSED)))
        ring = (self._ring + spread * self._spread) @ back.T
        led = self._way.places(smooth((share - ENTERS) / (PASSED - ENTERS))) @ back.T
        hands = self._hands
        hands.goal[self._opening], hands.goal[self._led] = self._base + ring, self._base + led
        hands.free[self._on_axis] = back @ self._way.inward
        shifts = np.concatenate([ring - self._ring, (led - self._began)[-1:]])
        hands.goal[self._carried.joints] = self._carried.goals(shifts)


class _Way:
    """Where the rings of the bubble go, seen from its held end."""

    def __init__(self, began: Floats, ring: Floats, move: moves.PassThrough) -> None:
        """Find the plane in which it swings.

        `began`: its rings, away from its held end; `ring`: those that it passes, in order round; (N, 3), m.
        """
        hole = ring.mean(axis=0)
        self.inward: Floats = hole / max(float(np.linalg.norm(hole)), 1e-9)
        """Unit direction into the hole."""
        around = ring - hole
        normal = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
        normal -= self.inward * float(normal @ self.inward)
        normal /= max(float(np.linalg.norm(normal)), 1e-9)
        self._length = float(np.linalg.norm(began[-1]))
        self._points = began[-1] / self._length
        if float(self._points @ normal) < -IN_PLANE:
            normal = -normal
        self.aside: Floats = np.cross(self.inward, normal)
        """Unit axis about which it swings back."""
        self._began, self._move = began, move
        self._shares = np.linalg.norm(began, axis=1)[:, None] / self._length
        within = self._points - self.aside * float(self._points @ self.aside)
        flat = float(np.linalg.norm(within))
        # What hangs straight aside comes up to the ring first.
        self._within = within / flat if flat > IN_PLANE else normal
        self._aligning = turn_between(self._points, self._within)
        self._sweep = (
            math.atan2(float(self._within @ normal), float(self._within @ self.inward)) + move.beyond
        )
        self._passing = self._free_depth(ring)
        self._back = self._way_back()

    def _free_depth(self, ring: Floats) -> float:
        """Return how far from its held end its other end passes the ring, m."""
        far = float((ring @ self.inward).max())
        inside = sum(each @ self.inward > 0.9 * far for each in ring) > 1
        free = far - (0.5 * self._move.tube if inside else CLEFT * self._move.width)
        return min(self._length, max(free, self._move.width))

    def _way_back(self) -> tuple[Floats, float]:
        """Return the axis and the angle (rad) of the turn after which it points where it shall."""
        if self._move.point is None and float(self._points @ self._within) > 1.0 - IN_PLANE:
            return self.aside, self._sweep
        target = self._points if self._move.point is None else np.array(self._move.point)
        return turn_between(turn_about(self.aside, -self._sweep) @ self._within, target)

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
        ahead = -np.cross(self.aside, self._within)
        straight = (self._began * (chord / self._length)) @ aligned.T
        bowed = straight + 4.0 * bow * self._shares * (1.0 - self._shares) * ahead
        turned: Floats = bowed @ turn_about(self.aside, -self._sweep * progress).T
        return turned
