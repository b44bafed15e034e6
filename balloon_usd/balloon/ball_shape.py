"""Balls: bubbles shorter than any that is stable at the pressure of the tube; lengths are in R0.

A chamber so short that is open to the tube has no stable shape: its gas runs out until it is a pellet. Makers
hold both necks and shut the passage in time. Then the gas is fixed, every shape of the theory is stable, and
the length alone does not tell which is wanted. Here it is

- down to the softest ball (20 mm of a 260) the one at the pressure of the tube: the unstable branch of the
  family of `bubble_shape`. Shorter ones take more and more rubber, down to a limit point (19.4 mm), below
  which nothing is blown up at that pressure;
- below, the one at the pressure of a smaller copy (Laplace), as much higher as it is shorter. Rubber, width
  and gas then shrink with the length, and the ball stays nearly round.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.bubble_quadrature import bubble_at_stretch
from balloon_usd.balloon.chebyshev import Series
from balloon_usd.balloon.tube_theory import inflated_rubber, maxwell_state

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.balloon.rubber import Floats, Rubber

_SOFTEST = 0.655
"""u of the softest ball: its widest hoop stretch is (1 - exp(-u)) times that of the tube."""
_HARDEST = 2.1
"""Pressure of the smallest ball that is solved, in pressures of the tube."""
_STRAY = (0.85, 1.1)
"""Bounds of u of a harder ball, in u of the softest times the share of its length: one root is in between."""
_NODES, _SECANTS = 14, 6
_CHEBYSHEV = np.asarray(np.polynomial.chebyshev.chebpts2(_NODES), dtype=float)


class Ball(NamedTuple):
    """A short bubble, in units of R0."""

    rest_length: float
    length: float
    diameter: float
    volume: float
    pressure: float
    """In pressures of the tube."""


class _Piece(NamedTuple):
    """A part of the balls, over their length."""

    u: Series
    rest_length: Series
    volume: Series

    @property
    def least(self) -> float:
        """Length of its shortest ball."""
        return self.u.least


@dataclass(frozen=True, eq=False)
class BallFamily:
    """The balls of a rubber."""

    tube_stretch: float
    """Hoop stretch of the bulged tube."""
    soft: _Piece
    """At the pressure of the tube."""
    hard: _Piece
    """Shorter ones, at higher pressure."""

    @property
    def softest(self) -> float:
        """Length of the shortest ball at the pressure of the tube."""
        return self.soft.least

    @property
    def smallest(self) -> float:
        """Length of the smallest ball that is solved; a shorter one is a copy of it."""
        return self.hard.least

    def of_length(self, length: float) -> Ball:
        """Return the ball of a length, at most that of the shortest stable bubble."""
        solved = max(length, self.smallest)
        piece = self.soft if solved >= self.softest else self.hard
        u, rest_length, volume = (series(solved) for series in piece)
        copy = length / solved
        return Ball(
            rest_length=rest_length * copy,
            length=length,
            diameter=2.0 * self.tube_stretch * (1.0 - math.exp(-u)) * copy,
            volume=volume * copy**3,
            pressure=max(1.0, self.softest / length),
        )


@lru_cache(maxsize=32)
def ball_family(rubber: Rubber, longest: float) -> BallFamily:
    """Return the balls of a rubber; `longest`: u of the shortest stable bubble, where they begin.

    Raises:
        ValueError: the rubber has no bulged phase, or no balls.
    """
    law, state = inflated_rubber(rubber), maxwell_state(rubber)
    tube = state.bulged.a

    def shapes(u: Floats, pressure: Floats) -> Floats:
        return bubble_at_stretch(law, pressure * state.p_star, tube * (1.0 - np.exp(-u)), tube)

    least, most = map(float, shapes(np.array([_SOFTEST, longest]), np.ones(2))[1])
    share = 0.5 * (_CHEBYSHEV + 1.0)
    shorter = (1.0 + (_HARDEST - 1.0) * share) / _HARDEST
    wanted = np.concatenate([least + (most - least) * share, least * shorter])
    pressure = np.concatenate([np.ones(_NODES), 1.0 / shorter])
    low, high = (
        np.concatenate([np.full(_NODES, end), stray * _SOFTEST * shorter])
        for end, stray in zip((_SOFTEST, longest), _STRAY, strict=True)
    )
    found = _by_secants(lambda u: shapes(u, pressure)[1] - wanted, low, high)
    rest_length, length, volume = shapes(found, pressure)
    if not np.allclose(length, wanted, rtol=1e-6, atol=0.0):
        raise ValueError(f"a short bubble of {rubber.name} cannot be blown up")
    values = np.stack([found, rest_length, volume], axis=1)
    soft, hard = (_piece(*both) for both in zip(np.split(wanted, 2), np.split(values, 2), strict=True))
    return BallFamily(tube, soft, hard)


def _by_secants(error: Callable[[Floats], Floats], low: Floats, high: Floats) -> Floats:
    """Return roots between two ends, for each of them, of an error that is nearly linear there."""
    before, after = error(low), error(high)
    for _ in range(_SECANTS):
        # Where an error is the same twice the root is found, to the last digit.
        apart = np.where(after == before, 1.0, after - before)
        low, high = high, high - (high - low) * np.where(after == before, 0.0, after / apart)
        before, after = after, error(high)
    return high


def _piece(lengths: Floats, values: Floats) -> _Piece:
    fit = np.polynomial.chebyshev.chebfit(_CHEBYSHEV, values, _NODES - 1)
    least, most = float(lengths[0]), float(lengths[-1])
    return _Piece(*(Series(least, most, column) for column in fit.T.tolist()))
