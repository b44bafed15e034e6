"""What cannot fit where it is sent: refused before anything is simulated."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations.closing import too_round
from balloon_usd.operations.workpiece import Joined
from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.room import room_problems

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.problem import Problem
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe


def fit_problems(recipe: Recipe, strips: Mapping[str, Strip], layout: Layout) -> Iterator[Problem]:
    """Yield what no hands can do without leading a wall through a wall, at its place in the file."""
    for index, step in enumerate(recipe.steps):
        for keys, text in step.refusals(layout):
            yield recipe.problem(("steps", index, *keys), text)
    yield from _closed_by_locks(recipe, layout)
    yield from room_problems(recipe, strips)


def _closed_by_locks(recipe: Recipe, layout: Layout) -> Iterator[Problem]:
    """Yield steps that bring together the two ends of a bubble that was not made to be closed."""
    own = {name for step in recipe.steps for name in step.closed}
    told = {name: too_round(layout.bubble(name), "lock") for name in _closed(recipe.piece) - own}
    wrong = {name for name, text in told.items() if text is not None}
    for step in sorted({event.step for event in recipe.piece.history if isinstance(event, Joined)}):
        if not wrong:
            return
        for name in sorted(_closed(recipe.piece.after(step)) & wrong):
            wrong.remove(name)
            yield recipe.problem(("steps", step, recipe.steps[step].word), f"closes {name}: {told[name]}")


def _closed(piece: Workpiece) -> set[str]:
    """Return the bubbles whose two ends are one joint."""
    return {edge.bubble for edge in sculpture_graph(piece).edges if edge.start == edge.end}
