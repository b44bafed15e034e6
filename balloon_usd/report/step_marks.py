"""When the steps of a recipe begin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.plan import Plan


@dataclass(frozen=True)
class StepMark:
    """The beginning of a step, of what comes before or after all steps, or of what happens by itself."""

    time_code: int
    """First frame that shows it, counted from 1."""
    step: int | None
    """Index of the step in the recipe; None for blowing up and holding, and for what comes undone."""
    text: str
    """What is done, for people."""


def step_marks(plan: Plan) -> tuple[StepMark, ...]:
    """Return when each step of a plan begins, in time; steps that take no time have none."""
    steps = plan.recipe.steps
    marks: list[StepMark] = []
    begun: tuple[int, str] | None = None
    for move in plan.choreography.moves:
        # Hands loosen their grip and then hold after the last step: two marks.
        begins = move.step, move.text if move.step >= len(steps) else ""
        if move.seconds <= 0.0 or begins == begun:
            continue
        begun = begins
        # Before the first step the hands blow up, after the last one they hold: only the move says so.
        inside = 0 <= move.step < len(steps)
        text = steps[move.step].label if inside else move.text
        code = 1 + round(move.start * plan.recipe.fps)
        marks.append(StepMark(code, move.step if inside else None, text))
    return tuple(marks)
