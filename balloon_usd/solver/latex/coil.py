"""Coils: where the rings of a bubble go that is rolled up, beside each other or round each other."""

from __future__ import annotations

import cmath
import math
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.placement import turn_about, turn_between

if TYPE_CHECKING:
    from balloon_usd.solver.motions.curve import Row

Floats = NDArray[np.float64]

ACROSS = 0.1
"""Sine of the angle between a bubble and the axis of its coil below which it begins beside that axis."""
SAMPLES = 512
"""At how many angles a turn of a disc is known."""


class Coil(ABC):
    """A row of rings that is rolled up about an axis, from its first one on."""

    def __init__(self, row: Row, turns: float, axis: Floats, slope: float = 0.0) -> None:
        """Take the row as it is.

        `turns`: right-handed, left-handed below 0; `axis`: its unit direction, away from the held ring;
        `slope`: how far it goes on along its axis, per length of the row.
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
        self._onward = _across(row.axis, axis)
        """Unit direction of its beginning across the axis."""
        self._hand = math.copysign(1.0, turns)
        self._inward: Floats = self._hand * np.cross(axis, self._onward)
        """Unit direction from there to the axis."""
        self._begin: Floats = math.sqrt(1.0 - slope**2) * self._onward + slope * axis
        """Unit direction of its beginning."""
        self._tilt = turn_between(self._begin, row.axis)
        """Axis and angle (rad) by which its beginning is turned to lie along the row as it is."""

    @abstractmethod
    def _wound(self, gone: Floats, rolled: float, /) -> Floats:
        """Return the way from its beginning to some places along it, (N, 3), m.

        `gone`: how far along it they lie, (N,), m; `rolled`: how much is rolled up, m.
        """

    @abstractmethod
    def _leaving(self, rolled: float) -> Floats:
        """Return the unit direction in which what is not wound goes on from its end, (3,)."""

    @abstractmethod
    def _wound_angle(self, rolled: float) -> float:
        """Return by which angle its end is turned about the axis against its beginning, rad."""

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
        way = np.minimum(gone, 0.0)[:, None] * self._begin
        way += self._wound(np.clip(gone, 0.0, rolled), rolled)
        way += np.maximum(gone - rolled, 0.0)[:, None] * self._leaving(rolled)
        found: Floats = row.held + (way - way[0]) @ tilt.T
        return found[::-1]

    def turned(self, progress: float) -> Floats:
        """Return how far its first ring has turned with the coil, (3, 3)."""
        axis, tilt = self._tilt
        gone = self._along[-1] - self._row.begin - (1.0 - progress) * (self._row.end - self._row.begin)
        rolled = turn_about(self._axis, self._hand * self._wound_angle(max(gone, 0.0)))
        found: Floats = turn_about(axis, (1.0 - progress) * tilt) @ rolled @ turn_about(axis, -tilt)
        return found


class Helix(Coil):
    """A coil that goes on along its axis."""

    def __init__(self, row: Row, turns: float, axis: Floats, rise: float) -> None:
        """Take the row as it is; `rise`: along the axis with each turn, m."""
        length = row.end - row.begin
        self._angle = math.tau * abs(turns) / length
        """By which it goes round along the row, rad/m."""
        self._slope = rise * abs(turns) / length
        """How far it goes on along the axis, per length of the row."""
        self._radius = math.sqrt(1.0 - self._slope**2) / self._angle
        super().__init__(row, turns, axis, self._slope)

    def _wound(self, gone: Floats, _rolled: float, /) -> Floats:
        turn = (self._angle * gone)[:, None]
        round_it = np.sin(turn) * self._onward + (1.0 - np.cos(turn)) * self._inward
        return np.asarray(self._radius * round_it + self._slope * gone[:, None] * self._axis)

    def _leaving(self, rolled: float) -> Floats:
        turn = self._angle * rolled
        flat = math.cos(turn) * self._onward + math.sin(turn) * self._inward
        return np.asarray(math.sqrt(1.0 - self._slope**2) * flat + self._slope * self._axis)

    def _wound_angle(self, rolled: float) -> float:
        return self._angle * rolled


class Disc(Coil):
    """A coil in one plane, each turn of which lies round the one before: a spiral of Archimedes."""

    def __init__(self, row: Row, turns: float, axis: Floats, growth: float) -> None:
        """Take the row as it is; `growth`: how much farther from the axis each turn lies, m."""
        super().__init__(row, turns, axis)
        # A flat tail stays outside: it comes out along the axis.
        self._last = int(np.searchsorted(row.along, row.end))
        length, turns = row.end - row.begin, abs(turns)
        inner = length / (math.tau * turns) - 0.5 * growth * turns
        # Some more than it has, for gas that comes into a flat tail.
        self._turn: Floats = np.linspace(0.0, math.tau * (turns + 1.0), math.ceil(SAMPLES * (turns + 1.0)))
        """Angles from its inner end outwards, (S,), rad."""
        self._slope = growth / math.tau
        """How much farther from the axis it lies, per angle, m/rad."""
        self._radius: Floats = inner + self._slope * self._turn
        """How far from the axis it lies there, (S,), m."""
        speed = np.hypot(self._radius, self._slope)
        steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(self._turn)
        self._outward: Floats = np.concatenate([[0.0], np.cumsum(steps)])
        """How far along it they lie from its inner end on, (S,), m."""

    def _wound(self, gone: Floats, rolled: float, /) -> Floats:
        within = np.interp(rolled - gone, self._outward, self._turn)
        places = self._at(within)
        # Seen so that its beginning, where it goes inwards, lies along the real axis.
        ways = (self._at(np.array([self._end(rolled)])) - places) / self._heading(rolled)
        return ways.real[:, None] * self._onward - ways.imag[:, None] * self._inward

    def _leaving(self, rolled: float) -> Floats:
        # Within there is no room: it comes out along the axis, once it is rolled in.
        share = min(rolled / (math.tau * self._radius[0]), 1.0)
        way = self._heading(0.0) / self._heading(rolled)
        flat = way.real * self._onward - way.imag * self._inward
        turn = 0.5 * math.pi * share
        return np.asarray(math.cos(turn) * flat + math.sin(turn) * self._axis)

    def _wound_angle(self, rolled: float) -> float:
        turn = self._end(rolled)
        radius = float(np.interp(turn, self._turn, self._radius))
        # Its heading lies across its radius but for its slope.
        return turn + math.atan2(radius, self._slope) - math.atan2(float(self._radius[0]), self._slope)

    def _end(self, rolled: float) -> float:
        """Return the angle from its inner end to its beginning, rad."""
        return float(np.interp(rolled, self._outward, self._turn))

    def _at(self, turn: Floats) -> NDArray[np.complex128]:
        """Return its places at some angles, about its axis, m."""
        return np.asarray(np.interp(turn, self._turn, self._radius) * np.exp(1j * turn))

    def _heading(self, along: float) -> complex:
        """Return the direction outwards of a place so far along it from its inner end, of length 1."""
        turn = self._end(along)
        way = complex(self._slope, float(np.interp(turn, self._turn, self._radius)))
        return way / abs(way) * cmath.exp(1j * turn)


def _across(direction: Floats, axis: Floats) -> Floats:
    """Return the unit direction across an axis that is nearest to another one."""
    across = direction - axis * float(direction @ axis)
    if np.linalg.norm(across) < ACROSS:
        across = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    return np.asarray(across / np.linalg.norm(across))
