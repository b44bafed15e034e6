"""Theory of inflated rubber tubes and spheres, with pressures free of size.

A pressure `p_star` (Pa) becomes the gauge pressure of a tube or sphere of radius R0 and wall h0 as
`p = p_star * h0 / R0` (`gauge_pressure`). Stretches: `a` round the tube, `b` along it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.roots import root
from balloon_usd.balloon.rubber import UnloadedRubber

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike

    from balloon_usd.balloon.rubber import Floats, MembraneLaw, Rubber
    from balloon_usd.balloon.sizes import BalloonSize

LARGEST_STRETCH = 14.0
"""End of every search in the hoop stretch: twice the stretch at which latex bursts."""

_SEARCH_STEPS = 1300
_NEWTON_STEPS = 48
_SECTION_POINTS = 65
_WALL = 1e6


@dataclass(frozen=True)
class TubeState:
    """A uniformly inflated tube."""

    p_star: float
    """Pressure free of size, Pa."""
    a: float
    """Hoop stretch."""
    b: float
    """Axial stretch."""

    @property
    def volume_ratio(self) -> float:
        """Enclosed volume over the volume of the unstressed tube."""
        return self.a**2 * self.b


@dataclass(frozen=True)
class MaxwellState:
    """The thin and the bulged phase of a tube, side by side at one pressure."""

    p_star: float
    """Pressure free of size at which a bulge spreads without end, Pa."""
    thin: TubeState
    bulged: TubeState


@dataclass(frozen=True)
class PressureLimit:
    """A maximum or minimum of the pressure over the stretch of a sphere."""

    p_star: float
    """Pressure free of size, Pa."""
    stretch: float


def gauge_pressure(size: BalloonSize, p_star: float) -> float:
    """Return the gauge pressure, Pa, of a tube of this size at the size-free pressure p_star, Pa."""
    return p_star * size.thickness / size.radius


def closed_tube_axial_stretch(law: MembraneLaw, a: ArrayLike) -> Floats:
    """Return the axial stretch of a tube with closed free ends at hoop stretches a >= 1, of the same shape.

    From W_a = p* a b and W_b = p* a^2 / 2, so a W_a = 2 b W_b, solved between the uniaxial (b = a^-1/2)
    and the equibiaxial (b = a) state.
    """
    a = np.asarray(a, dtype=np.float64)

    def excess(b: Floats) -> Floats:
        hoop, axial = law.nominal_stress(a, b)
        return np.asarray(a * hoop - 2.0 * b * axial)

    return root(excess, a**-0.5, a)


def closed_tube_pressure(law: MembraneLaw, a: ArrayLike) -> Floats:
    """Return p*, Pa, of a tube with closed free ends at hoop stretches a >= 1, of the same shape."""
    return fixed_length_tube_pressure(law, a, closed_tube_axial_stretch(law, a))


def closed_tube_state(law: MembraneLaw, a: float) -> TubeState:
    """Return the state of a tube with closed free ends at the hoop stretch a >= 1."""
    b = float(closed_tube_axial_stretch(law, a))
    return TubeState(float(fixed_length_tube_pressure(law, a, b)), a, b)


def fixed_length_tube_pressure(law: MembraneLaw, a: ArrayLike, b: ArrayLike = 1.0) -> Floats:
    """Return p*, Pa, of a tube held at axial stretches b, at hoop stretches a, same shape: W_a / (a b)."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    return np.asarray(law.nominal_stress(a, b)[0] / (a * b))


def sphere_pressure(law: MembraneLaw, stretch: ArrayLike) -> Floats:
    """Return p*, Pa, of a sphere at these stretches, of the same shape: 2 W_a / stretch^2."""
    stretch = np.asarray(stretch, dtype=np.float64)
    return np.asarray(2.0 * law.nominal_stress(stretch, stretch)[0] / stretch**2)


def sphere_limits(law: MembraneLaw) -> tuple[PressureLimit | None, PressureLimit | None]:
    """Return the first pressure maximum of a sphere and the minimum after it, None where there is none."""
    return _first_maximum_and_minimum(lambda stretch: sphere_pressure(law, stretch))


@lru_cache(maxsize=64)
def _tube_limits(law: MembraneLaw) -> tuple[PressureLimit | None, PressureLimit | None]:
    return _first_maximum_and_minimum(lambda a: closed_tube_pressure(law, a))


@lru_cache(maxsize=64)
def pressure_maximum(law: MembraneLaw) -> TubeState:
    """Return the state at which a closed tube begins to bulge: the first maximum of p* over a.

    Raises:
        ValueError: the pressure of this rubber rises without a maximum.
    """
    limit, _ = _tube_limits(law)
    if limit is None:
        raise ValueError(f"the pressure of a tube of {_name(law)} has no maximum")
    return closed_tube_state(law, limit.stretch)


@lru_cache(maxsize=64)
def pressure_minimum(law: MembraneLaw) -> TubeState:
    """Return the state of least pressure of a bulged closed tube: the minimum of p* after its maximum.

    Raises:
        ValueError: this rubber does not stiffen again, so it has no bulged phase.
    """
    _, limit = _tube_limits(law)
    if limit is None:
        raise ValueError(f"a tube of {_name(law)} has no bulged phase: the rubber does not stiffen again")
    return closed_tube_state(law, limit.stretch)


def bulges_once_stretched(rubber: Rubber) -> bool:
    """Tell whether a flat tube that was stretched as far as the bulged phase bulges at the Maxwell pressure:
    its softened rubber has a lower maximum of the pressure.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    if rubber.softening is None:
        return False
    return pressure_maximum(inflated_rubber(rubber)).p_star < maxwell_state(rubber).p_star


def thin_state(law: MembraneLaw, p_star: float) -> TubeState:
    """Return the thin phase of a closed tube at p_star, Pa.

    Raises:
        ValueError: the pressure is above the maximum of the thin phase or below zero.
    """
    top = pressure_maximum(law)
    if not 0.0 <= p_star <= top.p_star:
        raise ValueError(f"no thin phase at p* = {p_star:g} Pa, the maximum is {top.p_star:g} Pa")
    return _states_at(law, p_star, [1.0], [top.a])[0]


def bulged_state(law: MembraneLaw, p_star: float) -> TubeState:
    """Return the bulged phase of a closed tube at p_star, Pa.

    Raises:
        ValueError: the rubber has no bulged phase, or none at this pressure.
    """
    bottom = pressure_minimum(law)
    if not bottom.p_star <= p_star < float("inf"):
        raise ValueError(f"no bulged phase at p* = {p_star:g} Pa, the minimum is {bottom.p_star:g} Pa")
    return _states_at(law, p_star, [bottom.a], [LARGEST_STRETCH])[0]


@lru_cache(maxsize=64)
def maxwell_state(law: MembraneLaw) -> MaxwellState:
    """Return the two phases that live side by side in a long closed tube, and their pressure.

    Maxwell's equal areas: both phases have the same W - p* a^2 b / 2 (Kyriakides & Chang 1991). Newton steps
    on that difference, whose slope in p* is the difference of the volumes.

    Raises:
        ValueError: this rubber has no bulged phase.
    """
    bottom, top = pressure_minimum(law), pressure_maximum(law)
    p_star = 0.5 * (bottom.p_star + top.p_star)
    for _ in range(_NEWTON_STEPS):
        thin, bulged = _states_at(law, p_star, [1.0, bottom.a], [top.a, LARGEST_STRETCH])
        swept = 0.5 * (bulged.volume_ratio - thin.volume_ratio)
        gained = float(law.energy(bulged.a, bulged.b) - law.energy(thin.a, thin.b))
        step = gained / swept - p_star
        if abs(step) < 1e-12 * p_star:
            break
        p_star = min(max(p_star + step, bottom.p_star), top.p_star)
    return MaxwellState(p_star, thin, bulged)


@lru_cache(maxsize=64)
def inflated_rubber(rubber: Rubber) -> UnloadedRubber:
    """Return the rubber on its way back from the bulged phase: what every bubble of a sculpture is made of.

    Raises:
        ValueError: this rubber has no bulged phase.
    """
    bulged = maxwell_state(rubber).bulged
    return UnloadedRubber(rubber, float(rubber.energy(bulged.a, bulged.b)))


def _first_maximum_and_minimum(
    pressure: Callable[[Floats], Floats],
) -> tuple[PressureLimit | None, PressureLimit | None]:
    grid = np.linspace(1.0, LARGEST_STRETCH, _SEARCH_STEPS + 1)[1:]
    values = pressure(grid)
    # At its limit a Gent rubber is a wall: what lies beyond is noise.
    inside = values < _WALL * values[0]
    end = grid.size if inside.all() else int(np.argmin(inside))
    rising = np.diff(values[:end]) > 0.0
    falls = np.flatnonzero(~rising)
    if falls.size == 0:
        return None, None
    maximum = _refined(pressure, grid, int(falls[0]), highest=True)
    rises = np.flatnonzero(rising[falls[0] :])
    if rises.size == 0:
        return maximum, None
    return maximum, _refined(pressure, grid, int(falls[0] + rises[0]), highest=False)


def _refined(pressure: Callable[[Floats], Floats], grid: Floats, index: int, highest: bool) -> PressureLimit:
    low, high = float(grid[max(index - 1, 0)]), float(grid[index + 1])
    best = PressureLimit(0.0, low)
    # A maximum is flat: beyond 1e-8 in the stretch the pressures are equal to rounding.
    while high - low > 1e-8 * high:
        fine = np.linspace(low, high, _SECTION_POINTS)
        values = pressure(fine)
        at = int(np.argmax(values) if highest else np.argmin(values))
        best = PressureLimit(float(values[at]), float(fine[at]))
        low, high = float(fine[max(at - 1, 0)]), float(fine[min(at + 1, _SECTION_POINTS - 1)])
    return best


def _states_at(
    law: MembraneLaw, p_star: float, low: Sequence[float], high: Sequence[float]
) -> list[TubeState]:
    """Return the state at p_star, Pa, in each range of hoop stretches in which the pressure rises."""
    start, end = np.array(low), np.array(high)
    each = np.arange(start.size)
    while (end - start > 1e-12 * end).any():
        fine = np.linspace(start, end, _SECTION_POINTS)
        # Beyond the limit of a Gent rubber there is no number: too far.
        below = closed_tube_pressure(law, fine) < p_star
        at = np.where(below.all(axis=0), _SECTION_POINTS - 1, np.argmin(below, axis=0))
        start, end = fine[np.maximum(at - 1, 0), each], fine[at, each]
    return [closed_tube_state(law, a) for a in end.tolist()]


def _name(law: MembraneLaw) -> str:
    return str(getattr(getattr(law, "rubber", law), "name", "this rubber"))
