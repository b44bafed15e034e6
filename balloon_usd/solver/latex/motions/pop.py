"""Popping a bubble: its gas is gone at once, it tears, and its rubber snaps back to what it was when flat."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.latex.tearing import tear
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Pop(Motion):
    """A needle at a bubble."""

    def __init__(self, move: moves.Pop, sculpture: LatexSculpture) -> None:
        """Prick it: what has burst keeps no pose."""
        self._hands = sculpture.hands
        start, end = sculpture.plan.table.ends(move.bubble)
        ring, side = (start, 1) if end is None else (end, 0)
        self._segment = int(self._hands.beside[sculpture.joints[ring], side])
        sculpture.friction.popped.add(move.bubble)
        balloon, number = sculpture.place(move.bubble)
        if sculpture.plan.strips[balloon].bubbles[number].tears:
            tear(move.bubble, sculpture)
        self._begun = float(self._hands.pressure[self._segment])
        sculpture.give_up_pose()

    def advance(self, share: float) -> None:
        """Let its pressure fall to that of the room."""
        self._hands.vent(self._segment, (1.0 - share) * self._begun)
