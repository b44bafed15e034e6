"""Leading a bubble of latex onto a curve, of which it keeps a part."""

from __future__ import annotations

from abc import ABC
from typing import TYPE_CHECKING

from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.motions.curve import AMove, Curve

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexCurve(Curve[AMove], ABC):
    """A bubble of latex that is led onto a curve."""

    _sculpture: LatexSculpture

    def __init__(self, move: AMove, sculpture: LatexSculpture) -> None:
        """Take hold of the bubble and of what hangs on it; from now on walls touch."""
        super().__init__(move, sculpture)
        sculpture.hands.touch(sculpture.bodies)

    def take(self, joint: int) -> None:
        """Grip a ring: bending a tube that is blown up takes more than a light push."""
        self._hands.grip(joint, self._sculpture.frame.middle)

    def set_bend(self, bubble: str) -> None:
        """Squeeze the inside of the curve."""
        body, faces = self._sculpture.faces(bubble)
        set_bend(self._sculpture.scene, body, faces)
