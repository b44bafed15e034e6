"""What becomes of a finished figure: hands carry it to its pose, and where nothing holds it, it falls."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.operations.moves import LET_GO, OTHER_SIDE, TIPPED, Fall, Level, Move, SetDown, Sink
from balloon_usd.operations.parting import parts_of
from balloon_usd.plan.holding import hold_seconds
from balloon_usd.plan.nesting import room_to_sink
from balloon_usd.recipe.recipe import EARTH

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.operations.moves import Facing, Vector
    from balloon_usd.operations.score import Score
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

POSE_SECONDS = 2.0
"""Carrying the finished figure to where it stays, s."""
POSED_SECONDS = 1.0
"""How long it is shown there, s."""
LEVEL_SECONDS = 4.5
"""Bending legs until all feet stand on one plane, s."""
LEVELLED_SECONDS = 0.75
"""How long a figure comes to rest then, s."""
TURN_SECONDS = 4.0
"""The same if its front is turned: the ends of a figure a metre long stay below 1.5 m/s."""
POSING: dict[str, tuple[str, str]] = {
    "as made": ("turn", "turned"),
    "stand": ("set down", "stand"),
    "hang": ("hang up", "hang"),
    "hold": ("hold up", "held"),
    "drop": ("lift up", "held"),
    "throw": ("lift up", "held"),
}
"""What hands do to pose a figure, and what it does then."""
FALLING: dict[str, str] = {"as made": "fall", "stand": "stand", "drop": "fall", "throw": "fly"}
"""What a figure does under gravity, in the poses in which nothing holds it."""
LIFT_SPEED = 1.0
"""Mean speed at which hands lift a figure higher than they carry others, m/s."""
DROP_HEIGHT = 1.0
"""How far above the ground figures are let go, m, where a recipe does not say."""
THROW_SPEED = 3.0
"""How fast they are thrown, m/s, where it does not."""
SLOW_FALL = 0.6
"""Speed with which the lightest figures fall in the end, a 260 across the wind, m/s."""
LANDING_SECONDS = 5.0
"""From when the slowest figure lands until it is no longer shown, s: a dog tips over and lies after three."""
NUDGE: Vector = (0.01, 0.007, 0.0)
"""Spin with which hands let go above the ground, rad/s: no hand is so steady that a heart stays on its point.
"""
STILL: Vector = (0.0, 0.0, 0.0)
SINK_SECONDS = 1.0
"""What lies in other balloons comes to rest after it has sunk, s."""
SINKING_SPEED = 0.07
"""Mean speed at which it sinks, m/s."""


def sink_contents(recipe: Recipe, strips: Mapping[str, Strip], score: Score, *, mirrored: bool) -> None:
    """Let what lies in other balloons of a recipe sink, while hands still hold the figure."""
    if recipe.piece.inside and _weighs_inside(recipe):
        seconds = SINK_SECONDS + room_to_sink(strips) / SINKING_SPEED
        pose = _set_down(recipe, score.now, mirrored=mirrored)
        score.add(Sink(score.now, seconds, len(recipe.steps), "what lies inside sinks", pose=pose))


def _weighs_inside(recipe: Recipe) -> bool:
    """Whether what lies in other balloons sinks: also where hands or a thread hold the figure, but not where
    all of it floats as it was made.
    """
    given = recipe.physics.gravity
    return recipe.physics.traits.has_weight and (recipe.pose != "as made" if given is None else given > 0.0)


def pose(recipe: Recipe, score: Score, *, mirrored: bool) -> None:
    """Add what becomes of the finished figure of a recipe to the moves that make it."""
    last = len(recipe.steps)
    weighs = recipe.gravity > 0.0 and recipe.physics.traits.has_weight
    whole = len(parts_of(recipe.piece)) == 1
    if recipe.pose == "stand" and weighs and whole and recipe.piece.has_limbs:
        front, top = _sides(recipe, mirrored=mirrored)
        level = Level(score.now, LEVEL_SECONDS, last, "level its feet", front=front, top=top)
        score.retouch(level, LEVELLED_SECONDS)
    set_down = _set_down(recipe, score.now, mirrored=mirrored)
    if set_down is not None:
        score.add(set_down)
    if weighs and recipe.pose in FALLING:
        if (seconds := _fall_seconds(recipe)) > 0.0:
            score.add(_fall(recipe, score.now, seconds))
    elif set_down is not None:
        score.add(Move(score.now, POSED_SECONDS, last, POSING[recipe.pose][1]))


def _set_down(recipe: Recipe, start: float, *, mirrored: bool) -> SetDown | None:
    """Return how the finished figure is carried to its pose from a time on (s); None where it is not."""
    front, top = _sides(recipe, mirrored=mirrored)
    turned = front != "forward" or top is not None
    if not turned and recipe.pose == "as made":
        return None
    height = _height(recipe)
    return SetDown(
        start,
        max(TURN_SECONDS if turned else POSE_SECONDS, height / LIFT_SPEED),
        len(recipe.steps),
        POSING[recipe.pose][0],
        pose=recipe.pose,
        front=front,
        top=top,
        height=height,
        gravity=recipe.gravity,
    )


def _sides(recipe: Recipe, *, mirrored: bool) -> tuple[Facing, Facing | None]:
    """Return which sides of a figure, as hands make it, come to the front and to the top."""
    front, top = recipe.front, recipe.top
    if isinstance(top, str) and front == "forward":
        front = TIPPED.get(top, front)
    if mirrored:
        front, top = _mirrored(front), top and _mirrored(top)
    return front, top


def _mirrored(facing: Facing) -> Facing:
    return OTHER_SIDE.get(facing, facing) if isinstance(facing, str) else facing


def _fall(recipe: Recipe, start: float, seconds: float) -> Fall:
    """Return how it falls from a time on (s), for some seconds."""
    ahead = recipe.speed if recipe.speed is not None else THROW_SPEED
    return Fall(
        start,
        seconds,
        len(recipe.steps),
        FALLING[recipe.pose],
        gravity=recipe.gravity,
        velocity=(-ahead, 0.0, 0.0) if recipe.pose == "throw" else STILL,
        spin=NUDGE if _height(recipe) > 0.0 else STILL,
        ground=recipe.pose != "as made",
    )


def _height(recipe: Recipe) -> float:
    """Return how far above the ground hands let go of a figure, m; 0 where they do not."""
    if recipe.pose not in LET_GO:
        return 0.0
    return DROP_HEIGHT if recipe.height is None else recipe.height


def _fall_seconds(recipe: Recipe) -> float:
    """Return how long a finished figure is shown that falls, or stands by its weight, s."""
    if recipe.pose in LET_GO:
        # Speeds go with the root of gravity.
        return (_height(recipe) / SLOW_FALL + LANDING_SECONDS) * math.sqrt(EARTH / recipe.gravity)
    return hold_seconds(recipe) if recipe.pose == "as made" else POSED_SECONDS
