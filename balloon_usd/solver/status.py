"""What a sculpture is doing."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

COMES_UNDONE = "comes undone: "
"""How what a sculpture is doing begins while joints come undone, before their names."""
BETWEEN_NAMES = ", "
"""What stands between two of them."""


def comes_undone(joints: Iterable[str]) -> str:
    """Return what a sculpture is doing while joints of these names come undone."""
    return COMES_UNDONE + BETWEEN_NAMES.join(joints)


def coming_undone(doing: str) -> list[str]:
    """Return the names of the joints that come undone, of what a sculpture is doing."""
    return doing.removeprefix(COMES_UNDONE).split(BETWEEN_NAMES) if doing.startswith(COMES_UNDONE) else []


class Status(NamedTuple):
    """What a sculpture is doing, for messages."""

    doing: str
    """What the hands do."""
    undone: tuple[str, ...] = ()
    """Locks that have slipped and joints that have come undone so far."""
