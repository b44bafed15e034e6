"""The plan: what a recipe means, before any physics runs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from balloon_usd.plan.budget import budget_of
from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.holding import loose_joints, slipping_steps
from balloon_usd.plan.judgement import cautions_of
from balloon_usd.plan.laid_out import LaidOut

if TYPE_CHECKING:
    from balloon_usd.operations.caution import Caution
    from balloon_usd.operations.moves import Choreography
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan.budget import Budget
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.holding import LooseJoint
    from balloon_usd.plan.rings import RingTable
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

ROUNDING = 1e-6
"""Frames by which a sum of times may miss a whole number."""


@dataclass(frozen=True)
class Plan:
    """Everything that follows from a recipe without simulating it."""

    recipe: Recipe
    strips: dict[str, Strip]
    """By balloon, in the order of the recipe."""
    table: RingTable
    """Rings that hands hold and close."""
    choreography: Choreography
    """What the hands do, in time."""

    @cached_property
    def graph(self) -> SculptureGraph:
        """Joints and bubbles of the finished sculpture."""
        return sculpture_graph(self.recipe.piece)

    @cached_property
    def loose(self) -> tuple[LooseJoint, ...]:
        """Joints that untwist when the hands let go, in plan order."""
        return loose_joints(self.recipe, len(self.recipe.steps))

    @cached_property
    def slipping(self) -> frozenset[int]:
        """Indices of the steps of which nothing holds what they joined when the hands let go."""
        return slipping_steps(self.recipe)

    @cached_property
    def piece_let_go(self) -> Workpiece:
        """The workpiece when the hands have let go: without what nothing holds."""
        return self.recipe.piece.after(len(self.recipe.steps), without=self.slipping)

    @cached_property
    def budgets(self) -> dict[str, Budget]:
        """Tail and gas by balloon, in the order of the recipe; only tubes have a budget."""
        return {name: budget_of(strip) for name, strip in self.strips.items() if strip.has_tail}

    @cached_property
    def cautions(self) -> tuple[Caution, ...]:
        """What a maker would warn of."""
        return cautions_of(
            self.recipe, self.strips, LaidOut(self.strips, self.table), self.graph, self.budgets
        )

    @property
    def of_meshes(self) -> bool:
        """Whether its balloons come from mesh files, which are not twisted."""
        return any(strip.shape is not None for strip in self.strips.values())

    @property
    def mirrored(self) -> bool:
        """Whether frames show the mirror image of what hands make, left and right exchanged."""
        return self.choreography.mirrored != self.recipe.mirror

    @property
    def frame_count(self) -> int:
        """Number of frames of the animation; the first shows the balloons before anything is done."""
        return 1 + math.ceil(self.choreography.seconds * self.recipe.fps - ROUNDING)

    @property
    def rested_frame(self) -> int:
        """Last frame before hands take the figure up again: what they move then neither creeps nor slips."""
        # The time of a frame is (code - 1) / fps.
        return min(1 + int(self.choreography.taken_up * self.recipe.fps), self.frame_count)

    @property
    def bubbles(self) -> tuple[PlannedBubble, ...]:
        """All bubbles in plan order: balloon after balloon, each from the knot to the tip."""
        return tuple(bubble for strip in self.strips.values() for bubble in strip.bubbles)

    @cached_property
    def limp(self) -> frozenset[str]:
        """Bubbles that hold no gas in the end: popped ones, and flat tips that are tied to a joint."""
        tied = {strip.bubbles[-1].name for strip in self.strips.values() if strip.tip_is_tied}
        return self.recipe.piece.popped | tied
