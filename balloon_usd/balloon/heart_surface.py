"""The wall of a flat heart balloon: two lobes beside each other, which grow out of one neck.

It is dipped on a form like that: each lobe is a cone with a round end, from the neck on, and both melt into
each other. The knot is at x = 0, the lobes lie to both sides (+y and -y), the cleft between them is at the
end of the axis. Lengths are in half of its width where nothing else is said.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LOBE = 0.424
"""Radius of the round end of a lobe; its middle lies beside the axis by what is left of the half width."""
HIGH = 1.7
"""Height of the middle of that round end over the knot."""
MELTING = 0.17
"""Distance of both lobes within which they melt into each other."""
SEEN_FROM = 0.73
"""Place on the axis from which all of the wall is seen: rings lie on cones about the axis from there."""
LAST = 0.9 * math.pi
"""Angle of the last ring, as seen from there, from the neck, rad: behind it is the cap, in the cleft."""
POOLED, POOL = 2.7, 0.45
"""By how much the wall is thicker in the cleft, in what it is elsewhere, and the distance within which that
fades: latex gathers there on a form that is dipped. Without it gas fills the cleft, and the heart becomes a
ball. Of a hundred forms this is one with a deep cleft that bears to be blown up to four times its width.
"""
_ANGLES, _TURNS = 61, 16
_HALVINGS = 24


class HeartSurface(NamedTuple):
    """Places on the wall of a flat heart."""

    radius: float
    """Half of its width, m."""
    neck: float
    """Radius at the knot, m."""
    along: Floats
    """Mean distances from the knot along the wall, (N,), m."""
    angle: Floats
    """Angles from the neck that belong to them, (N,), rad."""
    grid: Floats
    """Points of the wall at these angles, (N, turns, 3), m."""

    @property
    def length(self) -> float:
        """Mean distance from the knot to the cleft along the wall, m."""
        return float(self.along[-1])

    @property
    def height(self) -> float:
        """Distance from the knot to the tops of the lobes along the axis, m."""
        return (HIGH + LOBE) * self.radius

    @property
    def lobe(self) -> float:
        """Radius of the round end of a lobe, m."""
        return LOBE * self.radius

    @property
    def shoulder(self) -> float:
        """Distance from the knot along the axis to where the lobes are widest, less their radius, m."""
        return (HIGH - LOBE) * self.radius

    @property
    def last(self) -> float:
        """Mean distance from the knot to the last ring along the wall, m."""
        return float(np.interp(LAST, self.angle, self.along))

    def points(self, along: Floats, turn: Floats) -> Floats:
        """Return points of the wall, (..., 3), m, at distances from the knot (m) and turns about the axis
        from one lobe to the other (rad).
        """
        angle, turn = np.broadcast_arrays(np.interp(along, self.along, self.angle), turn)
        return self.radius * _seen_at(angle, turn, self.neck / self.radius)

    def wall(self, points: Floats) -> Floats:
        """Return how thick the wall is at points (..., 3), m, in what it is far from the cleft."""
        cleft = self.points(self.along[-1:], np.zeros(1))[0]
        away = np.linalg.norm(points - cleft, axis=-1) / (POOL * self.radius)
        return np.asarray(1.0 + POOLED * np.exp(-(away**2)))

    @property
    def area(self) -> float:
        """Area of the wall, each place as many times as it is thick, m2."""
        return float(np.sum(self.wall(self.grid[:-1]) * np.linalg.norm(self._faces(), axis=-1)))

    @property
    def volume(self) -> float:
        """Volume inside, m3."""
        return float(np.abs(np.sum(self.grid[:-1] * self._faces())) / 3.0)

    def _faces(self) -> Floats:
        """Vector areas of the faces of the grid, (N - 1, turns, 3), m2."""
        along, about = np.diff(self.grid, axis=0), np.roll(self.grid, -1, axis=1) - self.grid
        return np.cross(along, about[:-1])


@lru_cache(maxsize=16)
def heart_surface(radius: float, neck: float) -> HeartSurface:
    """Return the wall of a flat heart of half a width and a neck of a radius, m."""
    angle = np.linspace(math.atan2(neck / radius, SEEN_FROM), math.pi, _ANGLES)
    turn = math.tau * np.arange(_TURNS) / _TURNS
    seen, about = np.broadcast_arrays(angle[:, None], turn)
    points = radius * _seen_at(seen, about, neck / radius)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=-1).mean(axis=1)
    return HeartSurface(radius, neck, np.concatenate([[0.0], np.cumsum(steps)]), angle, points)


def _seen_at(angle: Floats, turn: Floats, neck: float) -> Floats:
    """Return where rays at angles from the neck and turns about the axis leave the heart, (..., 3)."""
    out = np.sin(angle)
    ray = np.stack([-np.cos(angle), out * np.cos(turn), out * np.sin(turn)], axis=-1)
    eye = np.array([SEEN_FROM, 0.0, 0.0])
    inside, beyond = np.zeros(angle.shape), np.full(angle.shape, HIGH + 1.0)
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + beyond)
        within = _distance(eye + middle[..., None] * ray, neck) < 0.0
        inside, beyond = np.where(within, middle, inside), np.where(within, beyond, middle)
    return np.asarray(eye + inside[..., None] * ray)


def _distance(points: Floats, neck: float) -> Floats:
    """Return how far points, (..., 3), are from the wall, those within below 0: of two cones with round ends
    the nearer, and where both are as near less (the smooth minimum of Quilez 2013).
    """
    # Where they melt into each other, both are a quarter of that thicker.
    start, out = neck - 0.25 * MELTING, 1.0 - LOBE
    one, other = (_cone(points, np.array([HIGH, side * out, 0.0]), start) for side in (1.0, -1.0))
    share = np.clip(0.5 + 0.5 * (other - one) / MELTING, 0.0, 1.0)
    return np.asarray(other + (one - other) * share - MELTING * share * (1.0 - share))


def _cone(points: Floats, end: Floats, neck: float) -> Floats:
    """Return how far points are from a cone with round ends, from the knot to the end of a lobe."""
    share = np.clip(points @ end / (end @ end), 0.0, 1.0)
    away = np.linalg.norm(points - share[..., None] * end, axis=-1)
    return np.asarray(away - (neck + share * (LOBE - neck)))
