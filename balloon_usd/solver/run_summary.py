"""Summary of a run: highest stretch, load of the walls, tail left, gas off the plan, what came undone."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.operations.moves import LetDown
from balloon_usd.solver.bursting import NEAR, NO_LOAD, Bursting, WallLoad
from balloon_usd.solver.flat_tails import FlatTails
from balloon_usd.solver.planned_gas import shares_of_planned_gas

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

GAS_OFF = 0.1
"""Share by which the gas of a bubble may miss the plan."""


class RunSummary:
    """Reduces the frames of one sculpture to a few numbers."""

    def __init__(self, plan: Plan, meshes: tuple[BalloonMesh, ...]) -> None:
        """Begin without frames."""
        self._plan = plan
        self._meshes = meshes
        self._tails = FlatTails(plan, meshes)
        self._bursting = Bursting(plan, meshes)
        self._near = NO_LOAD
        """Highest load in the frames in which a wall might have burst, or was blown up farthest."""
        self._fullest = _fullest(plan)
        self._last: Frame | None = None
        self.highest_stretch = 0.0
        """Largest principal stretch so far of any wall that is not led out of others."""
        self.highest_bubble = ""
        """Bubble in which it was."""

    def add(self, frame: Frame) -> None:
        """Add one more frame."""
        self._last = frame
        near = False
        for index, (strip, mesh) in enumerate(zip(self._plan.strips.values(), self._meshes, strict=True)):
            stretch = frame.forced(index)
            worst = int(np.argmax(stretch))
            highest = float(stretch[worst])
            near = near or self._bursting.near(index, stretch, highest)
            if highest > self.highest_stretch:
                self.highest_stretch = highest
                self.highest_bubble = strip.bubble_at(float(mesh.along[worst])).name
        if near:
            self._near = max(self._near, self._bursting.load(frame, NEAR))
        if frame.time_code in self._fullest:
            self._near = max(self._near, self._bursting.load(frame))

    @property
    def undone(self) -> tuple[str, ...]:
        """Locks that have slipped and joints that have come undone."""
        return () if self._last is None else self._last.undone

    @property
    def wall_load(self) -> WallLoad:
        """Load of the walls: the highest in all frames in which one was near bursting, before air is let out,
        and in the last.
        """
        return self._near if self._last is None else max(self._near, self._bursting.load(self._last))

    @property
    def bursts(self) -> bool:
        """Whether latex would have burst; springs do not."""
        return self._near.load > 1.0

    @property
    def hard(self) -> dict[str, tuple[str, float]]:
        """The hardest bubble and its gauge pressure in the last frame, Pa, of balloons without tail left."""
        if self._last is None or not self._plan.recipe.physics.traits.winds:
            return {}
        pressures = dict(zip(self._plan.bubbles, self._last.pressure.tolist(), strict=True))
        left = self.tails_left
        found = {}
        for name, budget in self._plan.budgets.items():
            if budget.twists and left[name] <= 0.0:
                bubble = max(self._plan.strips[name].bubbles, key=lambda each: pressures[each])
                found[name] = bubble.name, pressures[bubble]
        return found

    @property
    def gas_off(self) -> dict[str, float]:
        """Gas of the bubbles that have missed the plan, in shares of the planned, by name.

        None before the end, of what leaks on purpose or has no pressure, of bubbles whose twists came undone,
        and of limp ones.
        """
        last, plan = self._last, self._plan
        physics = plan.recipe.physics
        if last is None or last.time_code < plan.frame_count or physics.leak or not physics.traits.winds:
            return {}
        tubes = {bubble.name for strip in plan.strips.values() if strip.has_tail for bubble in strip.bubbles}
        found = shares_of_planned_gas(plan, self._meshes, last).items()
        return {name: share for name, share in found if name in tubes and abs(share - 1.0) > GAS_OFF}

    @property
    def tails_left(self) -> dict[str, float]:
        """Flat rubber left at the tip of every tube in the last frame, m."""
        if self._last is None:
            return {}
        return dict(zip(self._tails.names, self._tails.left(self._last), strict=True))


def _fullest(plan: Plan) -> frozenset[int]:
    """Return the time codes at which air begins to be let out of a balloon."""
    letting = (move for move in plan.choreography.moves if isinstance(move, LetDown))
    return frozenset(1 + math.floor(move.start * plan.recipe.fps) for move in letting)
