"""Flat tails after each twist, measured when it is done and held against the plan's budget."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.operations.moves import Pinch, Pop
from balloon_usd.solver.flat_tails import FlatTails

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame


class TwistTails:
    """Takes the frames of one sculpture, and measures in the last one before each next twist, or before the
    hands let go, or pop what is left of the balloon.
    """

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out when to measure; one mesh a balloon, in the order of `Plan.strips`."""
        self._tails = FlatTails(plan, meshes)
        self._balloon = {name: index for index, name in enumerate(self._tails.names)}
        self._due = _due(plan)
        self.off: dict[str, float] = {}
        """By how much the tail left after the twist that ends a bubble differs from the plan, m."""

    def add(self, frame: Frame) -> None:
        """Measure if a twist is done in this frame and the next one is not begun."""
        if due := self._due.get(frame.time_code):
            left = self._tails.left(frame)
            for balloon, bubble, planned in due:
                self.off[bubble] = left[self._balloon[balloon]] - planned


def _due(plan: Plan) -> dict[int, list[tuple[str, str, float]]]:
    """Return by time code the balloons that are measured, the bubbles twisted off, and the planned tails."""
    found: dict[int, list[tuple[str, str, float]]] = {}
    rings = plan.table.rings
    popped = {move.bubble: move.start for move in plan.choreography.moves if isinstance(move, Pop)}
    for balloon, budget in plan.budgets.items():
        planned = {twist.bubble: twist.tail_left for twist in budget.twists}
        pinches = [
            move
            for move in plan.choreography.moves
            if isinstance(move, Pinch) and rings[move.ring].balloon == balloon
        ]
        over = popped.get(plan.strips[balloon].bubbles[-1].name, plan.choreography.let_go)
        ends = [*[move.start for move in pinches[1:]], over]
        # A balloon that is not twisted has no pinches.
        for move, end in zip(pinches, ends, strict=False):
            bubble = rings[move.ring].bubble
            if bubble in planned:
                # The time of a frame is (code - 1) / fps.
                code = min(max(1, math.ceil(end * plan.recipe.fps)), plan.frame_count)
                found.setdefault(code, []).append((balloon, bubble, planned[bubble]))
    return found
