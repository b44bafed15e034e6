"""Bending a bubble of latex, which keeps part of its curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.motions.bend import Bend

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexBend(Bend):
    """A bubble of latex that is led onto an arc."""

    _sculpture: LatexSculpture

    def take(self, joint: int) -> None:
        """Grip a ring: bending a tube that is blown up takes more than a light push."""
        self._hands.grip(joint, self._sculpture.frame.middle)

    def set_bend(self, bubble: str) -> None:
        """Squeeze the inside of the bend."""
        body, faces = self._sculpture.faces(bubble)
        set_bend(self._sculpture.scene, body, faces)
