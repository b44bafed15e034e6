"""Choreography: the steps of a recipe as a timeline of a few hand moves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.operations.inflate import Inflate as InflateStep
from balloon_usd.operations.modifiers import Pointed, Timed
from balloon_usd.operations.moves import (
    Choreography,
    Hold,
    Inflate,
    LetGo,
    Loosen,
    Move,
    Pinch,
    Weld,
)
from balloon_usd.operations.score import Score
from balloon_usd.operations.tempo import PACES
from balloon_usd.plan.holding import hold_seconds
from balloon_usd.plan.laid_out import LaidOut
from balloon_usd.plan.nets import nets_of
from balloon_usd.plan.posing import pose, sink_contents
from balloon_usd.plan.setting_nets import set_nets
from balloon_usd.plan.straightening import straighten

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.plan.rings import RingTable
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

SPREAD_SECONDS = 1.5
"""Time in which the air particles of a balloon that starts blown up spread, s."""

LOOSEN_SECONDS = 3.0
"""Time in which hands let go of a finished figure, s: at once, and it would jump, and what was squeezed moves
on for two seconds after the grip has faded (let go of in 1.2 s, a tree of six bubbles crept by 24 mm then,
another by 9; now by 0.4 and 2.3).
"""
NET_LOOSEN_SECONDS = 5.0
"""The same of a figure with a closed net, s: it swings as a whole, and the slower the larger it is."""
FEWEST_FRAMES = 6
"""Frames in which a balloon can be blown up: the pump's flow changes from frame to frame."""
ROUNDING = 1e-9
"""Frames by which a product of times and frames may miss a whole number."""


def choreograph(recipe: Recipe, strips: Mapping[str, Strip], table: RingTable) -> Choreography:
    """Return the timeline of hand moves that make a recipe.

    Raises:
        RecipeError: a lock asks for the tip of a balloon, or a finger presses beyond a bubble, with its place
            in the file.
    """
    blown_up = recipe.physics.traits.starts_blown_up
    mirrored = _points_right(recipe)
    score = Score(
        LaidOut(strips, table), recipe.problem, recipe.piece, blown_up, PACES[recipe.tempo], mirrored
    )
    if score.blown_up:
        score.add(Move(0.0, SPREAD_SECONDS, -1, "air spreads"))
    elif balloons := _of_the_beginning(recipe):
        score.inflate(balloons, -1)
    for index, step in enumerate(recipe.steps):
        begin, first = score.now, len(score.moves)
        step.perform(score, index)
        if isinstance(step, Timed) and step.seconds is not None and not step.keeps_time:
            score.retime(first, begin, step.seconds)
    timed = {k for k, each in enumerate(recipe.steps) if getattr(each, "seconds", None) is not None}
    nets = nets_of(recipe.piece, strips, table)
    set_nets(score, nets, table, len(recipe.steps), timed)
    held = any(isinstance(move, (Pinch, Weld)) for move in score.moves)
    if held and not blown_up:
        while isinstance(score.moves[-1], LetGo):
            score.moves.pop()
    sink_contents(recipe, strips, score, mirrored=mirrored)
    if held and not blown_up:
        seconds = NET_LOOSEN_SECONDS if nets else LOOSEN_SECONDS
        score.add(Loosen(score.now, seconds, len(recipe.steps), "loosen the grip"))
    score.add(LetGo(score.now, 0.0, len(recipe.steps), "let go", for_good=True))
    score.add(Hold(score.now, hold_seconds(recipe), len(recipe.steps), "hold"))
    straighten(recipe, strips, score)
    pose(recipe, score, mirrored=mirrored)
    return Choreography(tuple(score.moves), score.now, mirrored)


def _points_right(recipe: Recipe) -> bool:
    """Tell whether the first step that leads anything aside points right: what points left is made as it is,
    so that both are mirror images to the last bit.
    """
    return next((step.point for step in recipe.steps if isinstance(step, Pointed)), None) == "right"


def _of_the_beginning(recipe: Recipe) -> list[str]:
    """Return the balloons that no step blows up."""
    later = {name for step in recipe.steps if isinstance(step, InflateStep) for name in step.inflate}
    return [name for name in recipe.balloons if name not in later]


def pace_problems(recipe: Recipe, choreography: Choreography) -> Iterator[Problem]:
    """Yield where balloons are blown up in too few frames."""
    shortest: dict[int, float] = {}
    for move in choreography.moves:
        if isinstance(move, Inflate):
            shortest[move.step] = min(move.seconds, shortest.get(move.step, math.inf))
    for step, seconds in shortest.items():
        frames = seconds * recipe.fps
        if frames > FEWEST_FRAMES - ROUNDING:
            continue
        path, expected = _pace_remedy(recipe, step, seconds)
        given = f"{recipe.fps:g} frames/s leave {math.floor(frames + ROUNDING)}"
        text = f"{given} for the {round(seconds, 2)} s in which a balloon is blown up, expected {expected}"
        yield recipe.problem(path, text)


def _pace_remedy(recipe: Recipe, step: int, seconds: float) -> tuple[Path, str]:
    """Return where a pace is to be changed, and how; `step`: of the inflating, -1 of the beginning."""
    quicker = f"at least {math.ceil(FEWEST_FRAMES / seconds - ROUNDING)} frames/s"
    if step < 0:
        return ("fps",), quicker
    slower = math.ceil(100.0 * FEWEST_FRAMES / recipe.fps - ROUNDING) / 100.0
    key = ("seconds",) if getattr(recipe.steps[step], "seconds", None) is not None else ()
    return ("steps", step, *key), f"seconds: {slower:g}, or {quicker}"
