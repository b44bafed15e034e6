"""Lobes: what twists make of a round balloon, by membrane theory.

A lobe is the wall between two necks, or between a neck and the tip: a membrane of revolution, whose energy is
least for the gas that it holds. Rubber that was stretched farther before is softer. Round a neck the wall
lies in folds and bears along its meridians alone (tension field). The meridian is a polygon; Newton's method
finds its corners and the pressure together.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.round_outline import round_outline
from balloon_usd.balloon.rubber import UnloadedRubber, relaxed_stretches
from balloon_usd.balloon.tip_wall import tip_thickening

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import MembraneLaw, Rubber
    from balloon_usd.balloon.sizes import BalloonSize

Floats = NDArray[np.float64]

PIECES = 24
"""Pieces of a meridian: with 128 widths, heights and pressures differ by 0.5 % at most."""
_MOST_STEPS = 80
_LONGEST_STEPS = (0.15, 0.4, 0.07)
"""Longest steps of Newton's method, in radii of a ball of the same gas: where it does not end with the first,
it does with another.
"""
_SHRINKS, _BACK = 0.6, 0.5
"""Share of the last step above which a whole one is too long, and how much of it is made then: where a wall
begins to soften its stiffness jumps, and whole steps go to and fro about that for ever.
"""
_ACCURACY = 1e-4
"""Step at which it ends, in the same."""
_LEAST_RADIUS = 1e-5
"""Least distance of a corner from the axis, in the same."""
_FIRST_PRESSURE = 3000.0
"""Pressure with which it begins, Pa; any of that order will do."""


class Peaks(NamedTuple):
    """How far a wall was stretched so far, from its first neck to its tip."""

    along: Floats
    """Unstressed distances from the knot along the wall, (N,), m."""
    energy: Floats
    """Largest energy of first loading there, (N,), J/m3."""


class FlatWall(NamedTuple):
    """The unstressed wall of a lobe, in pieces along its meridian."""

    along: Floats
    """Unstressed distances of their middles from the knot along the wall, (P,), m."""
    lengths: Floats
    """Along the meridian, (P,), m."""
    radii: Floats
    """Distances of their middles from the axis, (P,), m."""
    rubber: Floats
    """Their rubber, (P,), m3."""
    ends: tuple[float, float]
    """Radii of the necks between which it lies, m; 0 of the tip."""
    peaks: Floats
    """Largest energy of first loading so far, (P,), J/m3."""


class Lobe(NamedTuple):
    """A wall that is blown up."""

    x: Floats
    """Places of the corners of its meridian along the axis, (P + 1,), m."""
    radius: Floats
    """Their distances from the axis, (P + 1,), m."""
    pressure: float
    """Gauge, Pa."""
    volume: float
    """Gas, m3."""
    energies: Floats
    """Energy of first loading of its pieces, (P,), J/m3."""
    rubber: Floats
    """Their rubber, (P,), m3."""

    @property
    def energy(self) -> float:
        """Energy with which its rubber would be stretched so far for the first time, J."""
        return float(self.energies @ self.rubber)

    @property
    def height(self) -> float:
        """From one end of its axis to the other, m."""
        return float(np.ptp(self.x))

    @property
    def width(self) -> float:
        """Widest diameter, m."""
        return 2.0 * float(self.radius.max())


def flat_wall(
    size: BalloonSize, start: float, end: float, ends: tuple[float, float], peaks: Peaks | None = None
) -> FlatWall:
    """Return the wall of a round balloon between two distances from its knot along the wall, m.

    `ends`: radii of its necks there, m; 0 for the tip. `peaks`: how far it was stretched so far; None: not
    at all.
    """
    outline = round_outline(size.radius, size.neck_radius)
    along = np.linspace(start, end, PIECES + 1)
    middle, lengths = 0.5 * (along[1:] + along[:-1]), np.diff(along)
    radii = np.interp(middle, outline.along, outline.radius)
    from_tip = outline.x[-1] - np.interp(middle, outline.along, outline.x)
    thickness = size.thickness * tip_thickening(from_tip, size.neck_radius)
    peak = np.zeros(PIECES) if peaks is None else np.interp(middle, peaks.along, peaks.energy)
    return FlatWall(middle, lengths, radii, math.tau * radii * lengths * thickness, ends, peak)


def blown_up(wall: FlatWall, rubber: Rubber, volume: float, like: Lobe | None = None) -> Lobe:
    """Return a wall with so much gas (m3); `like`: one of nearly the same shape, from which the search
    begins.

    Raises:
        ValueError: no shape is found.
    """
    if like is None and wall.peaks.any():
        # From a ball a softened wall is found in 10 times as many steps.
        like = blown_up(wall._replace(peaks=np.zeros(PIECES)), rubber, volume)
    for begin, longest in ((like, _LONGEST_STEPS[0]), *((None, each) for each in _LONGEST_STEPS)):
        if volume > 0.0 and (found := _found(wall, rubber, volume, begin, longest)) is not None:
            return found
    raise ValueError(f"no lobe of {1e6 * volume:.3g} mL is found")


def _found(wall: FlatWall, rubber: Rubber, volume: float, like: Lobe | None, most: float) -> Lobe | None:
    """Return the same by Newton's method with steps of at most so many radii, if it ends."""
    ball = (3.0 * volume / (4.0 * math.pi)) ** (1.0 / 3.0)
    law = UnloadedRubber(rubber, wall.peaks) if wall.peaks.any() else rubber
    x, radius, pressure = _first_guess(wall, volume, ball, like)
    count = len(x)
    # The first end stays where it is, and both keep their radii.
    free = np.delete(np.arange(2 * count), [0, count, -1])
    before = math.inf
    for _ in range(_MOST_STEPS):
        with np.errstate(all="ignore"):
            slope, stiffness = _wall_terms(wall, law, x, radius)
        held, held_slope, held_bend = _gas_terms(x, radius)
        matrix = np.zeros((len(free) + 1, len(free) + 1))
        matrix[:-1, :-1] = _assembled(stiffness - pressure * held_bend)[np.ix_(free, free)]
        swell = _gathered(held_slope)[free]
        matrix[-1, :-1] = matrix[:-1, -1] = -swell
        excess = np.append(pressure * swell - _gathered(slope)[free], held - volume)
        if not np.isfinite(matrix).all():
            break
        step = np.linalg.solve(matrix, excess)
        longest = float(np.abs(step[:-1]).max())
        share = min(1.0, most * ball / max(longest, 1e-12 * ball))
        if share == 1.0 and longest > _SHRINKS * before:
            share = _BACK
        before = longest
        moved = np.zeros(2 * count)
        moved[free] = share * step[:-1]
        x = x + moved[:count]
        radius = radius + moved[count:]
        radius[1:-1] = np.maximum(radius[1:-1], _LEAST_RADIUS * ball)
        pressure += share * float(step[-1])
        if longest < _ACCURACY * ball:
            energies = rubber.energy(*relaxed_stretches(*_stretches(wall, x, radius)))
            return Lobe(x, radius, pressure, volume, energies, wall.rubber)
    return None


def _first_guess(
    wall: FlatWall, volume: float, ball: float, like: Lobe | None
) -> tuple[Floats, Floats, float]:
    """Return the corners of a ball, or of a lobe that is scaled, (P + 1,) each, m, and a pressure, Pa."""
    if like is not None:
        larger = (volume / like.volume) ** (1.0 / 3.0)
        x, radius, pressure = larger * like.x, larger * like.radius, like.pressure
    else:
        along = np.concatenate([[0.0], np.cumsum(wall.lengths)])
        angle = math.pi * along / along[-1]
        x, radius, pressure = ball * (1.0 - np.cos(angle)), ball * np.sin(angle), _FIRST_PRESSURE
    radius[0], radius[-1] = wall.ends
    return x, radius, pressure


def _stretches(wall: FlatWall, x: Floats, radius: Floats) -> tuple[Floats, Floats]:
    """Return the stretch of every piece round the axis and along its meridian, (P,) each."""
    hoop = np.maximum(0.5 * (radius[1:] + radius[:-1]), 0.0) / wall.radii
    return hoop, np.hypot(np.diff(x), np.diff(radius)) / wall.lengths


def _wall_terms(wall: FlatWall, law: MembraneLaw, x: Floats, radius: Floats) -> tuple[Floats, Floats]:
    """Return the slope of the energy of every piece by the coordinates of both ends, (P, 4), N, in the order
    x, x, radius, radius, and its stiffness, (P, 4, 4), N/m.
    """
    across, out = np.diff(x), np.diff(radius)
    length = np.hypot(across, out)
    tension, stiff = _relaxed(law, *_stretches(wall, x, radius))
    cosine, sine = across / length, out / length
    half = 0.5 / wall.radii
    hoop_slope = np.stack([np.zeros_like(half), np.zeros_like(half), half, half], axis=1)
    axial_slope = np.stack([-cosine, cosine, -sine, sine], axis=1) / wall.lengths[:, None]
    slope = tension[0][:, None] * hoop_slope + tension[1][:, None] * axial_slope
    mixed = _outer(hoop_slope, axial_slope)
    bend = (
        stiff[0][:, None, None] * _outer(hoop_slope, hoop_slope)
        + stiff[1][:, None, None] * (mixed + mixed.transpose(0, 2, 1))
        + stiff[2][:, None, None] * _outer(axial_slope, axial_slope)
    )
    turning = np.stack([-sine, sine, cosine, -cosine], axis=1)
    bend += (tension[1] / (length * wall.lengths))[:, None, None] * _outer(turning, turning)
    held = wall.rubber
    return held[:, None] * slope, held[:, None, None] * bend


def _relaxed(
    law: MembraneLaw, hoop: Floats, axial: Floats
) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats, Floats]]:
    """Return stresses and stiffness (Pa) of a wall that lies in folds where it is pushed."""
    a, b = relaxed_stretches(hoop, axial)
    _, along_hoop, along_axis, aa, ab, bb = law.energy_to_stiffness(a, b)
    folds_round, folds_along = a > hoop, b > axial
    # A strip that narrows freely is softer.
    bb = np.where(folds_round, bb - ab**2 / aa, bb)
    aa, bb = np.where(folds_along, aa - ab**2 / bb, aa), np.where(folds_along, 0.0, bb)
    aa = np.where(folds_round, 0.0, aa)
    ab = np.where(folds_round | folds_along, 0.0, ab)
    stresses = np.where(folds_round, 0.0, along_hoop), np.where(folds_along, 0.0, along_axis)
    return stresses, (aa, ab, bb)


def _gas_terms(x: Floats, radius: Floats) -> tuple[float, Floats, Floats]:
    """Return the volume (m3) of cones between corners, its slope, (P, 4), m2, and its bend, (P, 4, 4), m."""
    r, s, across = radius[:-1], radius[1:], np.diff(x)
    section = math.pi / 3.0 * (r * r + r * s + s * s)
    by_r, by_s = math.pi / 3.0 * (2.0 * r + s), math.pi / 3.0 * (r + 2.0 * s)
    slope = np.stack([-section, section, across * by_r, across * by_s], axis=1)
    bend = np.zeros((len(r), 4, 4))
    for k, by in ((2, by_r), (3, by_s)):
        bend[:, 0, k] = bend[:, k, 0] = -by
        bend[:, 1, k] = bend[:, k, 1] = by
    cone = math.pi / 3.0 * across
    bend[:, 2, 2] = bend[:, 3, 3] = 2.0 * cone
    bend[:, 2, 3] = bend[:, 3, 2] = cone
    return float(np.sum(section * across)), slope, bend


def _outer(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, :, None] * b[:, None, :])


@lru_cache(maxsize=4)
def _corners(pieces: int) -> NDArray[np.int64]:
    """Return the coordinates of every piece among all, (P, 4): first all x, then all radii."""
    first = np.arange(pieces)
    return np.stack([first, first + 1, first + pieces + 1, first + pieces + 2], axis=1)


def _gathered(slope: Floats) -> Floats:
    """Return the slope by all coordinates, (2 P + 2,), from those of the pieces."""
    found = np.zeros(2 * len(slope) + 2)
    np.add.at(found, _corners(len(slope)), slope)
    return found


def _assembled(bend: Floats) -> Floats:
    """Return the bend by all coordinates, (2 P + 2, 2 P + 2), from those of the pieces."""
    at = _corners(len(bend))
    found = np.zeros((2 * len(bend) + 2, 2 * len(bend) + 2))
    np.add.at(found, (at[:, :, None], at[:, None, :]), bend)
    return found
