"""Choreography: the steps of a recipe as a timeline of a few hand moves."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.operations.modifiers import Timed
from balloon_usd.operations.moves import Choreography, Inflate, LetGo, Move
from balloon_usd.operations.score import SETTLE_SECONDS, Score

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.language.joint import Joint
    from balloon_usd.language.problem import Problem
    from balloon_usd.plan.rings import PlannedRing, RingTable
    from balloon_usd.plan.strip import PlannedBubble, Strip
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
    score = Score(_LaidOut(strips, table), recipe.problem, recipe.physics.traits.starts_blown_up)
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


@dataclass(frozen=True)
class _Placed:
    """A bubble on its strip."""

    strip: Strip
    planned: PlannedBubble

    @property
    def balloon(self) -> str:
        return self.strip.balloon

    @property
    def length(self) -> float:
        return self.planned.length

    @property
    def width(self) -> float:
        return 2.0 * self.strip.inflated_radius

    @property
    def size(self) -> str:
        return self.strip.size.name

    def rest_place(self, at: float) -> float:
        return self.strip.rest_place(self.planned, at)


class _LaidOut:
    """Rings and bubbles of laid strips, as operations ask for them."""

    def __init__(self, strips: Mapping[str, Strip], table: RingTable) -> None:
        self._table = table
        self._bubbles = {b.name: _Placed(strip, b) for strip in strips.values() for b in strip.bubbles}

    def ring(self, index: int) -> PlannedRing:
        return self._table.rings[index]

    def bubble(self, name: str) -> _Placed:
        return self._bubbles[name]

    def joint(self, end: Joint) -> int | None:
        return self._table.joint(end)

    def ends(self, bubble: str) -> tuple[int, int | None]:
        return self._table.ends(bubble)

    def guides(self, bubble: str) -> tuple[int, ...]:
        return self._table.guides(bubble)
