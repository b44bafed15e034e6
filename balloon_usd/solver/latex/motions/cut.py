"""Cutting an end of a balloon off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.severed import Severed, Stub

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Cut(Motion):
    """Scissors at the joint on which an end of a balloon hangs: it weighs nothing any more, and is not shown.

    In the simulation its rubber hangs there still, limp.
    """

    def __init__(self, move: moves.Cut, sculpture: LatexSculpture) -> None:
        """Find what is cut off."""
        self._sculpture, self._bubble = sculpture, move.bubble
        start, end = sculpture.plan.table.ends(move.bubble)
        ring, side = (start, 1) if end is None else (end, -1)
        self._body = sculpture.body[sculpture.plan.table.rings[ring].balloon]
        first, around = (int(values[sculpture.joints[ring]]) for values in sculpture.hands.rings)
        first -= int(sculpture.scene.vertex_start[self._body])
        self._stub = Stub.at(sculpture.scene.bodies[self._body], first, around, side)

    def advance(self, share: float) -> None:
        """Show how it snaps into its joint."""
        sculpture = self._sculpture
        balloon = self._body - sculpture.bodies[0]
        sculpture.severed[self._bubble] = Severed(balloon, self._stub, smooth(share))
        if share >= 1.0:
            sculpture.weigh_nothing(self._body, self._stub.vertices)
