"""What a sculpture is doing."""

from __future__ import annotations

from typing import NamedTuple

COMES_UNDONE = "comes undone: "
"""How what a sculpture is doing begins while joints come undone, before their names."""


class Status(NamedTuple):
    """What a sculpture is doing, for messages."""

    doing: str
    """What the hands do."""
    undone: tuple[str, ...] = ()
    """Locks that have slipped and joints that have come undone so far."""
