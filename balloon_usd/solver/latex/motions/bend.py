"""Bending a bubble of latex, which keeps part of its curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.motions.bend import Bend

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexBend(Bend):
    """A bubble of latex that is led onto an arc."""

    def __init__(self, move: moves.Bend, sculpture: LatexSculpture) -> None:
        """Take hold of the bubble and of what hangs on it."""
        super().__init__(move, sculpture)
        self._sculpture = sculpture

    def set_bend(self, bubble: str) -> None:
        """Squeeze the inside of the bend."""
        body, faces = self._sculpture.faces(bubble)
        set_bend(self._sculpture.scene, body, faces)
