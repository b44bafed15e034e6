"""Rolling a bubble of latex up into a coil, of which it keeps nearly all."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations import moves
from balloon_usd.solver.latex.motions.curve import LatexCurve
from balloon_usd.solver.motions.curve import Row
from balloon_usd.solver.placement import turn_about, turn_between

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.motions.curve import Path

Floats = NDArray[np.float64]

ACROSS = 0.1
"""Sine of the angle between a bubble and the axis of its coil below which it begins beside that axis."""


class Curl(LatexCurve[moves.Curl]):
    """A bubble of latex that is rolled up, with what gas comes to fill of its flat tail meanwhile."""

    def path(self, move: moves.Curl, straight: tuple[int, int]) -> Path:
        """Return the coil."""
        self._coil = Coil(Row(self._began, straight), move.turns, np.array(move.point), move.rise)
        return self._coil

    def take_flat(self, joints: Sequence[int]) -> None:
        """Take hold of the rings of the flat tail to which gas may come, and leave the tip alone."""
        super().take_flat(joints[:-1])

    def carried(self, goal: Floats) -> Floats:
        """Return where what hangs on its free end goes, (M, 3), m: it turns with that end."""
        arms = self._carried.places - self._began[0]
        found: Floats = goal[0] + arms @ self._coil.turned(self.progress).T
        return found

    def advance(self, share: float) -> None:
        """Roll the bubble on, and wind what gas has come to of the flat tail."""
        self._coil.measure(self._sculpture.frame.middle[self._joints].astype(np.float64))
        super().advance(share)


class Coil:
    """A row of rings that is rolled up from its first one on, into a helix about an axis."""

    def __init__(self, row: Row, turns: float, axis: Floats, rise: float) -> None:
        """Take the row as it is.

        `turns`: right-handed, left-handed below 0; `axis`: its unit direction, away from the held ring;
        `rise`: along it with each turn, m.
        """
        self._row, self._axis = row, axis
        self._along, self._apart = row.along, row.sides.copy()
        firm = int(np.searchsorted(row.along, row.end)) + 1
        self._last = len(row.sides) - (firm <= len(row.sides))
        """The last ring that is wound: where there is a flat tail, the one before its tip."""
        self._tail = slice(firm - 1, self._last)
        """Sides of the flat tail that are wound, too."""
        self._most = (row.end - row.begin) / max(firm - 1, 1)
        """How far apart rings lie that are blown up, m."""
        length = row.end - row.begin
        self._angle = math.tau * abs(turns) / length
        """By which it goes round along the row, rad/m."""
        self._slope = rise * abs(turns) / length
        """How far it goes on along the axis, per length of the row."""
        self._radius = math.sqrt(1.0 - self._slope**2) / self._angle
        self._onward = _across(row.axis, axis)
        """Unit direction of its beginning across the axis."""
        self._hand = math.copysign(1.0, turns)
        self._inward: Floats = self._hand * np.cross(axis, self._onward)
        """Unit direction from there to the axis."""
        begin = math.sqrt(1.0 - self._slope**2) * self._onward + self._slope * axis
        self._tilt = turn_between(begin, row.axis)
        """Axis and angle (rad) by which its beginning is turned to lie along the row as it is."""

    def measure(self, places: Floats) -> None:
        """Take how far the rings of the flat tail lie apart by now, as gas comes; `places`: (N, 3), m."""
        apart = np.linalg.norm(np.diff(places, axis=0), axis=1)[::-1]
        self._apart[self._tail] = np.clip(apart[self._tail], self._apart[self._tail], self._most)
        self._along = np.concatenate([[0.0], np.cumsum(self._apart)])

    def places(self, progress: float) -> Floats:
        """Return where the rings go, (N, 3), m; `progress`: 0 straight, 1 rolled up to the held ring."""
        row = self._row
        tilt = turn_about(self._tilt[0], (1.0 - progress) * self._tilt[1])
        gone = self._along - row.begin - (1.0 - progress) * (row.end - row.begin)
        # What is not held of a flat tail goes straight on.
        rolled = max(gone[self._last], 0.0)
        way = np.minimum(gone, 0.0)[:, None] * self._direction(np.zeros(1))
        way += self._helix(np.clip(gone, 0.0, rolled))
        way += np.maximum(gone - rolled, 0.0)[:, None] * self._direction(np.array([rolled]))
        found: Floats = row.held + (way - way[0]) @ tilt.T
        return found[::-1]

    def turned(self, progress: float) -> Floats:
        """Return how far its first ring has turned with the coil, (3, 3)."""
        axis, tilt = self._tilt
        gone = self._along[-1] - self._row.begin - (1.0 - progress) * (self._row.end - self._row.begin)
        rolled = turn_about(self._axis, self._hand * self._angle * max(gone, 0.0))
        found: Floats = turn_about(axis, (1.0 - progress) * tilt) @ rolled @ turn_about(axis, -tilt)
        return found

    def _helix(self, along: Floats) -> Floats:
        """Return the way from its beginning to some places along it (m), (N, 3), m."""
        turn = (self._angle * along)[:, None]
        round_it = np.sin(turn) * self._onward + (1.0 - np.cos(turn)) * self._inward
        return np.asarray(self._radius * round_it + self._slope * along[:, None] * self._axis)

    def _direction(self, along: Floats) -> Floats:
        """Return its unit direction at some places along it (m), (N, 3)."""
        turn = (self._angle * along)[:, None]
        flat = np.cos(turn) * self._onward + np.sin(turn) * self._inward
        return np.asarray(math.sqrt(1.0 - self._slope**2) * flat + self._slope * self._axis)


def _across(direction: Floats, axis: Floats) -> Floats:
    """Return the unit direction across an axis that is nearest to another one."""
    across = direction - axis * float(direction @ axis)
    if np.linalg.norm(across) < ACROSS:
        across = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    return np.asarray(across / np.linalg.norm(across))
