"""What a figure comes apart into where bubbles tear that are popped."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.language.joint import Joint
from balloon_usd.operations.disjoint_sets import DisjointSets

if TYPE_CHECKING:
    from balloon_usd.operations.workpiece import Workpiece


class Stretch(NamedTuple):
    """What of a balloon lies between two tears."""

    balloon: str
    behind: str | None
    """The bubble that tears before it; None of what begins at the knot."""
    before: str | None
    """The bubble that tears behind it; None of what ends at the tip."""


Part = tuple[Stretch, ...]
"""What stays together."""


def torn_bubbles(piece: Workpiece) -> frozenset[str]:
    """Return the bubbles that tear when they are popped: those of which both ends hang on something.

    What hangs on one joint only does not come apart.
    """
    last = {piece.row(balloon)[-1] for balloon in piece.balloons}
    return frozenset(name for name in piece.popped - last if len(piece.joint(Joint(name, "start"))) > 1)


def parts_of(piece: Workpiece) -> tuple[Part, ...]:
    """Return the parts of a figure; one where it does not come apart.

    What of each balloon, or of those that are joined, begins at the knot of the first is of the first part.
    """
    torn = torn_bubbles(piece)
    whole, pieces = _joined(piece, frozenset()), _joined(piece, torn)
    found: dict[Joint, dict[Joint, list[Stretch]]] = {}
    for balloon in piece.balloons:
        for stretch in _stretches(piece, balloon, torn):
            row = piece.row(balloon)
            end = Joint(stretch.behind, "end") if stretch.behind else Joint(row[0], "start")
            first = piece.joint(end)[0]
            parts = found.setdefault(whole.root(first), {})
            parts.setdefault(pieces.root(first), []).append(stretch)
    together = [list(parts.values()) for parts in found.values()]
    first_part = tuple(stretch for parts in together for stretch in parts[0])
    return (first_part, *(tuple(part) for parts in together for part in parts[1:]))


def _stretches(piece: Workpiece, balloon: str, torn: frozenset[str]) -> list[Stretch]:
    tears = [bubble for bubble in piece.row(balloon) if bubble in torn]
    return [Stretch(balloon, behind, before) for behind, before in pairwise([None, *tears, None])]


def _joined(piece: Workpiece, torn: frozenset[str]) -> DisjointSets[Joint]:
    """Return the joints that hang together by bubbles that are whole, and by rings that hold others."""
    first = {end: ends[0] for ends in piece.joints for end in ends}
    sets: DisjointSets[Joint] = DisjointSets()
    for name in piece.bubbles:
        if name not in torn:
            sets.merge([first[Joint(name, "start")], first[Joint(name, "end")]])
    for contact in piece.contacts:
        if piece.popped.isdisjoint((contact.bubble, *contact.others)):
            sets.merge([first[Joint(name, "start")] for name in (contact.bubble, *contact.others)])
    for balloon, host in piece.inside.items():
        # After a step some balloons are not begun yet.
        if balloon in piece.balloons and host in piece.bubbles:
            sets.merge([first[Joint(name, "start")] for name in (host, piece.row(balloon)[0])])
    return sets
