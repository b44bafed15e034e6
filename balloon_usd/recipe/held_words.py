"""Which joints must hold: are they there?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import unknown
from balloon_usd.language.joint import joint
from balloon_usd.language.problem import Complaint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.workpiece import Workpiece

MUST_HOLD = "must_hold"
EVERY, PLANNED = "all", "planned"
"""All joints must hold; those of which the plan expects it."""


def held_complaints(data: object, piece: Workpiece) -> Iterator[Complaint]:
    """Yield what of the joints that must hold is no joint of the finished figure.

    `data`: plain data of a recipe, of whatever shape it is; `piece`: what its steps make.
    """
    entries = data.get(MUST_HOLD) if isinstance(data, dict) else None
    for at, entry in enumerate(entries if isinstance(entries, (list, tuple)) else ()):
        try:
            end = joint(entry)
        except ValueError:
            continue
        path = (MUST_HOLD, at)
        if end.bubble not in piece.bubbles:
            yield Complaint(path, unknown("bubble", end.bubble, piece.bubbles))
        elif len(piece.joint(end)) < 2:
            yield Complaint(path, f"{end} is an end of its balloon, expected a joint at which bubbles meet")
