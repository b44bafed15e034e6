"""Bent chains: where bends send the middles of bubbles that hang on each other in a row.

Only what the plan can know: bubbles of one balloon that belong to no closed ring lie in a row, straight on
from joint to joint, and bends lead them away as hands do. What makes a ring hangs at its joint and turns
nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.bend import Bend
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.moves import POINTS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

Floats = NDArray[np.float64]

SIDES = 24
"""Sides by which the middle of a bubble is drawn."""
INSIDE = 0.5
"""Distance of the middles of two bubbles, in their mean width, below which one is sent into the other; where
they lie side by side it is 1.
"""
MUCH = 1.0 / 3.0
"""Share of the shorter of two bubbles that lies in the other one so that it is told."""


@dataclass
class _Link:
    """A bubble of a row."""

    bubble: PlannedBubble
    width: float
    """Of the bubble, m."""
    middle: Floats
    """Its middle from its start to its end, (SIDES + 1, 3), m."""
    along: Floats
    """The same as distances along the row, (SIDES + 1,) m."""


def bends_onto_others(
    recipe: Recipe, strips: Mapping[str, Strip], graph: SculptureGraph
) -> Iterator[Caution]:
    """Yield a caution for every pair of bubbles of which bends lay one where the other is."""
    bends = [(index, step) for index, step in enumerate(recipe.steps) if isinstance(step, Bend)]
    for row in _rows(recipe, strips, graph) if bends else ():
        last = -1
        for index, step in bends:
            for at, link in enumerate(row):
                if link.bubble.name in step.bend:
                    point = np.array(POINTS[step.point or "up"], dtype=np.float64)
                    _bend(row, at, step.bend[link.bubble.name], point)
                    last = index
        for one, other in combinations(range(len(row)), 2) if last >= 0 else ():
            if other - one > 1 and _lies_in(row[one], row[other]):
                yield _caution(last, row[one].bubble.name, row[other].bubble.name)


def _caution(step: int, one: str, other: str) -> Caution:
    return Caution(
        step,
        f"bends lay {other} onto {one}",
        "both are sent to one place, where their walls push each other aside",
        "bend them less, or to another point",
    )


def _rows(recipe: Recipe, strips: Mapping[str, Strip], graph: SculptureGraph) -> Iterator[list[_Link]]:
    """Yield the bubbles that hang on each other in a row, straight along x; rings between them left out."""
    edges = {edge.bubble: edge for edge in graph.edges}
    bubbles = {bubble.name: (bubble, strip) for strip in strips.values() for bubble in strip.bubbles}
    for trail in recipe.piece.trails:
        row: list[_Link] = []
        for name in (name for name in trail if name in graph.bridges):
            if row and edges[row[-1].bubble.name].end != edges[name].start:
                yield row
                row = []
            bubble, strip = bubbles[name]
            begin = row[-1].along[-1] if row else 0.0
            along = begin + np.linspace(0.0, bubble.length, SIDES + 1)
            middle = np.stack([along, np.zeros_like(along), np.zeros_like(along)], axis=1)
            row.append(_Link(bubble, min(bubble.length, strip.width_of(bubble)), middle, along))
        yield row


def _bend(row: Sequence[_Link], at: int, angle: float, point: Floats) -> None:
    """Bend a bubble of a row, the end held behind which there is more rubber; what is beyond comes along."""
    before = sum(link.bubble.rest_length for link in row[:at])
    behind = sum(link.bubble.rest_length for link in row[at + 1 :])
    led = row[:at] if before <= behind else row[at + 1 :]
    began = row[at].middle if before > behind else row[at].middle[::-1]
    axis = _unit(began[-1] - began[0])
    side = point - axis * float(point @ axis)
    if np.linalg.norm(side) < 1e-6:
        return
    side = _unit(side)
    turns = angle * (np.arange(SIDES) + 0.5)[:, None] / SIDES
    lengths = np.linalg.norm(np.diff(began, axis=0), axis=1)[:, None]
    steps = lengths * (np.cos(turns) * axis + np.sin(turns) * side)
    bent = began[0] + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    half = math.cos(0.5 * angle) * axis + math.sin(0.5 * angle) * side
    turned = _mirror(half) @ _mirror(axis) @ _turn(_unit(began[-1] - began[-2]), axis)
    for link in led:
        link.middle = bent[-1] + (link.middle - began[-1]) @ turned.T
    row[at].middle = bent if before > behind else bent[::-1]


def _turn(one: Floats, other: Floats) -> Floats:
    """Return the rotation that leads a unit direction to another one, not its opposite, (3, 3)."""
    return np.asarray(_mirror(_unit(one + other)) @ _mirror(one))


def _mirror(axis: Floats) -> Floats:
    """Return half a turn about a unit axis, (3, 3); two turn by twice the angle of their axes."""
    return np.asarray(2.0 * np.outer(axis, axis) - np.eye(3))


def _lies_in(one: _Link, other: _Link) -> bool:
    """Whether much of the shorter of two bubbles lies in the other one, nearer than along the row."""
    short, long = sorted((one, other), key=lambda link: link.bubble.length)
    begin, side = long.middle[:-1], np.diff(long.middle, axis=0)
    squares = np.maximum(np.einsum("sx,sx->s", side, side), 1e-24)
    share = np.clip(np.einsum("ksx,sx->ks", short.middle[:, None] - begin, side) / squares, 0.0, 1.0)
    apart = np.linalg.norm(short.middle[:, None] - begin - share[:, :, None] * side, axis=2)
    straight = np.abs(short.along[:, None] - long.along[:-1] - share * np.diff(long.along))
    inside = apart < np.minimum(INSIDE * 0.5 * (one.width + other.width), 0.5 * straight)
    return bool(inside.any(axis=1).mean() > MUCH)


def _unit(direction: Floats) -> Floats:
    return np.asarray(direction / max(float(np.linalg.norm(direction)), 1e-12))
