"""Room about a joint: bubbles that meet in one point hold gas, and reach only so far from it.

A bubble lies within its length of the joint at which it ends, or within half the length of its wall where
both its ends are there, like a loop or an ear. So the gas of all that meet must have room in a ball: that of
the bubble with the least reach in a ball of that reach, that of the next one besides in one of its own, and
so on: all solid angles about a joint make no more than a sphere. Bubbles are soft: they taper to their necks,
take any shape between their neighbours and give way, and only their gas is kept. What their rubber gives by
is said below; nothing else is allowed for, and nothing else is asked.
"""

from __future__ import annotations

import math
from itertools import accumulate
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.language.lengths import cm
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.workpiece import Joined
from balloon_usd.plan.graph import sculpture_graph

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.joint import Joint
    from balloon_usd.language.problem import Problem
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

    OnStrips = Mapping[str, tuple[PlannedBubble, Strip]]
    """Bubbles and their balloons, by name."""

MOST_DRAWN = 1.7
"""Reach to which bubbles can be drawn out, in their own: a wall that is 4.1 times as long as it was flat
tears at 7 times.
"""
EASILY_DRAWN = 1.1
"""The same to which neighbours draw them without a caution: three small ears at one joint are everyday."""
ROUND_END = 0.5 * math.pi - 1.0
"""How much longer the wall of a round end is than the end, in its radii."""


class Crowd(NamedTuple):
    """Bubbles that meet in a joint and have too little room about it."""

    meeting: int
    """How many there are that reach no farther than the last of them."""
    fitting: int
    """How many of them there is room for."""
    longest: float
    """Length of the longest of them, m."""
    pressed: float
    """Volume of their gas, in that of the ball of the reach that they have of themselves."""


def room_problems(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Problem]:
    """Yield steps that bring more bubbles to one joint than ever have room about it."""
    for step, crowd in _crowds(recipe, strips, MOST_DRAWN):
        text = f"{crowd.meeting} bubbles of at most {cm(crowd.longest)} would meet in one joint, about which "
        text += f"there is room for {crowd.fitting}, expected fewer, or others between that part their joints"
        yield recipe.problem(("steps", step), text)


def room_cautions(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Caution]:
    """Yield a caution for every joint about which bubbles will press each other out of shape."""
    for step, crowd in _crowds(recipe, strips, EASILY_DRAWN):
        yield Caution(
            step,
            f"{crowd.meeting} bubbles of at most {cm(crowd.longest)} crowd about one joint",
            f"they hold {crowd.pressed:.1f} times the gas for which there is room within their reach, and "
            "press each other out of shape",
            f"let at most {crowd.fitting} of them meet, and part their joints by others between them",
        )


def _crowds(recipe: Recipe, strips: Mapping[str, Strip], drawn: float) -> Iterator[tuple[int, Crowd]]:
    """Yield the crowded joints of a sculpture, each with the first step after which it is so."""
    bubbles = {bubble.name: (bubble, strip) for strip in strips.values() for bubble in strip.bubbles}
    finished = sculpture_graph(recipe.piece)
    joined = sorted({event.step for event in recipe.piece.history if isinstance(event, Joined)})
    for joint in finished.joints:
        if _crowd(joint.ends[0], finished, _with_gas(bubbles, recipe.piece), drawn) is None:
            continue
        for step in joined:
            piece = recipe.piece.after(step)
            graph = sculpture_graph(piece)
            made = [end for end in joint.ends if any(edge.bubble == end.bubble for edge in graph.edges)]
            crowd = _crowd(made[0], graph, _with_gas(bubbles, piece), drawn) if made else None
            if crowd is not None:
                yield step, crowd
                break


def _with_gas(bubbles: OnStrips, piece: Workpiece) -> OnStrips:
    """Return the bubbles that have not been popped."""
    return {name: each for name, each in bubbles.items() if name not in piece.popped}


def _crowd(at: Joint, graph: SculptureGraph, bubbles: OnStrips, drawn: float) -> Crowd | None:
    """Return what is too much about the joint with this bubble end; None where all has room."""
    joint = graph.joint_of(at)
    met = [
        (_reach(*bubbles[edge.bubble], closed=edge.start == edge.end), bubbles[edge.bubble][0])
        for edge in graph.edges_at(joint.index)
        if edge.bubble in bubbles
    ]
    met.sort(key=lambda each: each[0])
    room = [4.0 / 3.0 * math.pi * (drawn * reach) ** 3 for reach, _ in met]
    gas = list(accumulate(bubble.volume for _, bubble in met))
    over = [k for k, (held, there) in enumerate(zip(gas, room, strict=True)) if held > there]
    if not over:
        return None
    last = over[-1]
    fitting = sum(held <= room[last] for held in gas)
    longest = max(bubble.length for _, bubble in met[: last + 1])
    return Crowd(last + 1, fitting, longest, drawn**3 * gas[last] / room[last])


def _reach(bubble: PlannedBubble, strip: Strip, *, closed: bool) -> float:
    """Return how far a bubble reaches from its joint, m; `closed`: whether both its ends are there."""
    if closed:
        return 0.5 * (bubble.length + ROUND_END * min(bubble.length, strip.width_of(bubble)))
    # What is left of a balloon has gas in its tail, too.
    return max(bubble.length, bubble.rest_length) if bubble.kind == "rest" else bubble.length
