"""Choreography: the steps of a recipe as a timeline of a few hand moves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.operations.modifiers import Timed
from balloon_usd.operations.moves import Choreography, Inflate, LetGo, Move
from balloon_usd.operations.score import SETTLE_SECONDS, Score
from balloon_usd.plan.laid_out import LaidOut

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.language.problem import Problem
    from balloon_usd.plan.rings import RingTable
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

INFLATE_SPEED = 0.38
"""Inflated length blown up per second, m/s: a maker with a hand pump."""
SPREAD_SECONDS = 1.5
"""Time in which the air particles of a balloon that starts blown up spread, s."""

FEWEST_FRAMES = 6
"""Frames in which a balloon can be blown up: the pump's flow changes from frame to frame."""


def choreograph(recipe: Recipe, strips: Mapping[str, Strip], table: RingTable) -> Choreography:
    """Return the timeline of hand moves that make a recipe.

    Raises:
        RecipeError: a lock asks for the tip of a balloon, or a finger presses beyond a bubble, with its place
            in the file.
    """
    score = Score(LaidOut(strips, table), recipe.problem, recipe.physics.traits.starts_blown_up)
    if score.blown_up:
        score.add(Move(0.0, SPREAD_SECONDS, -1, "air spreads"))
    else:
        _inflate(score, strips)
    for index, step in enumerate(recipe.steps):
        begin, first = score.now, len(score.moves)
        step.perform(score, index)
        if isinstance(step, Timed) and step.seconds is not None and not step.keeps_time:
            score.retime(first, begin, step.seconds)
    score.add(LetGo(score.now, 0.0, len(recipe.steps), "let go", for_good=True))
    score.add(Move(score.now, recipe.physics.hold, len(recipe.steps), "hold"))
    return Choreography(tuple(score.moves), score.now)


def _inflate(score: Score, strips: Mapping[str, Strip]) -> None:
    longest = 0.0
    for name, strip in strips.items():
        seconds = max(1.0, (strip.bubbles[-1].end - strip.bubbles[0].start) / INFLATE_SPEED)
        seconds = seconds if strip.shape is None else strip.shape.seconds
        score.moves.append(Inflate(0.0, seconds, -1, f"inflate: {name}", balloon=name))
        longest = max(longest, seconds)
    score.now = longest
    score.add(Move(score.now, SETTLE_SECONDS, -1, "inflated"))
    score.add(LetGo(score.now, 0.0, -1, "let go"))


def pace_problems(recipe: Recipe, choreography: Choreography) -> list[Problem]:
    """Return whether balloons are blown up in too few frames."""
    seconds = min((m.seconds for m in choreography.moves if isinstance(m, Inflate)), default=math.inf)
    if seconds * recipe.fps >= FEWEST_FRAMES:
        return []
    frames = math.floor(seconds * recipe.fps)
    text = (
        f"{recipe.fps:g} frames/s leave {frames} for the {seconds:.1f} s in which a balloon is blown up, "
        f"expected at least {math.ceil(FEWEST_FRAMES / seconds)} frames/s"
    )
    return [recipe.problem(("fps",), text)]
