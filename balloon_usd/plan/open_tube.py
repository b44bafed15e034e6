"""The tube still open to the hands: from the last twist to the tip, with its gas and its empty tail.

While a tail is left the gas sits at the Maxwell pressure, so a twist only moves the front of the bulge on.
When the tail is used up, every further twist blows up what is left: also the bubble that it makes, for its
neck lets gas through until it is closed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.bubble_shape import (
    BubbleShape,
    bubble_of_length,
    pinch_length,
    pinch_volume,
    tail_volume_per_rest_length,
    tube_volume_per_rest_length,
)
from balloon_usd.balloon.filled_tube import filled_state, state_at_pressure
from balloon_usd.balloon.roots import root
from balloon_usd.balloon.rubber import Softening
from balloon_usd.balloon.tube_theory import TubeState, maxwell_state

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.rubber import Floats, Rubber
    from balloon_usd.balloon.sizes import BalloonSize

MILLIMETRE = 1e-3
"""Step in which tails are told, m."""
SHARE = 1e-3
"""Accuracy of the share by which bubbles have to be shorter."""
HALVINGS = 14
"""Of the pressure between before and after a twist, to find that at which its neck closes."""


class Twisted(NamedTuple):
    """A bubble that is twisted off."""

    length: float
    """Inflated length, m."""
    gas: float = 1.0
    """Share of the gas of that length that hands leave in it: a soft one keeps less."""
    drawn: float = 0.0
    """Unstressed rubber that its turns draw into the neck behind it, m."""
    slack: float = 1.0
    """Rubber, in that of a firm bubble of that length: hands gather more for what they will fold small."""

    def scaled(self, share: float) -> Twisted:
        """Return a bubble of a share of its length, with as many turns."""
        return self._replace(length=share * self.length)


@dataclass(frozen=True)
class OpenTube:
    """The part of a balloon beyond its last twist."""

    size: BalloonSize
    rubber: Rubber
    """Law of the rubber, with softening."""
    rest_length: float
    """Unstressed length of the open part, m."""
    volume: float
    """Gas in the open part at its pressure, m3."""

    @property
    def tail(self) -> float:
        """Flat rubber left empty at the tip, m; 0 when it is used up."""
        return max(self._tail_balance, 0.0)

    @property
    def inflated_rest_length(self) -> float:
        """Unstressed length of the inflated part, m; negative where the gas is used up."""
        return self.rest_length - self.tail

    @property
    def blown_up(self) -> bool:
        """Whether there is gas enough for the rounded end at the last twist: less is no tube any more."""
        return self.inflated_rest_length >= end_rest_length(self.size, self.rubber)

    @property
    def inflated_length(self) -> float:
        """Length of the inflated part, m: one end is rounded by its twist or knot."""
        full = self.inflated_rest_length * self.state.b
        return max(full - 0.5 * pinch_length(self.size, self.rubber), 0.0)

    @property
    def state(self) -> TubeState:
        """Stretches and pressure of the inflated part, in its middle."""
        filled = filled_state(self.size, self.rubber, self.rest_length, self.volume)
        return maxwell_state(self.rubber).bulged if filled is None else filled

    def pinched(self, bubble: Twisted) -> tuple[BubbleShape, OpenTube]:
        """Twist off a bubble; return it and what stays open, which are equally hard.

        From a tube harder than the Maxwell pressure, the same length takes less rubber and more gas.
        """
        before = self.state
        shape, left = self._parted(bubble, before)
        if not left.blown_up or left.state.p_star <= before.p_star:
            return shape, left
        low, high = before.p_star, left.state.p_star
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            _, left = self._parted(bubble, state_at_pressure(self.rubber, middle))
            softer = not left.blown_up or left.state.p_star < middle
            low, high = (low, middle) if softer else (middle, high)
        return self._parted(bubble, state_at_pressure(self.rubber, low))

    def _parted(self, bubble: Twisted, now: TubeState) -> tuple[BubbleShape, OpenTube]:
        """Return a bubble whose neck closes when the tube is in a state, and what stays open.

        It has the shape of a bubble at the Maxwell pressure that is as long for its width.
        """
        bulged = maxwell_state(self.rubber).bulged
        wider = now.a / bulged.a
        shape = bubble_of_length(self.size, self.rubber, bubble.length / wider)
        shape = replace(
            shape,
            rest_length=bubble.slack * shape.rest_length * wider * bulged.b / now.b,
            length=bubble.length,
            diameter=shape.diameter * wider,
            volume=bubble.gas * shape.volume * wider**3,
            pressure=shape.pressure * now.p_star / bulged.p_star,
        )
        left = replace(
            self,
            rest_length=self.rest_length - shape.rest_length - bubble.drawn,
            volume=self.volume - shape.volume,
        )
        return shape, left

    def closed(self) -> tuple[BubbleShape, OpenTube]:
        """Twist it off at its front: return the bubble that takes all its gas, and the flat rubber behind."""
        thin, bulged = tail_volume_per_rest_length(self.size, self.rubber), maxwell_state(self.rubber).bulged

        def gas_left(length: Floats) -> Floats:
            _, left = self._parted(Twisted(float(length)), bulged)
            return np.asarray(left.volume - thin * left.rest_length)

        longest = self.inflated_length + pinch_length(self.size, self.rubber)
        return self._parted(Twisted(float(root(gas_left, 1e-3 * self.size.radius, longest))), bulged)

    @property
    def _tail_balance(self) -> float:
        bulged = tube_volume_per_rest_length(self.size, self.rubber)
        thin = tail_volume_per_rest_length(self.size, self.rubber)
        lacking = bulged * self.rest_length - 0.5 * pinch_volume(self.size, self.rubber) - self.volume
        return lacking / (bulged - thin)


@dataclass(frozen=True)
class TailRange:
    """The flat tails (m) with which some bubbles can be made."""

    least: float
    """With less, the tail is used up before the last twist."""
    most: float
    """With more, the last bubble finds no gas. Below zero: the balloon is too short."""


def softened(rubber: Rubber) -> Rubber:
    """Return the rubber with softening: a bubble's shape needs it, whatever the simulation is asked to do."""
    return rubber if rubber.softening is not None else replace(rubber, softening=Softening())


def inflated_tube(size: BalloonSize, rubber: Rubber, tail: float) -> OpenTube:
    """Return a balloon blown up but for a flat tail (m) and knotted, before the first twist.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    rubber = softened(rubber)
    bulged = tube_volume_per_rest_length(size, rubber) * (size.length - tail)
    thin = tail_volume_per_rest_length(size, rubber) * tail
    return OpenTube(size, rubber, size.length, bulged + thin - 0.5 * pinch_volume(size, rubber))


def end_rest_length(size: BalloonSize, rubber: Rubber) -> float:
    """Return the unstressed length (m) of bulged tube whose gas one rounded end lacks.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    return 0.5 * pinch_volume(size, rubber) / tube_volume_per_rest_length(size, rubber)


def tail_range(size: BalloonSize, rubber: Rubber, bubbles: Sequence[Twisted]) -> TailRange:
    """Return the flat tails with which bubbles can be made.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    rubber = softened(rubber)
    bulged = tube_volume_per_rest_length(size, rubber)
    gained = bulged - tail_volume_per_rest_length(size, rubber)
    shapes = [bubble_of_length(size, rubber, bubble.length) for bubble in bubbles]
    gas = sum(bubble.gas * shape.volume for bubble, shape in zip(bubbles, shapes, strict=True))
    pairs = zip(bubbles, shapes, strict=True)
    rest = sum(bubble.slack * shape.rest_length + bubble.drawn for bubble, shape in pairs)
    used = (bulged * rest - gas) / gained
    return TailRange(used, size.length - rest - end_rest_length(size, rubber) + used)


def fitting_tail(size: BalloonSize, rubber: Rubber, bubbles: Sequence[Twisted]) -> float | None:
    """Return the longest flat tail (m, to a millimetre) with which bubbles fit, also where they use it up and
    blow up what is left harder; None where they fit with none.
    """
    if not _fit(inflated_tube(size, rubber, 0.0), bubbles):
        return None
    low, high = 0, math.ceil(size.length / MILLIMETRE)
    while high - low > 1:
        middle = (low + high) // 2
        fits = _fit(inflated_tube(size, rubber, middle * MILLIMETRE), bubbles)
        low, high = (middle, high) if fits else (low, middle)
    return low * MILLIMETRE


def fitting_share(size: BalloonSize, rubber: Rubber, tail: float, bubbles: Sequence[Twisted]) -> float:
    """Return the share of their inflated lengths with which bubbles fit beside a flat tail (m)."""
    low, high = 0.0, 1.0
    tube = inflated_tube(size, rubber, tail)
    while high - low > SHARE:
        middle = 0.5 * (low + high)
        fits = _fit(tube, [bubble.scaled(middle) for bubble in bubbles])
        low, high = (middle, high) if fits else (low, middle)
    return low


def fitting_length(size: BalloonSize, rubber: Rubber, tail: float, bubbles: Sequence[Twisted]) -> float:
    """Return the least flat length of a balloon (m, to a millimetre) in which bubbles fit beside a flat tail
    (m).
    """
    tube = inflated_tube(size, rubber, tail)
    gained = tube_volume_per_rest_length(size, tube.rubber)
    low, high = 0, math.ceil(sum(bubble.length for bubble in bubbles) / MILLIMETRE)
    while high - low > 1:
        middle = (low + high) // 2
        more = middle * MILLIMETRE
        longer = replace(tube, rest_length=tube.rest_length + more, volume=tube.volume + more * gained)
        low, high = (low, middle) if _fit(longer, bubbles) else (middle, high)
    return size.length + high * MILLIMETRE


def roomy_share(size: BalloonSize, rubber: Rubber, bubbles: Sequence[Twisted]) -> float:
    """Return the share of their inflated lengths with which bubbles fit and leave a flat tail."""
    low, high = 0.0, 1.0
    while high - low > SHARE:
        middle = 0.5 * (low + high)
        room = tail_range(size, rubber, [bubble.scaled(middle) for bubble in bubbles])
        low, high = (middle, high) if room.least + MILLIMETRE <= room.most else (low, middle)
    return low


def shortened(bubbles: Sequence[Twisted], share: float) -> tuple[float, list[Twisted]]:
    """Return by how much bubbles are shorter in all (m, up to a millimetre) at a share of their lengths, and
    what they are then.
    """
    total = sum(bubble.length for bubble in bubbles)
    shorter = math.ceil((1.0 - share) * total / MILLIMETRE) * MILLIMETRE
    return shorter, [bubble.scaled(1.0 - shorter / total) for bubble in bubbles]


def _fit(tube: OpenTube, bubbles: Sequence[Twisted]) -> bool:
    for bubble in bubbles:
        _, tube = tube.pinched(bubble)
        if not tube.blown_up:
            return False
    return True
