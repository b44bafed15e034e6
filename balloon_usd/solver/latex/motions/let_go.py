"""Taking the hands from latex: welds hold by friction, and what nothing holds comes undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.let_go import LetGo

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexLetGo(LetGo):
    """Hands that let go, and the joints that untwist when they do so for good."""

    def __init__(self, move: moves.LetGo, sculpture: LatexSculpture) -> None:
        """Let go, and leave the pose to the friction of the welds."""
        super().__init__(move, sculpture)
        self._sculpture, self._for_good = sculpture, move.for_good
        if move.for_good:
            sculpture.torsion.let_go(sculpture.struts)
        sculpture.hold_pose()

    @property
    def ended(self) -> bool:
        """Whether nothing untwists any more."""
        return not self._for_good or not self._sculpture.unwinding

    def advance(self, _: float) -> None:
        """Let all loose joints untwist."""
        if self._for_good:
            begin, end, middle = self._sculpture.frame
            self._sculpture.torsion.unwind(end - begin, middle)
