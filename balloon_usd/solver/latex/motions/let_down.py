"""Letting air out of a balloon that was blown up farther than it will be."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.plan.budget import amount
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

DONE = 0.95
"""Share of the time in which the air is out."""


class LetDown(Motion):
    """Fingers that open the neck of a round balloon: air goes out in an even flow, its knot is held."""

    def __init__(self, move: moves.LetDown, sculpture: LatexSculpture) -> None:
        """Take its neck between two fingers."""
        blown = sculpture.plan.strips[move.balloon].blown
        assert blown is not None, "only round balloons are let down"
        scene, hands, b = sculpture.scene, sculpture.hands, sculpture.body[move.balloon]
        self._hands, self._body = hands, b
        share = polygon_share(scene.bodies[b].rings[0].around)
        hands.pump_goal[b] = amount(blown.pressure, blown.volume) * share
        self._flow = float(hands.pump_goal[b] - hands.amount[scene.bubbles_of(b)].sum())
        self._flow /= DONE * move.seconds
        hands.grip(int(scene.joint_start[b]) + 1, sculpture.frame.middle)

    def advance(self, share: float) -> None:
        """Let air out, until the neck is shut again."""
        self._hands.pump_flow[self._body] = self._flow if share < 1.0 else 0.0
