"""Operations that press the knot of a balloon through its first bubble, whose wall is turned inside."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import quoted
from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.operation import BubbleKind, MakesBubbles

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Path
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

LONGEST = 1.5
"""Length of the longest tulip, in diameters of its tube: in simulations of a 260 the wall that is turned
inside one of 7.5 cm stays taut; in one of 9 it is slack, and the bubble flutters about it.
"""
SHORTEST = 0.7
"""The same of the shortest one: the wall of one of 3 cm folds aside, its knot stays before it."""
INVERT_SECONDS = 2.0
"""Time in which a knot is pressed through, s."""


class InvertsBubble(Turned, MakesBubbles):
    """An operation that makes the first bubble of a balloon a tulip."""

    bubble_kind: ClassVar[BubbleKind | None] = "tulip"
    closes: ClassVar[bool] = True
    inverts: ClassVar[bool] = True
    slack: ClassVar[float] = 1.2

    @classmethod
    def check_first(cls, name: str, path: Path, place: Place, bench: Workbench) -> None:
        """Complain of a bubble that was made just now and is not the first one of its balloon."""
        made = bench.piece.bubbles.get(name)
        if made is None or made.step != place.index:
            return
        gone, other = "this step before that one", "the bubble at the knot, which is pressed through it"
        if fault := fault_at_knot(bench.piece, name, if_gone=gone, if_other=other):
            bench.complain(path, fault)

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are too short for the knot, or too long to be held taut by what is inside."""
        for name, length in self.lengths.items():
            bubble = layout.bubble(name)
            what, fault = f"{cm(length)} of a {bubble.size}", None
            if length < (least := SHORTEST * bubble.width):
                fault = f"{what} are too short for a tulip, the knot has no room in it"
                fault += f", expected {at_least(least)} or more, or ear"
            elif length > (most := LONGEST * bubble.width):
                fault = f"{what} are too long for a tulip, what is turned inside is slack"
                fault += f", expected {at_most(most)} or less"
            if fault is not None:
                yield self.path_of(name), fault


def fault_at_knot(piece: Workpiece, name: str, *, if_gone: str, if_other: str) -> str:
    """Say that a bubble is not the first one of its balloon, and what is expected instead, where the knot is
    gone and where another bubble is there; nothing where it is the first one.
    """
    balloon = piece.bubbles[name].balloon
    first = piece.row(balloon)[0]
    if first == name:
        return ""
    if first in piece.popped:
        return f"{quoted(balloon)} has no knot any more, {quoted(first)} is popped: expected {if_gone}"
    what = f"{quoted(name)} is not the first bubble of {quoted(balloon)}, {quoted(first)} is"
    return f"{what}: expected {if_other}"
