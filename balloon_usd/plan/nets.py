"""Nets: closed rings of bubbles that share joints, such as the edges of a solid, and their shape in space.

A net is a block of the sculpture graph (no joint alone holds it together) in which some joint has three or
more different neighbours. A lone ring of one balloon is none: makers give it its shape as they close it. One
of several balloons is, for no chain that hands could close goes through all of it.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.stress import majorize

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.operations.moves import Vector
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan.graph import GraphEdge, SculptureGraph
    from balloon_usd.plan.rings import RingTable
    from balloon_usd.plan.strip import Strip

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

OPENING = (0.3, 0.03, 0.003)
"""Weights, beside 1 of a bubble's length, with which joints that no bubble connects are kept apart: falling,
so that the net first finds its form and then its lengths.
"""
ROUNDS = 150
"""Steps of majorization at each weight: Platonic solids have edges equal to 1 % after half of them."""


@dataclass(frozen=True)
class Net:
    """A net of a finished sculpture."""

    places: Mapping[int, Vector]
    """Where the joint lies at which a ring of the plan is, m; by ring, about the middle of the net."""
    sides: tuple[tuple[int, int], ...]
    """Rings at the two ends of each of its bubbles."""


def nets_of(piece: Workpiece, strips: Mapping[str, Strip], table: RingTable) -> tuple[Net, ...]:
    """Return the nets of a finished workpiece, opened as far as their bubbles let them."""
    graph = sculpture_graph(piece)
    lengths = {bubble.name: bubble.length for strip in strips.values() for bubble in strip.bubbles}
    blocks = ([edge for edge in graph.edges if edge.bubble in block] for block in piece.blocks())
    return tuple(_net(graph, edges, lengths, table) for edges in blocks if _is_net(edges))


def _is_net(edges: list[GraphEdge]) -> bool:
    """Whether some joint has three or more different neighbours, or three or more joints are of several
    balloons.
    """
    beside: dict[int, set[int]] = defaultdict(set)
    for edge in edges:
        beside[edge.start].add(edge.end)
        beside[edge.end].add(edge.start)
    several = len({edge.balloon for edge in edges}) > 1
    return any(len(joints) > 2 for joints in beside.values()) or (several and len(beside) > 2)


def _net(
    graph: SculptureGraph, edges: list[GraphEdge], lengths: Mapping[str, float], table: RingTable
) -> Net:
    joints = sorted({end for edge in edges for end in (edge.start, edge.end)})
    corner = {joint: k for k, joint in enumerate(joints)}
    sides = np.array([(corner[edge.start], corner[edge.end]) for edge in edges], dtype=np.int64)
    places = embed(sides, np.array([lengths[edge.bubble] for edge in edges]))
    at: dict[int, Vector] = {}
    for joint in joints:
        x, y, z = places[corner[joint]].tolist()
        rings = (table.joint(end) for end in graph.joints[joint].ends)
        at |= {ring: (x, y, z) for ring in rings if ring is not None}
    ends = (table.ends(edge.bubble) for edge in edges)
    return Net(at, tuple((start, end) for start, end in ends if end is not None))


def embed(sides: Ints, lengths: Floats) -> Floats:
    """Return places of a net's joints in space at which its sides have their lengths and all else is far
    apart, (joints, 3), m, about their middle.

    Regular solids come out as they are: the stress of the distances is majorized (de Leeuw 1977) from the
    classical solution on, with distances along the net between joints that no side connects.

    Args:
        sides: joints at both ends, (sides, 2).
        lengths: (sides,) m.
    """
    count = int(sides.max()) + 1
    wanted = np.full((count, count), np.inf)
    np.fill_diagonal(wanted, 0.0)
    first, second = sides.T
    # Of bubbles side by side the mean counts.
    total, bubbles = np.zeros_like(wanted), np.zeros_like(wanted)
    for one, other in ((first, second), (second, first)):
        np.add.at(total, (one, other), lengths)
        np.add.at(bubbles, (one, other), 1.0)
    beside = bubbles > 0.0
    wanted[beside] = total[beside] / bubbles[beside]
    for k in range(count):
        wanted = np.minimum(wanted, wanted[:, [k]] + wanted[k])
    places = _classical(wanted)
    for opening in OPENING:
        weights = np.where(beside, 1.0, opening)
        np.fill_diagonal(weights, 0.0)
        places = majorize(places, wanted, weights, ROUNDS)
    far = np.linalg.norm(places[first] - places[second], axis=1)
    return places * float(far @ wanted[first, second] / (far @ far))


def _classical(wanted: Floats) -> Floats:
    """Return the places whose distances are nearest to the wanted ones in the classical sense
    (Torgerson 1952), (N, 3).
    """
    squares = wanted**2
    means = squares.mean(axis=0)
    values, axes = np.linalg.eigh(-0.5 * (squares - means - means[:, None] + squares.mean()))
    return np.asarray(axes[:, -3:] * np.sqrt(np.maximum(values[-3:], 1e-12)))
