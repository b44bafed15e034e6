"""A round balloon still open to the hands: from its last twist to its tip."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.lobe_shape import Lobe, Peaks, blown_up, flat_wall

if TYPE_CHECKING:
    from balloon_usd.balloon.lobe_shape import FlatWall
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize

LEAST_WALL = 0.15
"""Least share of the whole wall of which a lobe is made: a smaller one is all neck."""
_STEPS = 14
"""Most steps of each search."""
_FARTHEST = 0.3
"""Largest step of a search, in a logarithm."""
_ALIKE = 3e-4
"""Accuracy of heights and of the energies of two walls."""
_ROUGHLY = 0.03
"""The same while a height is sought: it saves a third of the time."""
_SAME = 1e-9
"""Difference of two logarithms that are the same but for rounding."""


@dataclass(frozen=True)
class OpenRound:
    """The wall beyond the last twist, blown up."""

    size: BalloonSize
    rubber: Rubber
    start: float
    """Unstressed distance of its first neck from the knot along the wall, m."""
    neck: float
    """Radius of all its necks, m."""
    lobe: Lobe
    peaks: Peaks
    """How far it was stretched so far."""

    @classmethod
    def whole(cls, size: BalloonSize, rubber: Rubber, neck: float, volume: float, most: float) -> OpenRound:
        """Return a balloon that holds so much gas, m3, before it is twisted; `most`: as much as it held
        before, m3, or the same.

        Raises:
            ValueError: no shape is found.
        """
        flat = flat_wall(size, 0.0, size.length, (neck, 0.0))
        lobe = blown_up(flat, rubber, most)
        peaks = Peaks(flat.along, lobe.energies)
        if most > volume:
            lobe = blown_up(flat._replace(peaks=peaks.energy), rubber, volume)
        return cls(size, rubber, 0.0, neck, lobe, peaks)

    @property
    def lengths(self) -> tuple[float, float]:
        """Least and greatest unstressed length of a wall that can be twisted off, m."""
        least = LEAST_WALL * self.size.length
        return least, self.size.length - self.start - least

    def twisted(self, height: float) -> tuple[Lobe, OpenRound]:
        """Twist off a lobe of a height, m; return it and what is left. Hands leave so much gas in it that
        both walls are stretched alike.

        Raises:
            ValueError: there is no such lobe, or no shape is found.
        """
        low, high = self.lengths
        length = (self.size.length - self.start) * 0.8 * height / self.lobe.height
        length, grows = min(max(length, low), high), 1.0
        found: tuple[Lobe, OpenRound] | None = None
        alike = _ROUGHLY
        for _ in range(_STEPS if low < high else 0):
            before, found = found, self.parted(length, found, alike)
            off = math.log(found[0].height / height)
            if abs(off) < _ALIKE and alike == _ALIKE:
                return found
            longer = 0.0 if before is None else math.log(length / (before[1].start - self.start))
            if before is not None and abs(longer) > _SAME:
                grows = max(math.log(found[0].height / before[0].height) / longer, 0.2)
            at, length = length, min(max(length * math.exp(_step(-off / grows)), low), high)
            nearly = abs(off) < _ROUGHLY
            if length == at and (alike == _ALIKE or not nearly):
                break
            alike = _ALIKE if nearly else _ROUGHLY
        raise ValueError(f"no lobe {100.0 * height:.3g} cm high is found")

    def parted(
        self, length: float, like: tuple[Lobe, OpenRound] | None = None, alike: float = _ALIKE
    ) -> tuple[Lobe, OpenRound]:
        """Twist off a lobe whose wall is so long unstressed, m; `like`: one of nearly the same shape;
        `alike`: how alike both walls are stretched.

        Raises:
            ValueError: no shape is found.
        """
        at = self.start + length
        walls = (
            flat_wall(self.size, self.start, at, (self.neck, self.neck), self.peaks),
            flat_wall(self.size, at, self.size.length, (self.neck, 0.0), self.peaks),
        )
        rubber = [float(wall.rubber.sum()) for wall in walls]
        gas = (ATMOSPHERE + self.lobe.pressure) * self.lobe.volume
        sides = (None, None) if like is None else (like[0], like[1].lobe)
        pressures = [self.lobe.pressure if side is None else side.pressure for side in sides]
        # Logarithm of how much more gas is in the lobe than in what is left: first as in two balls that are
        # alike stretched, then off that by as much as in the shapes that are like these.
        more = _of_balls(rubber[0], rubber[1])
        if like is not None:
            first, second = like[0], like[1].lobe
            held = float(first.rubber.sum()), float(second.rubber.sum())
            more += math.log(first.volume / second.volume) - _of_balls(*held)
        for _ in range(_STEPS):
            shares = 1.0 / (1.0 + math.exp(-more)), 1.0 / (1.0 + math.exp(more))
            lobe, rest = (
                blown_up(wall, self.rubber, share * gas / (ATMOSPHERE + pressure), side)
                for wall, share, pressure, side in zip(walls, shares, pressures, sides, strict=True)
            )
            sides, pressures = (lobe, rest), [lobe.pressure, rest.pressure]
            off = math.log(lobe.energy / rubber[0] * rubber[1] / rest.energy)
            if abs(off) < alike:
                noted = Peaks(walls[1].along, np.maximum(walls[1].peaks, rest.energies))
                return lobe, replace(self, start=at, lobe=rest, peaks=noted)
            one, other = (self._growth(*each) for each in zip(walls, sides, strict=True))
            more += _step(-off / (shares[1] * one + shares[0] * other))
        raise ValueError(f"no lobe with {100.0 * length:.3g} cm of wall is found")

    def _growth(self, wall: FlatWall, lobe: Lobe) -> float:
        """Return the logarithm of the energy of first loading of a wall by that of its gas: what the gas does
        it stores, where it is not softer than then.
        """
        softer = self.rubber.softening_factor(lobe.energies, wall.peaks)
        return lobe.volume * lobe.pressure / float((softer * lobe.energies) @ lobe.rubber)


def _of_balls(first: float, second: float) -> float:
    """Return the logarithm of the gas in one of two balls of some rubber (m3) over that in the other."""
    return 1.5 * math.log(first / second)


def _step(wanted: float) -> float:
    """Return the step of a search in a logarithm; far off may be no shape."""
    return min(max(wanted, -_FARTHEST), _FARTHEST)
