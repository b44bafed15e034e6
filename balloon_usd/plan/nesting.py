"""Balloons in balloons: where each lies, and how much room it takes."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.balloon.bubble_shape import pinch_length
from balloon_usd.balloon.round_outline import Outline, round_outline
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.laying_rounds import round_volume
from balloon_usd.plan.open_tube import inflated_tube, softened

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.plan.strip import Strip

BRINGING_SPEED = 0.15
"""Speed at which hands bring a flat tube along in another, m/s. Judged."""
NARROWER = 0.75
"""Most radius of a flat balloon that goes into another, in that of the other. Judged."""
NOZZLE = 4.0
"""How far knot and lip of a tube reach, in its flat radii."""


class Host(NamedTuple):
    """Where a balloon lies in another."""

    balloon: str
    bubble: int
    """Number of the bubble of that."""
    along: float
    """Distance of its knot from that of the other while both are flat, m; 0 of one from a mesh, whose file
    says where it lies.
    """
    goal: float
    """The same where hands bring it before it is blown up, m."""

    @property
    def way(self) -> float:
        """How far they bring it, m."""
        return self.goal - self.along


def hosts_of(strips: Mapping[str, Strip]) -> dict[str, Host]:
    """Return where those balloons lie that lie in others, by their names."""
    return {name: host for owner in strips.values() for name, host in _guests_of(owner, strips)}


def room_left(strips: Mapping[str, Strip], balloon: str) -> float:
    """Return the share of a balloon's volume that what lies in it leaves to its own gas."""
    guests = (name for name, host in hosts_of(strips).items() if host.balloon == balloon)
    return 1.0 - sum(blown_volume(strips[name]) for name in guests) / blown_volume(strips[balloon])


def with_guests(strips: Mapping[str, Strip]) -> dict[str, Strip]:
    """Return the balloons with the gas of each bubble that what lies in it leaves room for."""
    taken: dict[tuple[str, int], float] = defaultdict(float)
    for name, host in hosts_of(strips).items():
        taken[host.balloon, host.bubble] += blown_volume(strips[name])
    found = {}
    for name, strip in strips.items():
        left = enumerate(strip.bubbles)
        bubbles = (replace(it, volume=it.volume - taken.get((name, number), 0.0)) for number, it in left)
        blown = strip.blown
        if blown is not None:
            blown = blown._replace(volume=blown.volume - taken.get((name, 0), 0.0))
        found[name] = replace(strip, bubbles=tuple(bubbles), blown=blown) if taken else strip
    return found


def blown_volume(strip: Strip) -> float:
    """Return the volume of a balloon that is blown up, m3."""
    if strip.shape is not None:
        return strip.shape.volume
    if strip.blown is not None:
        return round_volume(strip.size, strip.blown.width)
    return float(inflated_tube(strip.size, softened(strip.rubber), strip.tail).volume)


def room_to_sink(strips: Mapping[str, Strip]) -> float:
    """Return how far what lies in others can sink at most, m, once all are blown up; 0 where nothing does."""
    return max((_room(strips, name, host) for name, host in hosts_of(strips).items()), default=0.0)


def nozzle_length(strip: Strip) -> float:
    """Return how far knot and lip of a tube or a round balloon reach, m."""
    return NOZZLE * strip.size.neck_radius


def flat_length(strip: Strip) -> float:
    """Return how long a tube or a round balloon is while it is flat, from its knot to its tip, m."""
    if strip.size.heart:
        return strip.size.heart_wall.height
    return float(_outline(strip).x[-1]) if strip.is_round else strip.size.length


def flat_room(owner: Strip, guest: Strip) -> tuple[float, float]:
    """Return from where to where a balloon is wide enough for another, both flat, m from its knot; the neck
    of a heart may lie before that.
    """
    if not owner.is_round:
        return owner.size.radius, owner.size.length - owner.size.radius
    outline = _outline(owner)
    wide = outline.x[outline.radius >= guest.size.radius / NARROWER]
    if not len(wide):
        return 0.0, 0.0
    clear, before = guest.size.radius, float(wide[0])
    if guest.size.heart:
        clear, before = guest.size.heart_wall.lobe, before - guest.size.heart_wall.shoulder
    return max(before, clear), min(float(wide[-1]), float(outline.x[-1]) - clear)


def _outline(strip: Strip) -> Outline:
    return round_outline(strip.size.radius, strip.size.neck_radius)


def blown_length(strip: Strip) -> float:
    """Return the length of a tube that is blown up and not twisted, m, from its knot to its flat tip; or of a
    round balloon.
    """
    return strip.bubbles[-1].end + strip.tail


def _room(strips: Mapping[str, Strip], guest: str, host: Host) -> float:
    """Return how much wider, or of a tube longer, a bubble is than what lies in it, m."""
    owner, inner = strips[host.balloon], strips[guest]
    wider = _width(owner) - _width(inner)
    return wider if owner.shape else max(wider, owner.bubbles[host.bubble].length - blown_length(inner))


def _width(strip: Strip) -> float:
    """Return how wide a balloon is that is blown up, m; one from a mesh, as a ball of its volume."""
    if strip.shape is None:
        return 2.0 * strip.inflated_radius
    return float(2.0 * (0.75 * strip.shape.volume / math.pi) ** (1 / 3))


def _guests_of(owner: Strip, strips: Mapping[str, Strip]) -> Iterator[tuple[str, Host]]:
    """Yield what lies in a balloon. Flat tubes and round balloons lie in it where they will, or as near to
    that as they have room behind each other.
    """
    numbers = {bubble.name: number for number, bubble in enumerate(owner.bubbles)}
    inside = [(numbers[it.inside], it) for it in strips.values() if it.inside in numbers]
    inside.sort(key=lambda each: each[0])
    goals, places = [], []
    free = 0.0
    for number, guest in inside:
        goal = 0.0
        if guest.shape is None:
            goal = _middle(owner, number) - 0.5 * (blown_length(guest) - nozzle_length(guest))
            free = max(free, flat_room(owner, guest)[0])
        goals.append(goal)
        places.append(max(goal, free + nozzle_length(guest)) if guest.shape is None else 0.0)
        free = places[-1] + (flat_length(guest) if guest.shape is None else 0.0) + guest.size.radius
    free = math.inf
    for place, (_, guest) in reversed(list(enumerate(inside))):
        if guest.shape is None:
            free = min(free, flat_room(owner, guest)[1])
            places[place] = min(places[place], free - flat_length(guest))
            free = places[place] - nozzle_length(guest) - guest.size.radius
    for goal, along, (number, guest) in zip(goals, places, inside, strict=True):
        yield guest.balloon, Host(owner.balloon, number, along, goal)


def _middle(owner: Strip, number: int) -> float:
    """Return where the middle of a bubble lies before anything is twisted off, m from the knot."""
    if owner.is_round:
        return 0.5 * owner.bubbles[0].length
    rubber = softened(owner.rubber)
    stretch, round_end = maxwell_state(rubber).bulged.b, 0.5 * pinch_length(owner.size, rubber)
    bubble = owner.bubbles[number]
    begin = max(stretch * bubble.rest_start - round_end, 0.0)
    end = stretch * bubble.rest_end - round_end
    if bubble is owner.bubbles[-1]:
        end = stretch * (owner.size.length - owner.tail) - 2.0 * round_end
    return 0.5 * (begin + end)
