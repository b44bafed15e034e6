"""The strip: one balloon as a row of bubbles, inflated and flat."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.lengths import at_least, at_most, cm
from balloon_usd.plan.open_tube import OpenTube, inflated_tube, softened, tail_range
from balloon_usd.recipe.problem import RecipeError, quoted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.recipe import Recipe
    from balloon_usd.recipe.balloons import Balloon
    from balloon_usd.recipe.problem import Path, Problem

BubbleKind = Literal["bubble", "loop", "fold", "ear", "rest"]

FULL_TOLERANCE = 0.02
"""An inflated length beyond the full one by this share means full: nominal lengths are rounded."""


@dataclass(frozen=True)
class PlannedBubble:
    """One bubble of a strip. Positions are distances from the knot."""

    name: str
    balloon: str
    kind: BubbleKind
    length: float
    """Inflated length, m."""
    start: float
    """Start along the inflated strip, m."""
    end: float
    """End along the inflated strip, m."""
    rest_start: float
    """Start along the flat tube, m."""
    rest_end: float
    """End along the flat tube, m; of the last bubble the tip, so its flat tail is included."""
    volume: float
    """Gas, m3, at the pressure at which it is twisted off."""
    step: int
    """Index of the step that makes it; of an unnamed rest, the number of steps."""

    @property
    def rest_length(self) -> float:
        """Unstressed length of its rubber, m."""
        return self.rest_end - self.rest_start


@dataclass(frozen=True)
class Strip:
    """One balloon of a plan."""

    balloon: str
    size: BalloonSize
    """Size with the recipe's own dimensions."""
    rubber: Rubber
    """Law of the rubber, softened or not as the recipe says."""
    tail: float
    """Flat rubber left empty when the balloon is blown up, m."""
    bubbles: tuple[PlannedBubble, ...]
    """From the knot to the tip; the last one owns all remaining rubber."""

    def bubble_at(self, along: float) -> PlannedBubble:
        """Return the bubble that owns the rubber at an unstressed distance from the knot (m)."""
        return next((bubble for bubble in self.bubbles if along <= bubble.rest_end), self.bubbles[-1])


def lay_strips(recipe: Recipe) -> dict[str, Strip]:
    """Return the strip of every balloon of a recipe, by name.

    A balloon without a `rest` step ends in a bubble named after it: `main_rest`.

    Raises:
        RecipeError: a tail or an inflated length does not fit a balloon, bubbles do not fit, or the rubber
            has no bulged phase.
    """
    rubber = _rubber(recipe)
    strips: dict[str, Strip] = {}
    problems: list[Problem] = []
    for name in recipe.balloons:
        try:
            strips[name] = _strip(recipe, name, rubber)
        except RecipeError as error:
            problems.extend(error.problems)
    if problems:
        raise RecipeError(problems)
    return strips


def _rubber(recipe: Recipe) -> Rubber:
    rubber = rubber_named(recipe.physics.rubber)
    try:
        maxwell_state(rubber)
    except ValueError as error:
        text = f"{error}, so no balloon can be twisted of it, expected one of ogden, ogden-treloar, gent"
        raise RecipeError([recipe.problem(("physics", "rubber"), text)]) from None
    return rubber if recipe.physics.softening else rubber.without_softening()


def _strip(recipe: Recipe, name: str, rubber: Rubber) -> Strip:
    balloon = recipe.balloons[name]
    size = size_named(balloon.size).with_overrides(balloon.radius, balloon.length, balloon.thickness)
    tail = _tail(recipe, name, size, rubber)
    tube = inflated_tube(size, rubber, tail)
    bubbles: list[PlannedBubble] = []
    along, rest_along = 0.0, 0.0
    for index, kind, bubble, length in _made(recipe, name):
        shape, left = tube.pinched(length)
        if not left.blown_up:
            path: Path = ("steps", index, recipe.steps[index].kind, bubble)
            raise RecipeError([recipe.problem(path, _misfit(recipe, name, bubble, length, tube))])
        rest_end = rest_along + shape.rest_length
        bubbles.append(
            PlannedBubble(
                bubble, name, kind, length, along, along + length, rest_along, rest_end, shape.volume, index
            )
        )
        tube, along, rest_along = left, along + length, rest_end
    bubbles.append(_rest(recipe, name, tube, along, rest_along))
    return Strip(name, size, rubber, tail, tuple(bubbles))


def _tail(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> float:
    balloon: Balloon = recipe.balloons[name]
    if balloon.inflated is not None:
        full = size.length * maxwell_state(rubber).bulged.b
        if balloon.inflated > full * (1.0 + FULL_TOLERANCE):
            text = f"{cm(balloon.inflated)} is more than a full {size.name}, expected at most {at_most(full)}"
            raise RecipeError([recipe.problem(("balloons", name, "inflated"), text)])
        return max(size.length * (1.0 - balloon.inflated / full), 0.0)
    tail = balloon.tail or 0.0
    if tail >= size.length:
        text = f"a tail of {cm(tail)} leaves nothing of a {size.name}, expected less than {cm(size.length)}"
        raise RecipeError([recipe.problem(("balloons", name, "tail"), text)])
    return tail


def _made(recipe: Recipe, name: str) -> Iterator[tuple[int, BubbleKind, str, float]]:
    kinds: dict[str, BubbleKind] = {"bubbles": "bubble", "loop": "loop", "fold": "fold", "ear": "ear"}
    for index, step in enumerate(recipe.steps):
        if step.kind in kinds and balloon_of(recipe, step.balloon) == name:
            for bubble, length in step.lengths.items():
                yield index, kinds[step.kind], bubble, length


def _rest(recipe: Recipe, name: str, tube: OpenTube, along: float, rest_along: float) -> PlannedBubble:
    bubble, index = unnamed_rest(recipe, name), len(recipe.steps)
    for at, step in enumerate(recipe.steps):
        if step.rest is not None and balloon_of(recipe, step.balloon) == name:
            bubble, index = step.rest, at
    length = tube.inflated_length
    return PlannedBubble(
        name=bubble,
        balloon=name,
        kind="rest",
        length=length,
        start=along,
        end=along + length,
        rest_start=rest_along,
        rest_end=tube.size.length,
        volume=tube.volume,
        step=index,
    )


def balloon_of(recipe: Recipe, named: str | None) -> str:
    """Return the balloon that a step works on: the one it names, else the only one."""
    return named if named is not None else next(iter(recipe.balloons))


def unnamed_rest(recipe: Recipe, balloon: str) -> str:
    """Return the name of a balloon's last bubble where no `rest` step gives one: `main_rest`, made unique."""
    taken = {bubble for step in recipe.steps for bubble in (*step.lengths, step.rest)}
    name = f"{balloon}_rest"
    while name in taken:
        name += "_"
    return name


def _misfit(recipe: Recipe, name: str, bubble: str, length: float, tube: OpenTube) -> str:
    text = f"{quoted(bubble)} of {cm(length)} does not fit: {cm(tube.inflated_length)} of {name} is left"
    lengths = [made_length for _, _, _, made_length in _made(recipe, name)]
    room = tail_range(tube.size, softened(tube.rubber), lengths)
    if room.most >= 0.0:
        return f"{text}, expected a tail of at most {at_most(room.most)}"
    excess = -room.most * maxwell_state(tube.rubber).bulged.b
    return f"{text}, expected bubbles shorter by {at_least(excess)} in all, or a longer balloon"
