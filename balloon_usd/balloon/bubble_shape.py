"""The shape of a pinched bubble: an axisymmetric membrane between two necks, solved by quadrature.

With r the radius, s the unstressed arc length, a = r / R0 and b the meridional stretch, a membrane at
constant pressure minimises the integral of 2 pi R0 h0 W(a, b) - p pi r^2 dz/ds. That integrand knows neither
z nor s, so two quantities are constant along the meridian (phi is its angle to the axis):

    W - b W_b = C        and        W_b cos(phi) - p* a^2 / 2 = 0   (no axial force at the necks)

Both hold for any stored energy W, so also for rubber that was stretched to the bulged phase and now retraces
its softened path, whose potential is `Softening.stored_energy`. Each bubble sits at the Maxwell pressure, as
it does while the tube still has an empty tail, but for the shortest: see `ball_shape`. All lengths scale with
R0: one family serves every size.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.ball_shape import BallFamily, ball_family
from balloon_usd.balloon.bubble_quadrature import axial_stretch, bubble_at_stretch, legendre
from balloon_usd.balloon.chebyshev import Series
from balloon_usd.balloon.rubber import relaxed_stretches
from balloon_usd.balloon.tube_theory import inflated_rubber, maxwell_state

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber, UnloadedRubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.balloon.tube_theory import TubeState

_FAMILY_NODES = 28
_HALVINGS = 46
_NEAR_AXIS = 0.01
# A family runs over u, where the widest hoop stretch is (1 - exp(-u)) times that of the tube. Beyond the end
# (0.03 % thinner than the tube) a bubble is a cylinder between two fixed ends.
_FAMILY_START, _FAMILY_END = 0.7, 8.0


@dataclass(frozen=True)
class BubbleShape:
    """A bubble between two necks."""

    rest_length: float
    """Length of the unstressed tube it is made of, m."""
    length: float
    """Distance between its necks, m."""
    diameter: float
    """Largest diameter, m."""
    volume: float
    """Volume of gas, m3."""
    pressure: float = 1.0
    """Gauge pressure, in Maxwell pressures."""


@lru_cache(maxsize=4096)
def bubble_of_length(size: BalloonSize, rubber: Rubber, length: float) -> BubbleShape:
    """Return the bubble of this inflated length, m, at the Maxwell pressure; the shortest are `ball_shape`'s.

    Raises:
        ValueError: the length is not positive and finite, or the rubber cannot hold a bubble.
    """
    if not (math.isfinite(length) and length > 0.0):
        raise ValueError(f"a bubble needs a positive length, got {length}")
    return _scaled(_family(rubber).of_length(length / size.radius), size.radius)


@lru_cache(maxsize=4096)
def bubble_of_rest_length(size: BalloonSize, rubber: Rubber, rest_length: float) -> BubbleShape:
    """Return the bubble made of this length of unstressed tube, m, at the Maxwell pressure.

    Of less rubber than any stable bubble takes, a smaller copy of the shortest.

    Raises:
        ValueError: the rest length is not positive and finite, or the rubber cannot hold a bubble.
    """
    if not (math.isfinite(rest_length) and rest_length > 0.0):
        raise ValueError(f"a bubble needs a positive rest length, got {rest_length}")
    return _scaled(_family(rubber).of_rest_length(rest_length / size.radius), size.radius)


def shortest_stable_bubble(size: BalloonSize, rubber: Rubber) -> BubbleShape:
    """Return the shortest bubble that keeps its gas at the Maxwell pressure.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return _scaled(_family(rubber).shortest, size.radius)


def tube_diameter(size: BalloonSize, rubber: Rubber) -> float:
    """Return the diameter of the bulged tube, m.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    return 2.0 * size.radius * maxwell_state(rubber).bulged.a


def tube_volume_per_rest_length(size: BalloonSize, rubber: Rubber) -> float:
    """Return the gas in the bulged tube for each length of unstressed tube, m2.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    return math.pi * size.radius**2 * maxwell_state(rubber).bulged.volume_ratio


def tail_volume_per_rest_length(size: BalloonSize, rubber: Rubber) -> float:
    """Return the gas in the thin tail for each length of unstressed tube, m2.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    return math.pi * size.radius**2 * maxwell_state(rubber).thin.volume_ratio


def pinch_volume(size: BalloonSize, rubber: Rubber) -> float:
    """Return the gas that one twist pushes out of a long tube, m3: what its two rounded ends lack.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    family = _family(rubber)
    longest = family.longest
    tube = math.pi * longest.rest_length * family.tube.volume_ratio
    return (tube - longest.volume) * size.radius**3


def pinch_length(size: BalloonSize, rubber: Rubber) -> float:
    """Return the inflated length that one twist takes from a long tube, m: what its two rounded ends lack.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    family = _family(rubber)
    longest = family.longest
    return (longest.rest_length * family.tube.b - longest.length) * size.radius


def twist_cost(size: BalloonSize, rubber: Rubber) -> float:
    """Return the flat tail that one twist fills, m: the gas it displaces moves the front of the bulge on.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    gained = tube_volume_per_rest_length(size, rubber) - tail_volume_per_rest_length(size, rubber)
    return pinch_volume(size, rubber) / gained


def softest_ball(size: BalloonSize, rubber: Rubber) -> BubbleShape:
    """Return the shortest bubble at the Maxwell pressure, stable only while its gas is shut in.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return bubble_of_length(size, rubber, _family(rubber).balls.softest * size.radius)


def smallest_ball(size: BalloonSize, rubber: Rubber) -> BubbleShape:
    """Return the smallest bubble that makers twist: at twice the Maxwell pressure, 1 cm long of a 260.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return bubble_of_length(size, rubber, 0.5 * _family(rubber).balls.softest * size.radius)


@lru_cache(maxsize=4096)
def neck_rubber(size: BalloonSize, rubber: Rubber, rest_length: float, radius: float) -> float:
    """Return the rest length, m, that one neck of this radius, m, hides from a bubble of this rest length, m.

    The theory closes its necks to a point. Near the axis the rubber is wrinkled and the meridian runs
    straight inwards, at the one meridional stretch b that gives W - b W_b = C.

    Raises:
        ValueError: the rest length is not positive and finite, or the rubber cannot hold a bubble.
    """
    return _neck_rubber(size, rubber, bubble_of_rest_length(size, rubber, rest_length), radius)


@lru_cache(maxsize=4096)
def neck_rubber_of_length(size: BalloonSize, rubber: Rubber, length: float, radius: float) -> float:
    """Return the same of a bubble of this inflated length, m.

    Raises:
        ValueError: the length is not positive and finite, or the rubber cannot hold a bubble.
    """
    return _neck_rubber(size, rubber, bubble_of_length(size, rubber, length), radius)


@lru_cache(maxsize=32)
def strand_stress(rubber: Rubber) -> float:
    """Return the nominal stress (Pa) along the wall of a long bubble where it runs into a neck.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    law, maxwell = inflated_rubber(rubber), maxwell_state(rubber)
    stretch = _stretch_in_neck(law, maxwell.p_star, maxwell.bulged.a)
    taut = relaxed_stretches(np.full(1, _NEAR_AXIS), np.full(1, stretch))
    return float(law.nominal_stress(*taut)[1][0])


def _neck_rubber(size: BalloonSize, rubber: Rubber, shape: BubbleShape, radius: float) -> float:
    p_star = shape.pressure * maxwell_state(rubber).p_star
    return radius / _stretch_in_neck(inflated_rubber(rubber), p_star, 0.5 * shape.diameter / size.radius)


def _stretch_in_neck(law: UnloadedRubber, p_star: float, widest: float) -> float:
    """Return the meridional stretch near the axis of a bubble at p* (Pa), by its largest hoop stretch."""
    hoop = np.array([widest])
    middle = axial_stretch(law, hoop, 0.5 * p_star * hoop**2, axial_force=True)
    near_axis = np.full(1, _NEAR_AXIS)
    return float(axial_stretch(law, near_axis, legendre(law, hoop, middle), axial_force=False)[0])


@dataclass(frozen=True, eq=False)
class _BubbleFamily:
    """All stable bubbles of a rubber, in units of R0, as polynomials over u."""

    rubber: Rubber
    tube: TubeState
    measures: dict[str, Series]
    """Rest length, length and volume over u."""
    start: float
    """u of the bubble with the least rest length."""

    @cached_property
    def shortest(self) -> BubbleShape:
        return self.at(self.start)

    @cached_property
    def longest(self) -> BubbleShape:
        return self.at(_FAMILY_END)

    def at(self, u: float) -> BubbleShape:
        rest_length, length, volume = (series(u) for series in self.measures.values())
        diameter = 2.0 * self.tube.a * (1.0 - math.exp(-u))
        return BubbleShape(rest_length, length, diameter, volume)

    @cached_property
    def balls(self) -> BallFamily:
        return ball_family(self.rubber, self.start)

    def of_length(self, length: float) -> BubbleShape:
        if length < self.shortest.length:
            return BubbleShape(*self.balls.of_length(length))
        return self._found("length", length, self.tube.b)

    def of_rest_length(self, rest_length: float) -> BubbleShape:
        return self._found("rest_length", rest_length, 1.0)

    def _found(self, measure: str, wanted: float, per_rest_length: float) -> BubbleShape:
        shortest, longest = self.shortest, self.longest
        if wanted <= getattr(shortest, measure):
            return _scaled(shortest, wanted / getattr(shortest, measure))
        if wanted >= getattr(longest, measure):
            return self._lengthened(longest, (wanted - getattr(longest, measure)) / per_rest_length)

        series, low, high = self.measures[measure], self.start, _FAMILY_END
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if series(middle) < wanted else (low, middle)
        return self.at(0.5 * (low + high))

    def _lengthened(self, shape: BubbleShape, rest_length: float) -> BubbleShape:
        return BubbleShape(
            rest_length=shape.rest_length + rest_length,
            length=shape.length + rest_length * self.tube.b,
            diameter=shape.diameter,
            volume=shape.volume + math.pi * rest_length * self.tube.volume_ratio,
        )


@lru_cache(maxsize=32)
def _family(rubber: Rubber) -> _BubbleFamily:
    state = maxwell_state(rubber)
    nodes = np.asarray(np.polynomial.chebyshev.chebpts1(_FAMILY_NODES), dtype=np.float64)
    u = _FAMILY_START + 0.5 * (nodes + 1.0) * (_FAMILY_END - _FAMILY_START)
    widest = state.bulged.a * (1.0 - np.exp(-u))
    shapes = bubble_at_stretch(inflated_rubber(rubber), state.p_star, widest, state.bulged.a)
    if not np.isfinite(shapes).all():
        raise ValueError(
            f"a pinched bubble of {rubber.name} bleeds away at the Maxwell pressure: it needs softening"
        )
    fit = np.polynomial.chebyshev.chebfit(nodes, shapes.T, _FAMILY_NODES - 1)
    series = [Series(_FAMILY_START, _FAMILY_END, column) for column in fit.T.tolist()]
    measures = dict(zip(("rest_length", "length", "volume"), series, strict=True))
    fine: list[float] = np.linspace(_FAMILY_START, _FAMILY_END, 2001).tolist()
    return _BubbleFamily(rubber, state.bulged, measures, min(fine, key=measures["rest_length"]))


def _scaled(shape: BubbleShape, factor: float) -> BubbleShape:
    return BubbleShape(
        rest_length=shape.rest_length * factor,
        length=shape.length * factor,
        diameter=shape.diameter * factor,
        volume=shape.volume * factor**3,
        pressure=shape.pressure,
    )
