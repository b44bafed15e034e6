"""Laying strips: from the balloons and lengths of a recipe to rows of bubbles."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.balloon.wound_neck import drawn_rubber
from balloon_usd.language.joint import Joint
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError, quoted
from balloon_usd.operations.curving import Curves
from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.parting import torn_bubbles
from balloon_usd.operations.thread import Thread
from balloon_usd.operations.tie import LEAST_STRING, Tie
from balloon_usd.plan.capsule import capsule_bubbles
from balloon_usd.plan.filling import fuller
from balloon_usd.plan.laying_rounds import round_strip
from balloon_usd.plan.laying_shapes import overlap_problems, shaped_strip
from balloon_usd.plan.nesting import with_guests
from balloon_usd.plan.nesting_fit import nesting_problems
from balloon_usd.plan.open_tube import (
    OpenTube,
    Twisted,
    end_rest_length,
    fitting_length,
    fitting_share,
    fitting_tail,
    inflated_tube,
    roomy_share,
    shortened,
    softened,
)
from balloon_usd.plan.strip import ALL, Made, PlannedBubble, Strip

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.balloon.bubble_shape import BubbleShape
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.recipe import Recipe
    from balloon_usd.recipe.balloons import Balloon

FULL_TOLERANCE = 0.02
"""An inflated length beyond the full one by this share means full: nominal lengths are rounded."""

LEAST_BUBBLE = 0.5
"""Length of the shortest bubble that is planned, in R0: less rubber than a neck is wide has no mesh."""
LEAST_SHARE = 0.25
"""Share of their lengths to which bubbles are advised to be shortened."""


def lay_strips(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> dict[str, Strip]:
    """Return the strip of every balloon of a recipe, by name; `tubes`: sizes of those that are tubes.

    A balloon without a `rest` step ends in a bubble named after it: `main_rest`.

    Raises:
        RecipeError: a tail, an inflated length or a capsule does not fit a balloon, bubbles do not fit, a
            mesh makes no balloon, or the rubber has no bulged phase.
    """
    rubber = _rubber(recipe)
    strips: dict[str, Strip] = {}
    problems: list[Problem] = []
    for name, balloon in recipe.balloons.items():
        try:
            if balloon.mesh:
                strips[name] = shaped_strip(recipe, name, rubber)
            else:
                strips[name] = _laid(recipe, name, tubes[name], rubber)
        except RecipeError as error:
            problems.extend(error.problems)
    strips = {name: replace(strip, inside=recipe.piece.inside.get(name)) for name, strip in strips.items()}
    strips = with_guests(strips)
    problems += overlap_problems(recipe, strips)
    problems += nesting_problems(recipe, strips)
    if problems:
        raise RecipeError(problems)
    return strips


def _laid(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> Strip:
    if size.neck is not None:
        return round_strip(recipe, name, size, rubber, _made(recipe, name))
    lay = _tube if recipe.balloons[name].capsule is None else _capsule
    return lay(recipe, name, size, rubber)


def _rubber(recipe: Recipe) -> Rubber:
    rubber = rubber_named(recipe.physics.rubber)
    try:
        maxwell_state(rubber)
    except ValueError as error:
        text = f"{error}, so no balloon can be twisted of it, expected one of ogden, ogden-treloar, gent"
        raise RecipeError([recipe.problem(("physics", "rubber"), text)]) from None
    return rubber if recipe.physics.softening else rubber.without_softening()


def _capsule(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> Strip:
    balloon = recipe.balloons[name]
    length = balloon.capsule or 0.0
    strip = Strip(name, size, rubber, 0.0, (), capsule=True)
    path: Path = ("balloons", name, "capsule")
    if length > strip.full_length * (1.0 + FULL_TOLERANCE):
        raise RecipeError([recipe.problem(path, _beyond_full(length, strip.size, strip.full_length))])
    wide = 2.0 * strip.inflated_radius
    if length < wide:
        text = f"{cm(length)} is shorter than a {strip.size.name} is wide, expected at least {at_least(wide)}"
        raise RecipeError([recipe.problem(path, text)])
    bubbles = capsule_bubbles(recipe, strip, length, _made(recipe, name), _rest(recipe, name))
    return replace(strip, bubbles=bubbles)


def _tube(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> Strip:
    tail = _tail(recipe, name, size, rubber)
    tube = inflated_tube(size, rubber, tail)
    bubbles: list[PlannedBubble] = []
    along, rest_along, drawn_before = 0.0, 0.0, 0.0
    bent = {each for step in recipe.steps if isinstance(step, Curves) for each in step.names}
    row = recipe.piece.row(name)
    threaded = [step.bubble for step in recipe.steps if isinstance(step, Thread) and step.bubble in row]
    bent.update(*(row[row.index(each) :] for each in threaded))
    places = {each: count for s in recipe.steps for each, count in s.held_at(recipe.piece).items()}
    torn = torn_bubbles(recipe.piece)
    for made in _wound(recipe, name, size, rubber):
        shape, left = (_closed if made.length == ALL else _pinched)(recipe, tube, made)
        index, kind, bubble, length, gas, drawn, slack = made._replace(length=shape.length)
        rest_end = rest_along + 0.5 * (drawn_before + drawn) + shape.rest_length
        place = along, along + length, rest_along, rest_end
        pressure = shape.pressure * gauge_pressure(size, maxwell_state(tube.rubber).p_star)
        planned = PlannedBubble(bubble, name, kind, length, *place, shape.volume, index, pressure)
        drawn_in = drawn_before, drawn
        planned = replace(planned, bent=bubble in bent, places=places.get(bubble, 0), tears=bubble in torn)
        front = size.length - tube.tail
        bubbles.append(
            replace(planned, gas=gas, drawn=drawn_in, slack=slack, front=front, leads=bubble in threaded)
        )
        tube, along, rest_along, drawn_before = left, along + length, rest_end, drawn
    rest = _rest_of_tube(recipe, name, tube, along, rest_along)
    rest = replace(rest, bent=rest.name in bent, places=places.get(rest.name, 0))
    bubbles.append(replace(rest, drawn=(drawn_before, 0.0), front=size.length - tube.tail))
    return Strip(name, size, rubber, tail, tuple(bubbles))


def _tail(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> float:
    balloon: Balloon = recipe.balloons[name]
    if balloon.inflated is not None:
        full = size.length * maxwell_state(rubber).bulged.b
        if balloon.inflated > full * (1.0 + FULL_TOLERANCE):
            text = _beyond_full(balloon.inflated, size, full)
            raise RecipeError([recipe.problem(("balloons", name, "inflated"), text)])
        return max(size.length * (1.0 - balloon.inflated / full), 0.0)
    key, tail = "tail", balloon.tail or 0.0
    if balloon.filled is not None:
        key, tail = "filled", size.length * (1.0 - 0.01 * balloon.filled)
    most = size.length - end_rest_length(size, softened(rubber))
    if tail >= most:
        fitting = fitting_tail(size, rubber, _wanted(recipe, name, size, rubber))
        most = most if fitting is None else min(fitting, most)
        expected = f"at most {at_most(most)}" if key == "tail" else fuller(balloon, size, rubber, most)
        text = f"a tail of {cm(tail)} leaves nothing of a {size.name}, expected {expected}"
        raise RecipeError([recipe.problem(("balloons", name, key), text)])
    return tail


def _beyond_full(length: float, size: BalloonSize, full: float) -> str:
    return f"{cm(length)} is more than a full {size.name}, expected at most {at_most(full)}"


def _made(recipe: Recipe, name: str) -> list[Made]:
    """What the steps make of one balloon, but its rest; what a later step closes is soft from the first."""
    closed = {name: step for step in recipe.steps for name in step.closed if name not in step.lengths}
    found = []
    for bubble in recipe.piece.row(name)[:-1]:
        index = recipe.piece.bubbles[bubble].step
        step = recipe.steps[index]
        assert step.bubble_kind is not None, "a step that makes bubbles says of which kind"
        if step.bubble_kind == "rest":
            # Only one whose end is tied has something behind it.
            found.append(Made(index, "bubble", bubble, ALL))
            continue
        maker = closed.get(bubble, step)
        assert maker.bubble_kind is not None, "a step that closes bubbles says what they become"
        gas = step.gas_left if maker is step else step.gas_left * maker.gas
        found.append(Made(index, maker.bubble_kind, bubble, step.lengths[bubble], gas, slack=maker.slack))
    return found


def _wound(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> list[Made]:
    """What the steps make of a tube, with the rubber that their turns draw into the necks."""
    found = []
    for made in _made(recipe, name):
        step = recipe.steps[made.step]
        turns = step.turns if isinstance(step, Turned) and recipe.physics.traits.winds else 0.0
        drawn = drawn_rubber(size, softened(rubber), turns)
        found.append(made._replace(drawn=drawn))
    return found


def _wanted(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> list[Twisted]:
    """What the steps make of a tube, but for what takes all the gas that is left."""
    return [made.twisted for made in _wound(recipe, name, size, rubber) if made.length != ALL]


def _pinched(recipe: Recipe, tube: OpenTube, made: Made) -> tuple[BubbleShape, OpenTube]:
    """A bubble that a step twists off, and what is left of the tube."""
    path: Path = ("steps", made.step, *recipe.steps[made.step].path_of(made.bubble))
    least = LEAST_BUBBLE * tube.size.radius
    if made.length < least:
        text = f"is shorter than a neck of a {tube.size.name} is wide, expected {at_least(least)} or more"
        raise RecipeError([recipe.problem(path, text)])
    shape, left = tube.pinched(made.twisted)
    if not left.blown_up:
        raise RecipeError([recipe.problem(path, _misfit(recipe, made, tube))])
    return shape, left


def _closed(recipe: Recipe, tube: OpenTube, made: Made) -> tuple[BubbleShape, OpenTube]:
    """What is left of a tube as a bubble that is closed at its front, and the flat tip that ties its end."""
    least, (shape, left) = LEAST_STRING * tube.size.radius, tube.closed()
    flat = max(left.rest_length, 0.0) if tube.tail > 0.0 else 0.0
    if flat < least:
        end, balloon = Joint(made.bubble, "end"), recipe.piece.bubbles[made.bubble].balloon
        step = next(k for k, s in enumerate(recipe.steps) if isinstance(s, Tie) and s.tie.end == end)
        text = f"only {cm(flat)} of flat tail are left behind {made.bubble}"
        text += f", expected {at_least(least)} to tie: a longer tail of {balloon}"
        if tube.tail > 0.0:
            # As much longer as what is left: all before it takes the same gas.
            text += f", by {at_least(least - left.rest_length)}"
        raise RecipeError([recipe.problem(("steps", step, Tie.word, "end"), text)])
    return shape, left


def _rest(recipe: Recipe, name: str) -> tuple[str, int]:
    """Name of what is left of a balloon, and the step that names it, or the number of steps."""
    bubble = recipe.piece.row(name)[-1]
    return bubble, recipe.piece.bubbles[bubble].step


def _rest_of_tube(
    recipe: Recipe, name: str, tube: OpenTube, along: float, rest_along: float
) -> PlannedBubble:
    bubble, index = _rest(recipe, name)
    tied = any(recipe.piece.bubbles[each].last for each in recipe.piece.row(name)[:-1])
    length = 0.0 if tied else tube.inflated_length
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
        pressure=gauge_pressure(tube.size, tube.state.p_star),
    )


def _misfit(recipe: Recipe, made: Made, tube: OpenTube) -> str:
    name = recipe.piece.bubbles[made.bubble].balloon
    left = f"{cm(tube.inflated_length)} of {name} is left"
    text = f"{quoted(made.bubble)} of {cm(made.length)} does not fit: {left}"
    wanted = _wanted(recipe, name, tube.size, tube.rubber)
    fitting = fitting_tail(tube.size, tube.rubber, wanted)
    balloon = recipe.balloons[name]
    if fitting is not None:
        return f"{text}, expected {fuller(balloon, tube.size, tube.rubber, fitting)}"
    tail = _tail(recipe, name, tube.size, tube.rubber)
    return f"{text}, expected {_shorter(balloon, tube.size, tube.rubber, tail, wanted)}"


def _shorter(
    balloon: Balloon, size: BalloonSize, rubber: Rubber, tail: float, wanted: Sequence[Twisted]
) -> str:
    """What to do about bubbles that fit with no tail."""
    share, filling = fitting_share(size, rubber, tail, wanted), ""
    if share < LEAST_SHARE:
        share = roomy_share(size, rubber, wanted)
        fitting = fitting_tail(size, rubber, shortened(wanted, share)[1])
        if share < LEAST_SHARE or fitting is None:
            return "fewer bubbles"
        filling = f", and {fuller(balloon, size, rubber, fitting)}"
    elif balloon.inflated is None:
        longer = fitting_length(size, rubber, tail, wanted)
        filling = f", or a balloon with length: at least {at_least(longer)}"
    return f"bubbles shorter by {at_least(shortened(wanted, share)[0])} in all{filling}"
