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
        super().__init__(move.ring, sculpture)
        strip, name = sculpture.strip_of(move.ring), sculpture.plan.table.rings[move.ring].bubble
        at = next(k for k, bubble in enumerate(strip.bubbles) if bubble.name == name)
        before, behind = (amount_of(sculpture, bubble) for bubble in strip.bubbles[at : at + 2])
        self.keep(self.gas * before / (before + behind))
