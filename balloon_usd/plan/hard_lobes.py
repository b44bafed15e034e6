"""Parts of twisted round balloons that will be hard, and how long they have to be not to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.pressures import kilopascals
from balloon_usd.operations.caution import Caution
from balloon_usd.plan.twisting_rounds import fitting_heights, twisted_round

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.plan.strip import BlownRound, Strip

HARD = 10.0e3
"""Pressure from which on a part is told to be hard, Pa: ears of a 260, its hardest bubbles, have as much."""


def hard_lobes(strip: Strip) -> Iterator[Caution]:
    """Warn of the parts of a round balloon that need far more pressure than it has."""
    if strip.blown is None or len(strip.bubbles) < 2:
        return
    for number, bubble in enumerate(strip.bubbles):
        pressure = bubble.pressure or 0.0
        if pressure > HARD:
            yield Caution(
                bubble.step,
                f"{bubble.name} ({cm(bubble.length)}) will be a hard little ball",
                f"so small a part of an {strip.size.name} needs {kilopascals(pressure)}, "
                f"where the balloon has {strip.blown.pressure / 1e3:.1f}",
                _remedy(strip, strip.blown, number),
            )


def _remedy(strip: Strip, blown: BlownRound, number: int) -> str:
    if number == len(strip.bubbles) - 1:
        before = strip.bubbles[number - 1]
        return "twist fewer bubbles off" if (before.pressure or 0.0) > HARD else f"make {before.name} shorter"
    lengths = tuple(bubble.length for bubble in strip.bubbles[:number])
    _, left = twisted_round(strip.size, strip.rubber, blown, lengths)
    softer = fitting_heights(left, HARD)
    return "make it longer" if softer is None else f"make it {at_least(softer[0])} or longer"
