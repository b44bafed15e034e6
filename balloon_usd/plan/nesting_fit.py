"""Which balloons do not fit into the balloons that they are put into, and what would."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.operations.inflate import Inflate
from balloon_usd.operations.insert import Insert
from balloon_usd.plan.laying_rounds import round_height, widths_of
from balloon_usd.plan.nesting import NARROWER, blown_length, flat_length, flat_room, hosts_of, nozzle_length
from balloon_usd.plan.open_tube import MILLIMETRE, softened

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.problem import Problem
    from balloon_usd.plan.nesting import Host
    from balloon_usd.plan.shaped import Shaped
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

USUAL_SHARE = 0.8
"""Share of the room in a bubble that is advised for the blown-up part of what lies in it."""
MOST_GUESTS = 8
"""Most balloons that lie in one: hands bring no more to their places at a time."""
STEPS = 200
"""Widths of a round balloon of which the widest is found that fits into another."""
LEAST_TESTED = 500
"""Points of a balloon from a mesh that are tested at least, on its finer faces."""
MOST_TESTED = 4000
"""Points of a balloon from a mesh that are tested for lying in another."""


def nesting_problems(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Problem]:
    """Yield the balloons that do not fit into others."""
    hosts = hosts_of(strips)
    for index, step in enumerate(recipe.steps):
        if isinstance(step, Insert):
            for name in step.insert:
                text = _misfit(recipe, strips, hosts, name) if name in hosts else ""
                if text:
                    yield recipe.problem(("steps", index, step.word, name), text)


def _misfit(recipe: Recipe, strips: Mapping[str, Strip], hosts: Mapping[str, Host], name: str) -> str:
    """Say why a balloon does not fit where it is put; nothing where it does."""
    host, guest = hosts[name], strips[name]
    owner = strips[host.balloon]
    beside = [strips[each] for each, other in hosts.items() if other[:2] == host[:2] and each != name]
    if guest.shape is not None and owner.shape is not None:
        shapes = [guest.shape, *(each.shape for each in beside if each.shape is not None)]
        place = recipe.balloons[name].at or (0.0, 0.0, 0.0)
        return _misplaced(guest.shape, owner.shape, place) or _crowded(owner.balloon, owner.shape, shapes)
    guests = [each for each, other in hosts.items() if other.balloon == host.balloon]
    if name in guests[MOST_GUESTS:]:
        return f"is one of {len(guests)} balloons in {owner.balloon}, expected at most {MOST_GUESTS}"
    if beside:
        bubble = owner.bubbles[host.bubble].name
        return f"{bubble} holds {beside[0].balloon} as well, expected a bubble for each"
    if text := _too_large(guest, owner, host):
        return text
    if _blown_up_at(recipe, name) <= _blown_up_at(recipe, owner.balloon):
        text = f"is not blown up after {owner.balloon}, which would drag it along as it grows"
        return f"{text}, expected inflate: {owner.balloon} in a step before"
    return ""


def _blown_up_at(recipe: Recipe, balloon: str) -> int:
    """Return the step that blows a balloon up."""
    steps = enumerate(recipe.steps)
    return next(index for index, step in steps if isinstance(step, Inflate) and balloon in step.inflate)


def _too_large(guest: Strip, owner: Strip, host: Host) -> str:
    """Say why a tube or a round balloon has no room in a bubble of another; nothing where it has."""
    if guest.size.radius > NARROWER * owner.size.radius:
        text = f"is {cm(2.0 * guest.size.radius)} wide while it is flat, and {owner.balloon} "
        text += cm(2.0 * owner.size.radius)
        what = "one" if guest.is_round else "a tube"
        return f"{text}, expected {what} of at most {at_most(2.0 * NARROWER * owner.size.radius)}"
    bubble = owner.bubbles[host.bubble]
    if bubble.length == 0.0:
        return f"lies in {bubble.name}, which is flat for ever, expected a bubble with gas"
    if what := _full(owner, host.bubble):
        return f"lies in {bubble.name}, {what} no room in it, expected another bubble"
    if text := (_too_wide if guest.is_round else _too_long)(guest, owner, bubble):
        return text
    short = flat_room(owner, guest)[0] + nozzle_length(guest) - host.along
    if short > 0.0:
        text = f"has no room in {owner.balloon}, which is {cm(flat_length(owner))} long while it is flat"
        return f"{text}, expected it, or what lies behind it, shorter by {at_least(short)} while flat"
    return ""


def _full(owner: Strip, bubble: int) -> str:
    """Say what takes the room in a bubble of some number; nothing where there is room."""
    if owner.size.heart:
        return "a heart, whose lobes leave"
    if owner.is_round and len(owner.bubbles) > 1:
        return "part of a round balloon that is twisted, whose necks leave"
    return "a tulip, whose own wall leaves" if owner.inverted and bubble == 0 else ""


def _too_wide(guest: Strip, owner: Strip, bubble: PlannedBubble) -> str:
    """Say that a round balloon is too large for a bubble when blown up, and how wide it may be; nothing if it
    is not.
    """
    assert guest.blown is not None, "it is a round balloon"
    width, room = guest.blown.most.width, 2.0 * owner.inflated_radius
    if _has_room(guest, width, room, bubble):
        return ""
    long = at_least(round_height(guest.size, width) + nozzle_length(guest))
    text = f"is {cm(width)} wide when blown up and {long} long with its nozzle, too large for {bubble.name}"
    if guest.overblown is not None:
        farther = np.linspace(guest.blown.width + MILLIMETRE, width, STEPS)
        if fits := [each for each in farther.tolist() if _has_room(guest, each, room, bubble)]:
            return f"{text}, expected overblown: {at_most(fits[-1])}, or less"
        text = f"{text} where it is overblown"
    widths = np.linspace(*widths_of(guest.size), STEPS)
    if fits := [each for each in widths.tolist() if _has_room(guest, each, room, bubble)]:
        return f"{text}, expected inflated: {at_most(fits[-1])}, or less"
    return f"{text}, expected a wider {owner.balloon}"


def _has_room(guest: Strip, width: float, room: float, bubble: PlannedBubble) -> bool:
    """Say whether a round balloon of a width fits into a bubble of another of a width (`room`), m."""
    high = round_height(guest.size, width)
    return high + nozzle_length(guest) <= bubble.length and high <= _between_ends(bubble, width / room)


def _between_ends(bubble: PlannedBubble, wide: float) -> float:
    """Return how long what lies between the round ends of a bubble may be, m; `wide`: in its width."""
    return bubble.length * math.sqrt(1.0 - min(wide, 1.0) ** 2)


def _too_long(guest: Strip, owner: Strip, bubble: PlannedBubble) -> str:
    """Say why a tube is too long for a bubble when blown up; nothing if it is not."""
    nozzle, blown = nozzle_length(guest), blown_length(guest) - guest.tail
    whole = blown + guest.tail + nozzle
    narrowing = _between_ends(bubble, guest.inflated_radius / owner.inflated_radius)
    text = ""
    if whole > bubble.length:
        text = f"is {at_least(whole)} long with its nozzle and its flat tip"
        text += f", expected at most {at_most(bubble.length)} in {bubble.name}"
    elif blown > narrowing:
        text = f"is {at_least(blown)} long when blown up, expected at most {at_most(narrowing)}"
        text += f" between the ends of {bubble.name}"
    if text:
        room = bubble.length - nozzle
        blown = min(blown, narrowing, USUAL_SHARE * room)
        flat = blown / maxwell_state(softened(guest.rubber)).bulged.b + min(guest.tail, room - blown)
        return f"{text}, such as inflated: {at_most(blown)}, length: {at_most(flat)}"
    return text


def _misplaced(guest: Shaped, owner: Shaped, place: tuple[float, float, float]) -> str:
    """Say why a balloon from a mesh does not lie in another; nothing where it does.

    `place`: where the recipe has it, m.
    """
    within, around = guest.surface.start, owner.surface.start
    # A coarse wall has points inside and yet goes through the other.
    finer = within
    while len(finer.points) < LEAST_TESTED:
        finer = finer.split()
    some = finer.points[:: -(-len(finer.points) // MOST_TESTED)]
    outside = int((~around.encloses(some)).sum())
    if not outside and not within.encloses(around.points).any():
        return ""
    shift = np.mean(around.box, axis=0) - np.mean(within.box, axis=0)
    expected = "all of it inside, such as a smaller one or another place"
    if around.encloses(some + shift).all():
        expected = f"at: [{', '.join(f'{100.0 * value:g} cm' for value in np.add(shift, place).round(3))}]"
    return f"lies outside with {outside / len(some):.0%} of its wall, expected {expected}"


def _crowded(name: str, owner: Shaped, shapes: list[Shaped]) -> str:
    """Say why balloons from meshes have no room beside each other in one of this name; nothing where they
    have.
    """
    first, *others = (shape.surface.start for shape in shapes)
    if any(first.meets(other) for other in others):
        return "lies where another does in it, expected its box beside that"
    least = owner.surface.start.volume + sum(shape.volume for shape in shapes)
    if least > owner.volume:
        swell = math.ceil(100.0 * (least / owner.surface.ball_volume) ** (1 / 3)) / 100.0
        text = f"takes {1e3 * sum(shape.volume for shape in shapes):.3g} L with all that lies there"
        return f"{text}, which would stretch {name} further, expected swell: {swell:g} of {name}"
    return ""
