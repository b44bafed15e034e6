"""Which time codes of two stages are shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.diff.movement import Movement
    from balloon_usd.diff.two_files import Comparison


def shown_moments(comparison: Comparison, start: float, end: float) -> tuple[float, ...]:
    """Return the first time code at which a surface moved, that of the largest distance, and the last.

    Begin, middle and end of the animation where none moved.
    """
    moved = movements_of(comparison)
    codes = [moment.time_code for movement in moved for moment in movement.moments]
    known = [code for code in codes if code is not None]
    if known:
        worst = max(moved, key=lambda movement: movement.worst.distance).worst.time_code
        chosen = {known[0] if worst is None else worst, min(known), max(known)}
    else:
        chosen = {start, float(round(0.5 * (start + end))), end}
    return tuple(sorted(chosen))


def movements_of(comparison: Comparison) -> list[Movement]:
    """Return how far surfaces and bubbles moved, under the stages' own selection of variants."""
    found = comparison.differences
    return [one.movement for one in found if one.movement is not None and not one.selection]
