"""Pulling a long bubble through a closed ring of others."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.motions.into_ring import IntoRing, RingPlane
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

SPREAD = 0.15
"""Share of the time after which the ring is spread."""
ALIGNED = 0.18
"""Share after which the bubble bends in the plane that stands across the ring."""
BENT = 0.3
"""Share after which its end is before the hole."""
PULLED = 0.75
"""Share after which all but the bend is through."""
TAUT = 0.85
"""Share after which the bend is out, the ring begins to close, and both to turn back."""
RAISED = 0.35
"""How far the far end of the ring is spread, in widths of the bubble that passes."""
DIPPED = math.radians(40.0)
"""Angle by which the bubble leaves its held end away from the hole: its bend is wider than the hole is high.
"""
RISING = math.radians(25.0)
"""Angle by which what is through is led on away from what hangs before the held end."""
RISE = 3.0
"""Radius of that curve, in widths of the bubble."""
TIGHTEST = 0.75
"""Radius of the tightest bend, in widths of the bubble: a loop of 24 cm of a 260 is as tight."""
CLOSE = 0.3
"""Distance of the end of a row of bubbles from the hole when the bubble behind it is through, in widths."""
BEFORE = 0.6
"""Distance of the tip from the hole as it is led there, in widths of the bubble."""
FULL_FORCE = 0.05
"""Width of a tube from which on hands pull with all their force, m: with it they tore a 160."""
DRAWN = 0.15
"""How far hands draw it beyond its length: else a bend of a 260 stayed before a pair of 6 to 8 cm."""
PLACES = 2000
"""Places along the bubble at which its curve is found."""


class Thread(IntoRing):
    """A long bubble that is bent round, its end first pulled through a ring of others, and drawn taut."""

    def __init__(self, move: moves.Thread, sculpture: LatexSculpture) -> None:
        """Take hold of both; the flat tail is led lightly, for held firmly it fills with gas."""
        firm = len(move.led) - move.flat
        super().__init__(move, sculpture, firm, min(move.width / FULL_FORCE, 1.0))
        steps = np.diff(self._began, axis=0, prepend=np.zeros((1, 3)))
        self._along: Floats = np.cumsum(np.linalg.norm(steps, axis=1))
        points = unit(self._began[firm - 1])
        self._plane = plane = RingPlane.of(self._whole, points)
        aside, _ = self._spread_aside(plane, move.width)
        far = self._ring @ plane.inward
        self._spread = aside + RAISED * move.width * (far / far.max())[:, None] * plane.inward
        self._row = move.row
        before = float(self._along[move.row - 1]) + CLOSE * move.width if move.row else 0.0
        self._bow = _Bow(float((self._whole @ plane.inward).mean()), move.width, self._along, before)
        self._aligning = turn_between(points, plane.normal)
        self._end: Floats = -plane.normal
        """Unit direction of the bubble once it is taut."""
        if not move.row:
            self._end = math.cos(move.beyond) * plane.inward + math.sin(move.beyond) * self._end
        self._back = turn_between(self._end, points if move.point is None else np.array(move.point))
        self._off: Floats = np.zeros(3)
        self._off = self._began - self._bent(0.0)
        """How far the bubble is from straight at first, (N, 3), m."""

    def advance(self, share: float) -> None:
        """Spread the ring, bend the bubble round, pull it through until it is taut, and turn both back."""
        places = self._bent(share)
        turned = smooth((share - TAUT) / (1.0 - TAUT))
        if share > PULLED:
            # What is still before the ring follows by itself.
            follows = self._along < self._left(share)
            follows[: self._row] = False
            self._hands.mode[self._led[follows]] = 0
            taut = smooth((share - PULLED) / (TAUT - PULLED))
            places = places + taut * (self._taut(places, 1.0 + DRAWN * (1.0 - turned)) - places)
        axis, angle = self._back
        back = turn_about(axis, angle * turned)
        spread = smooth(share / SPREAD) * (1.0 - turned)
        self._lead((self._ring + spread * self._spread) @ back.T, places @ back.T)

    def _taut(self, places: Floats, stretch: float) -> Floats:
        """Return where its rings are once it is stretched so much, (N, 3), m: straight on from a row, which
        stays.
        """
        row, along = self._row, self._along
        begin, before = (places[row - 1], along[row - 1]) if row else (np.zeros(3), 0.0)
        straight: Floats = begin + stretch * (along - before)[:, None] * self._end
        straight[:row] = places[:row]
        return straight

    def _left(self, share: float) -> float:
        """Return how much of it is before the hole, m."""
        return self._bow.left(smooth((share - BENT) / (PULLED - BENT)))

    def _bent(self, share: float) -> Floats:
        """Return where its rings are until it is taut, (N, 3), m."""
        flat = self._bow.places(self._left(share), smooth(share / BENT))
        fading = 1.0 - smooth(share / ALIGNED)
        axis, angle = self._aligning
        aligned = turn_about(axis, -angle * fading)
        places: Floats = (flat[:, :1] * self._plane.normal + flat[:, 1:] * self._plane.inward) @ aligned.T
        return places + fading * self._off


class _Bow:
    """The curve of a bubble from its held end to a hole and on, in a plane that stands across the hole.

    It leaves its held end away from the hole, straight, goes round on an arc, and straight on into the hole.
    """

    def __init__(self, height: float, width: float, along: Floats, before: float) -> None:
        """Take the height of the middle of the hole above the held end and the width of the bubble, m.

        `along`: distances of its rings from its held end, (N,), m; `before`: how much stays before the hole,
        m, 0 for as little as bends.
        """
        self._height, self._width, self._along = height, width, along
        rise = (1.0 + math.cos(DIPPED)) / math.sin(DIPPED)
        """Length of the first side for each height that is to be won."""
        self._lost = rise * height
        """Length that the height of the hole spares."""
        self._per_radius = rise * (1.0 + math.cos(DIPPED)) + math.sin(DIPPED) + math.pi + DIPPED
        """Length of the curve for each radius of its arc, from a hole as high as the held end."""
        self._most = float(along[-1]) + BEFORE * width
        self._least = before or min(self._per_radius * TIGHTEST * width - self._lost, self._most)

    def left(self, progress: float) -> float:
        """Return how much of it is before the hole, m; `progress`: 0 all, 1 as little as bends."""
        return self._most + progress * (self._least - self._most)

    def places(self, left: float, progress: float) -> Floats:
        """Return where its rings are, across the hole and into it, (N, 2), m.

        `left`: how much of it is before the hole, m; `progress`: 0 straight, 1 bent.
        """
        radius = (left + self._lost) / self._per_radius
        straight = (radius * (1.0 + math.cos(DIPPED)) - self._height) / math.sin(DIPPED)
        fine = np.linspace(0.0, self._along[-1], PLACES)
        heading = -DIPPED + np.clip((fine - straight) / radius, 0.0, math.pi + DIPPED)
        heading -= np.clip((fine - left) / (RISE * self._width), 0.0, RISING)
        steps = np.exp(1j * progress * heading) * (fine[1] - fine[0])
        curve = np.cumsum(steps) - steps
        found = np.interp(self._along, fine, curve)
        return np.stack([found.real, found.imag], axis=1)
