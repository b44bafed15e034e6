"""Blowing balloons up by hand: strokes of a pump, and the air of each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.operations.moves import Inflate
from balloon_usd.plan.laying_rounds import flat_volume

if TYPE_CHECKING:
    from balloon_usd.plan.model import Plan


class Pumping(NamedTuple):
    """How a hand pump blows a balloon up."""

    strokes: int
    air: float
    """Air of the room that each stroke brings, m3."""


def pumped(plan: Plan, balloon: str) -> Pumping | None:
    """Return how a hand pump blows a balloon up; None where air flows into it steadily."""
    moves = (move for move in plan.choreography.moves if isinstance(move, Inflate))
    strokes = next((move.strokes for move in moves if move.balloon == balloon), None)
    if strokes is None:
        return None
    strip = plan.strips[balloon]
    if strip.shape is not None:
        pressure, volume, flat = strip.shape.pressure, strip.shape.volume, strip.shape.surface.volume
    elif strip.blown is not None:
        pressure, volume = strip.blown.most.pressure, strip.blown.most.volume
        flat = flat_volume(strip.size)
    else:
        pressure, volume = plan.budgets[balloon].pressure, plan.budgets[balloon].volume
        flat = math.pi * strip.size.radius**2 * strip.size.length
    return Pumping(strokes, ((ATMOSPHERE + pressure) * volume / ATMOSPHERE - flat) / strokes)
