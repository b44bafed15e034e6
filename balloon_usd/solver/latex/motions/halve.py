"""Closing a neck of latex in the middle of gas that is shut in already."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.latex.motions.ball import amount_of
from balloon_usd.solver.latex.motions.closing_neck import ClosingNeck

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Halve(ClosingNeck):
    """Fingers that part a bubble in two, each of which keeps its share of the gas."""

    def __init__(self, move: moves.Halve, sculpture: LatexSculpture) -> None:
        """Take the ring between the fingers."""
        gas = sculpture.hands.amount_before(sculpture.joints[move.ring])
        super().__init__(move.ring, sculpture)
        _, at = sculpture.place(sculpture.plan.table.rings[move.ring].bubble)
        halves = sculpture.strip_of(move.ring).bubbles[at : at + 2]
        before, behind = (amount_of(sculpture, bubble) for bubble in halves)
        self.keep(gas * before / (before + behind))
