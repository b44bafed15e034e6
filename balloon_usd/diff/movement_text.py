"""How far a surface moved, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.diff.difference import Difference, Spread
from balloon_usd.diff.movement import STILL

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.diff.measuring import Measured
    from balloon_usd.diff.movement import Moment, Movement

SAME_VOLUME = 1e-4
"""Relative change of volume below which it is not told."""


def told_movements(path: str, measured: Measured, floor: float) -> Iterator[Difference]:
    """Say how far a surface and its bubbles moved, if they moved farther than a distance.

    Args:
        path: of the prim.
        measured: both surfaces.
        floor: distance that is tolerated (m).
    """
    moved = [movement for movement in measured.movements if _is_worth_telling(movement, floor)]
    bubbles = [movement for movement in moved if movement.bubble]
    for movement in bubbles if len(bubbles) == 1 else moved:
        text = movement_text(path, movement, measured.compared)
        yield Difference(path, text, spread=_spread(movement, measured.compared), movement=movement)


def told_mean(path: str, measured: Measured, limit: float) -> Iterator[Difference]:
    """Say how far a surface moved if all of its points together lie farther than a limit (m)."""
    for movement in measured.movements:
        mean = movement.rms.rms or 0.0
        if not movement.bubble and mean > limit:
            text = movement_text(path, movement, measured.compared)
            text += f"; rms {length_text(mean)}{_when(movement.rms)}, beyond {length_text(limit)}"
            yield Difference(path, text, spread=_spread(movement, measured.compared), movement=movement)


def movement_text(path: str, movement: Movement, compared: int) -> str:
    """Write as in `left_ear moved 3 mm at 212 (largest, vertex 17), rms 0.8 mm, volume -1.2 %`."""
    worst = movement.worst
    name = movement.bubble or path.rpartition("/")[2]
    when = _when(worst)
    if worst.rms is None:
        return f"{name}: {', '.join(_unlike_text(movement))}"
    text = f"{name} moved {length_text(worst.distance)}{when} (largest, vertex {worst.vertex})"
    text += f", rms {length_text(worst.rms)}"
    if abs(worst.growth) > SAME_VOLUME:
        text += f", volume {100.0 * worst.growth:+.2g} %"
    spread = _spread(movement, compared)
    return f"{text}; {spread}" if spread else text


def _unlike_text(movement: Movement) -> Iterator[str]:
    """Say how extent and volume differ, as far as they do."""
    worst = movement.worst
    if worst.distance > STILL:
        yield f"extents {length_text(worst.distance)} apart{_when(worst)}"
    grown = max(movement.moments, key=lambda moment: abs(moment.growth))
    if abs(grown.growth) > SAME_VOLUME:
        yield f"volume {100.0 * grown.growth:+.2g} %{_when(grown)}"


def _when(moment: Moment) -> str:
    return "" if moment.time_code is None else f" at {moment.time_code:g}"


def length_text(metres: float) -> str:
    """Write a distance in the unit that people use at its size."""
    if metres >= 10.0:
        return f"{metres:.3g} m"
    return f"{1e3 * metres:.3g} mm" if metres >= 1e-5 else f"{1e6 * metres:.2g} um"


def _is_worth_telling(movement: Movement, floor: float) -> bool:
    worst = max(abs(moment.growth) for moment in movement.moments)
    unlike = movement.worst.rms is None and worst > SAME_VOLUME
    return movement.worst.distance > max(floor, STILL) or unlike


def _spread(movement: Movement, compared: int) -> Spread | None:
    moments, worst = movement.moments, movement.worst
    if worst.time_code is None:
        return None
    first, last = moments[0].time_code or 0.0, moments[-1].time_code or 0.0
    return Spread(worst.time_code, first, last, len(moments), compared)
