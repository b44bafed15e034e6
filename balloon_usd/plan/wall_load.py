"""The load of a tube's wall, twist by twist, against that at which latex bursts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.burst import burst_load
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.operations.table import BY_KIND

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.plan.budget import Budget
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.strip import PlannedBubble, Strip

RING = ((0.6, 1.0), (1.0, 1.7), (1.6, 2.5), (3.0, 2.1), (4.0, 1.8), (6.0, 1.4), (11.0, 1.15), (18.0, 1.07))
"""Energy of a loop, fold or ear over that of the straight tube, by its length over the tube's diameter: what
simulations give, in which no gas is pressed out of a bubble before it is bent.
"""
SOFT = 1.5
"""Power of the share of gas with which that energy falls where hands press some out, or gather more rubber:
in simulations of loops of 8 and 12 cm 1.4 to 1.7.
"""
HARD = 0.25
"""Power with which these factors grow with how hard the tube is, told by its energy over that of one with a
tail: fitted to 118 random figures, of which half have no tail. A hard tube gives way less where it is bent.
"""
PAIR = ((0.5, 0.95), (1.0, 1.2), (1.5, 1.24), (2.4, 1.15), (6.0, 1.04), (10.0, 1.0))
"""The same of a bubble whose two ends are joined with those of another."""


def wall_loads(strip: Strip, budget: Budget, graph: SculptureGraph) -> Iterator[float]:
    """Yield the load of a tube's wall after every twist of its budget: 1 where it bursts.

    A bubble is as hard as the open part when its neck closes.
    """
    lengths: list[float] = []
    energies: list[float] = []
    section = math.tau * strip.size.radius * strip.size.thickness
    bulged = maxwell_state(strip.rubber).bulged
    start = float(strip.rubber.energy(bulged.a, bulged.b))
    for bubble, twist in zip(strip.bubbles, budget.twists, strict=False):
        lengths.append(bubble.wall_length)
        energies.append(twist.sealed * _bent(strip, bubble, graph, twist.sealed / start))
        filled = max(strip.size.length - bubble.rest_end - 0.5 * bubble.drawn[1] - twist.tail_left, 0.0)
        yield burst_load(strip.rubber, section * np.array([*lengths, filled]), [*energies, twist.energy])


def _bent(strip: Strip, bubble: PlannedBubble, graph: SculptureGraph, hardness: float) -> float:
    """Return the energy of a bubble's wall in the sculpture over that of its straight tube.

    `hardness`: the latter over that of a tube with a tail.
    """
    ends = {edge.bubble: {edge.start, edge.end} for edge in graph.edges}
    mine = ends[bubble.name]
    length = bubble.length / (2.0 * strip.inflated_radius)
    hard = math.pow(hardness, HARD)
    if len(mine) == 1:
        soft = math.pow(bubble.gas / (BY_KIND[bubble.kind].gas * bubble.slack), SOFT)
        return hard * soft * _between(RING, length)
    if sum(other == mine for other in ends.values()) > 1:
        return hard * _between(PAIR, length)
    return 1.0


def _between(table: Sequence[tuple[float, float]], length: float) -> float:
    lengths, factors = np.array(table).T
    return float(np.interp(length, lengths, factors))
