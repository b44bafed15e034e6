"""What holds when the hands let go for good, and what comes undone.

A lock holds by the friction of its wound necks, which grows with every turn (capstan); of too few turns it
slips. A joint that no lock and no ring holds untwists. Until the last step is done makers hold what they have
made, also while they wait, so nothing comes undone before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.operations.modifiers import Turned

if TYPE_CHECKING:
    from balloon_usd.language.joint import Joint
    from balloon_usd.recipe import Recipe

HOLDING_TURNS = 2.0
"""Turns below which a twist unwinds: makers advise 2 to 4, three as a rule."""


@dataclass(frozen=True)
class LooseJoint:
    """A joint that untwists once it is let go."""

    end: Joint
    """The joint as the end of the bubble before it."""
    beyond: frozenset[str]
    """Bubbles that turn with what lies beyond it, all those that hang together there."""
    before: frozenset[str]
    """Bubbles that turn with what lies before it."""


def loose_joints(recipe: Recipe) -> tuple[LooseJoint, ...]:
    """Return the joints that untwist when the hands let go: neither friction nor a closed ring holds them."""
    slipping = {
        index
        for index, step in enumerate(recipe.steps)
        if isinstance(step, Turned) and step.turns < HOLDING_TURNS
    }
    piece = recipe.piece.after(len(recipe.steps), without=slipping)
    return tuple(
        LooseJoint(before, piece.hangs_on(before), piece.hangs_on(after))
        for before, after in piece.free_joints(piece.bridges())
    )
