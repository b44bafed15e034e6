"""Turning a limb of a figure about the joint at which it hangs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.latex.led_limb import LedLimb, hold_figure
from balloon_usd.solver.latex.motions.heart_face import HeartFace
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Aim(Motion):
    """A limb that is led as it is about its joint, while hands hold all the rest."""

    def __init__(self, move: moves.Aim, sculpture: LatexSculpture) -> None:
        """Take hold of the limb and of all the rest."""
        piece = sculpture.plan.recipe.piece.after(move.step)
        limb = piece.limb(move.bubble)
        assert limb is not None, "what is aimed hangs on a joint"
        self._limb = LedLimb(sculpture, piece, limb)
        hold_figure(sculpture)
        self._limb.take()
        base, places = self._limb.base, sculpture.frame.middle
        own = self._limb.outer(move.bubble)
        if any(end.bubble == move.bubble for end in piece.joint(limb.joint)):
            # Else it lies across, on the far side of a ring of others, and points by its middle.
            own = [max(own, key=lambda joint: float(np.linalg.norm(places[joint] - base)))]
        arm = self._limb.way_to(own)
        self._arm, self._spin = arm, move.spin
        self._axis, self._angle = turn_between(arm, np.array(move.toward))
        self._face: HeartFace | None = None
        if sculpture.plan.strips[piece.bubbles[move.bubble].balloon].size.heart:
            turn, toward = turn_about(self._axis, self._angle), np.array(move.toward)
            self._face = HeartFace(sculpture, move.bubble, base, turn, toward, move.spin)

    def advance(self, share: float) -> None:
        """Lead it on about its joint."""
        gone = smooth(share)
        turn = turn_about(self._axis, gone * self._angle)
        self._limb.turn(turn @ turn_about(self._arm, gone * self._spin))
        if self._face is not None:
            self._face.advance(share, turn, turn @ self._arm)
