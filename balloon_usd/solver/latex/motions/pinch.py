"""Closing the neck behind a bubble of latex that is twisted off, between two fingers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.latex.motions.ball import SqueezedBall, amount_of, is_held, shut_in
from balloon_usd.solver.latex.motions.carry_inside import CarryInside
from balloon_usd.solver.latex.motions.closing_neck import ClosingNeck
from balloon_usd.solver.latex.motions.steady import steady

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.operations import moves
    from balloon_usd.plan.strip import PlannedBubble
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Pinch(ClosingNeck):
    """Fingers that close a neck, and hold a short or soft bubble before it at its length."""

    def __init__(self, move: moves.Pinch, sculpture: LatexSculpture) -> None:
        """Take the ring between the fingers, and steady what is before it."""
        super().__init__(move.ring, sculpture)
        steady(sculpture, move.ring)
        bubbles = shut_in(sculpture, move.ring)
        self._ball: SqueezedBall | None = None
        if is_held(sculpture, move.ring, bubbles):
            # All its gas would leave through an open neck: what has to leave is pushed out.
            self._ball = SqueezedBall(sculpture, move.ring, bubbles)
            self.shut()
            if len(bubbles) > 1 or _is_left_slack(sculpture, bubbles):
                # So soft meanwhile that the walls beside it come in over its neck.
                self._hands.touch(sculpture.bodies)
        else:
            self.keep(sum(amount_of(sculpture, bubble) for bubble in bubbles))
        self._inside = CarryInside(sculpture, sculpture.balloons[move.ring])

    def advance(self, share: float) -> None:
        """Close the neck by a share, and bring what is before it to its length and its gas."""
        self._inside.advance()
        super().advance(share)
        if self._ball is not None:
            self._ball.squeeze(share)


def _is_left_slack(sculpture: LatexSculpture, bubbles: Iterable[PlannedBubble]) -> bool:
    """Tell whether one of some bubbles is given rubber with which a later step than its own closes it."""
    steps = sculpture.plan.recipe.steps
    return any(bubble.slack > steps[bubble.step].slack for bubble in bubbles)
