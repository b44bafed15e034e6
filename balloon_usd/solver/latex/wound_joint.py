"""A wound joint: its turns, the torque with which it springs back, and how far it has opened."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.bubble_shape import neck_rubber, neck_rubber_of_length
from balloon_usd.balloon.wound_neck import drawing_torque, drawn_rubber, rope_stretch, wound_rigidity
from balloon_usd.plan.open_tube import softened

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip

FULL_TURN = 2.0 * math.pi
CLOSED_ANGLE = math.pi
"""Wound angle from which a neck is closed, rad: the meridians of a tube turned by half a turn meet."""
OPEN_ANGLE = 0.05 * FULL_TURN
"""Wound angle at which a neck is as good as its tube, rad: its waist is 99 % as wide."""


@dataclass
class WoundJoint:
    """A joint and the turns that are wound into it."""

    strip: Strip
    """Its balloon."""
    bubble: str
    """The bubble before it."""
    neck: float
    """Radius of the closed neck, m."""
    wide: float
    """Radius of the tube before it was pinched, m."""
    planned: float
    """Unstressed rubber that its turns are planned to draw in, m."""
    turns: float = 0.0
    """Full turns of what lies beyond, seen against what lies before; signed."""
    impulse: float = 0.0
    """Of the torque with which it unwinds, so far, less what the air has braked, N m s."""
    pressure: float = 0.0
    """Of the gas beside it, Pa."""
    waits: bool = False
    """Whether it stays closed until a neck beside it has opened."""
    held: bool = True
    """Whether hands, a lock or a ring that a lock closes keep it from unwinding."""

    @cached_property
    def stiffness(self) -> float:
        """Torque for each radian of what it hides alone, N m."""
        return rope_stiffness(self.strip, self.bubble, self.neck)

    @cached_property
    def most_torque(self) -> float:
        """Torque at which turns draw rubber in, N m."""
        return drawing_torque(self.strip.size, softened(self.strip.rubber))

    @property
    def drawn(self) -> float:
        """Share of what its turns are planned to draw in that is drawn in; 0 where that is nothing."""
        if self.planned == 0.0:
            return 0.0
        return drawn_rubber(self.strip.size, softened(self.strip.rubber), self.turns) / self.planned

    @property
    def angle(self) -> float:
        """Wound angle without its sense, rad."""
        return FULL_TURN * abs(self.turns)

    @property
    def waist(self) -> float:
        """Radius to which its meridians, as inextensible strings, have opened, m."""
        return self.wide * math.cos(0.5 * min(self.angle, CLOSED_ANGLE))

    @property
    def torque(self) -> float:
        """Torque with which it would unwind, N m (Rivlin 1949), up to that at which turns draw rubber in; gas
        in an open neck keeps it up.
        """
        if self.waits:
            return 0.0
        return math.copysign(min((self.stiffness + self._cage) * self.angle, self.most_torque), self.turns)

    @property
    def spring(self) -> float:
        """By how much its torque falls for each radian by which it unwinds, N m."""
        stiffness = self.stiffness + self._cage
        return stiffness if stiffness * self.angle < self.most_torque and not self.waits else 0.0

    @property
    def _cage(self) -> float:
        """Torque of the gas in its neck for each radian, N m: pressure times the volume that a hyperboloid of
        inextensible strings, as long as it is wide, wins as it is unwound; 0 of a neck that is closed.
        """
        if self.angle >= CLOSED_ANGLE:
            return 0.0
        volume = 2.0 / 3.0 * math.pi * self.wide**3 * float(np.sinc(self.angle / math.pi))
        return max(self.pressure, 0.0) * volume

    def turn(self, angle: float) -> None:
        """Let what lies beyond turn by an angle (rad); what is as good as open springs no more."""
        before = self.turns
        self.turns += angle / FULL_TURN
        if self.turns * before <= 0.0 or self.angle < OPEN_ANGLE:
            self.turns = self.impulse = 0.0


def rope_stiffness(strip: Strip, bubble: str, neck: float) -> float:
    """Return the torque for each radian (N m) of the wound neck behind a bubble; `neck`: its radius, m.

    The rubber that it hides is a rod of the wall's cross-section.
    """
    if strip.is_round:
        # Its strands run straight inwards, stretched as those of a tube are.
        length = 2.0 * neck / rope_stretch(softened(strip.rubber))
    else:
        length = _hidden_rubber(strip, bubble, neck)
    return wound_rigidity(strip.size, strip.rubber) / length


def _hidden_rubber(strip: Strip, bubble: str, neck: float) -> float:
    """Return the rubber that the neck behind a bubble of a tube hides, m."""
    at = next(k for k, planned in enumerate(strip.bubbles) if planned.name == bubble)
    rubber = softened(strip.rubber)
    balls = strip.balls()
    length = 0.0
    for k, planned in enumerate(strip.bubbles[at : at + 2], at):
        if k in balls:
            length += neck_rubber_of_length(strip.size, rubber, planned.length, neck)
        else:
            length += neck_rubber(strip.size, rubber, planned.wall_length, neck)
    return length
