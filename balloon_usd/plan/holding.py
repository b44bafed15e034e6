"""What holds when the hands let go for good, and what comes undone.

A lock holds by the friction of its wound necks, which grows with every turn (capstan): of too few turns, or
of rubber that is too slippery, it slips. A joint that no lock and no ring holds untwists. Until the last step
is done makers hold what they have made, also while they wait, so nothing comes undone before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.wound_neck import holding_friction
from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.workpiece import Joined

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.language.joint import Joint
    from balloon_usd.operations.operation import Operation
    from balloon_usd.recipe import Recipe

HOLD_SECONDS = 2.0
"""Time for which a finished figure is shown that keeps its pose, s."""
UNWINDING_SECONDS, MORE_UNWINDING = 1.5, 0.3
"""Time more in which a twist that nothing holds unwinds, and what each of several adds, s: 87 of 88
simulations of one to eleven then ended at rest, 82 of them for two seconds.
"""
PRESSING = 3.75
"""Force with which the bubbles about a joint press on each other, N: 7 kPa on two patches of 2.7 cm2."""


@dataclass(frozen=True)
class LooseJoint:
    """A joint that untwists once it is let go."""

    end: Joint
    """The joint as the end of the bubble before it."""
    beyond: frozenset[str]
    """Bubbles that turn with what lies beyond it, all those that hang together there."""
    before: frozenset[str]
    """Bubbles that turn with what lies before it."""


def slipping_steps(recipe: Recipe) -> frozenset[int]:
    """Return the indices of steps of which nothing holds what they joined when the hands let go."""
    friction = recipe.physics.friction
    return frozenset(
        index for index, step in enumerate(recipe.steps) if not step.holds or too_slippery(step, friction)
    )


def too_slippery(step: Operation, friction: float) -> bool:
    """Return whether a step winds a neck that does not hold for want of friction."""
    return isinstance(step, Turned) and friction < holding_friction(step.turns)


def pose_force(friction: float) -> float:
    """Return the force up to which the friction of a joint keeps two of its bubbles where they lie, N."""
    return friction * PRESSING


def friction_margin(recipe: Recipe, ends: Iterable[Joint], step: int | None = None) -> float | None:
    """Return how many times the friction that it needs a joint has, given all ends of bubbles in it.

    Of several necks that are wound there it is that of the weakest; None where none is wound about others,
    and 0 where it has too few turns to hold. `step`: index of the last step that is done; None for all.
    """
    if not recipe.physics.traits.winds:
        return None
    here, last = set(ends), len(recipe.steps) if step is None else step
    joined = (event for event in recipe.piece.history if isinstance(event, Joined) and event.step <= last)
    steps = (recipe.steps[event.step] for event in joined if not here.isdisjoint(event.ends))
    margins = [
        recipe.physics.friction / holding_friction(step.turns) if step.holds else 0.0
        for step in steps
        if isinstance(step, Turned)
    ]
    return min(margins, default=None)


def loose_joints(recipe: Recipe, step: int) -> tuple[LooseJoint, ...]:
    """Return the joints that untwist if the hands let go after a step of this index: neither friction nor a
    closed ring holds them.
    """
    piece = recipe.piece.after(step, without=slipping_steps(recipe))
    return tuple(
        LooseJoint(before, piece.hangs_on(before), piece.hangs_on(after))
        for before, after in piece.free_joints()
    )


def hold_seconds(recipe: Recipe) -> float:
    """Return how long a finished figure is shown after the hands have let go, s."""
    if recipe.physics.hold is not None:
        return recipe.physics.hold
    loose = len(loose_joints(recipe, len(recipe.steps))) if recipe.physics.traits.winds else 0
    return HOLD_SECONDS + (UNWINDING_SECONDS + MORE_UNWINDING * loose if loose else 0.0)
