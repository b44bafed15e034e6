"""Parts of twisted round balloons that will be hard, and how long they have to be not to."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from balloon_usd.language.lengths import at_least, cm
from balloon_usd.operations.caution import Caution
from balloon_usd.plan.twisting_rounds import MOST_FLAT, twisted_round

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.plan.strip import Strip

HARD = 10.0e3
"""Pressure from which on a part is told to be hard, Pa: ears of a 260, its hardest bubbles, have as much."""
LONGER, TRIES = 1.2, 8
"""Factor by which a part is made longer to find one that is not hard, and how often that is tried."""
HALVINGS = 5
"""How often the last of these steps is halved then."""


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
                f"so small a part of an {strip.size.name} needs {pressure / 1e3:.1f} kPa, "
                f"where the balloon has {strip.blown.pressure / 1e3:.1f}",
                _remedy(strip, number),
            )


def _remedy(strip: Strip, number: int) -> str:
    if number == len(strip.bubbles) - 1:
        before = strip.bubbles[number - 1]
        return "twist fewer bubbles off" if (before.pressure or 0.0) > HARD else f"make {before.name} shorter"
    softer = _softer(strip, number)
    return "make it longer" if softer is None else f"make it {at_least(softer)} or longer"


def _softer(strip: Strip, number: int) -> float | None:
    """Return the length (m) of the shortest bubble in a place that is not hard; None where none is found."""
    hard = strip.bubbles[number].length
    longer = (hard * LONGER**times for times in range(1, TRIES + 1))
    soft = next((length for length in longer if _is_soft(strip, number, length)), None)
    if soft is None:
        return None
    hard = soft / LONGER
    for _ in range(HALVINGS):
        middle = 0.5 * (hard + soft)
        hard, soft = (hard, middle) if _is_soft(strip, number, middle) else (middle, soft)
    return soft


def _is_soft(strip: Strip, number: int, length: float) -> bool:
    """Tell whether a bubble of a length (m) can be twisted off behind those before it, and is not hard."""
    assert strip.blown is not None, "it is a round balloon"
    heights = (*(bubble.length for bubble in strip.bubbles[:number]), length)
    with contextlib.suppress(ValueError):
        lobe, _ = twisted_round(strip.size, strip.rubber, strip.blown, heights)
        return lobe.width <= MOST_FLAT * lobe.height and lobe.pressure <= HARD
    return False
