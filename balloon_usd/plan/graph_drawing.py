"""The sculpture graph as a drawing: joints as dots, bubbles as thick lines in the colour of their balloon."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.plan import svg

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import networkx as nx

    from balloon_usd.plan.graph import GraphEdge, SculptureGraph
    from balloon_usd.plan.svg import Point

HEIGHT = 460.0
"""Height of the drawing."""
CELL = 760.0
"""Width of the part for one connected piece."""
_MARGIN = 90.0
_BOW = 72.0
_PETAL = 95.0
_PETAL_SPREAD = 0.4
_PETAL_STEP = 0.95
_LARGEST_SPRUNG_PIECE = 300
_LAYOUT_SEED = 5


def graph_width(graph: SculptureGraph) -> float:
    """Return the width of the drawing: one cell for every connected piece."""
    return CELL * len(graph.pieces)


def graph_shapes(graph: SculptureGraph, colors: Mapping[str, str], corner: svg.Point) -> Iterator[str]:
    """Yield the SVG shapes of a graph below and right of a corner; `colors` by balloon."""
    spots: dict[int, Point] = {}
    for number, piece in enumerate(sorted(graph.pieces, key=min)):
        spots |= _spots(graph, piece, (corner[0] + CELL * number, corner[1]))
    for edges in _bundles(graph):
        joint = edges[0].start
        if joint == edges[0].end:
            yield from _petals(edges, spots[joint], _widest_gap(graph, spots, joint), colors)
        else:
            yield from _bows(edges, spots, colors)
    for place in graph.joints:
        kind, radius = ("merged", 8.0) if place.merged else ("joint", 5.0)
        yield svg.circle(spots[place.index], radius, kind, str(place))


def _bundles(graph: SculptureGraph) -> list[list[GraphEdge]]:
    """Edges between the same two joints, together."""
    bundles: dict[frozenset[int], list[GraphEdge]] = {}
    for edge in graph.edges:
        bundles.setdefault(frozenset((edge.start, edge.end)), []).append(edge)
    return list(bundles.values())


def _spots(graph: SculptureGraph, piece: frozenset[int], corner: Point) -> dict[int, Point]:
    """Places of a piece's joints in its cell; by springs where it is small enough to gain from them."""
    import networkx as nx  # noqa: PLC0415  # slow to import, and only drawings need it

    plain: nx.Graph[int] = nx.Graph()
    plain.add_nodes_from(sorted(piece))
    plain.add_edges_from((edge.start, edge.end) for edge in graph.edges if edge.start in piece)
    spread = nx.circular_layout(plain)
    if 1 < len(piece) <= _LARGEST_SPRUNG_PIECE:
        spread = nx.spring_layout(plain, pos=spread, iterations=300, seed=_LAYOUT_SEED)
    places = np.array([spread[joint] for joint in plain])
    places -= places.mean(axis=0)
    # Longest way across the page; without the sign rule a mirrored drawing would be as good.
    axes = np.linalg.svd(places, full_matrices=False)[2] if len(piece) > 1 else np.eye(2)
    places = places @ (axes * np.where(axes[:, :1] < 0.0, -1.0, 1.0)).T
    low, high = places.min(axis=0), places.max(axis=0)
    room = np.array([CELL - 2.0 * _MARGIN, HEIGHT - 2.0 * _MARGIN])
    scale = float(np.min(room / np.maximum(high - low, 1e-9))) if len(piece) > 1 else 0.0
    places = (places - 0.5 * (low + high)) * scale + np.array(corner) + 0.5 * np.array([CELL, HEIGHT])
    return {joint: (float(x), float(y)) for joint, (x, y) in zip(plain, places, strict=True)}


def _widest_gap(graph: SculptureGraph, spots: Mapping[int, Point], joint: int) -> tuple[float, float]:
    """Return the middle and the width (radians) of the widest gap between a joint's neighbours."""
    here = spots[joint]
    others = {edge.end if edge.start == joint else edge.start for edge in graph.edges_at(joint)} - {joint}
    angles = sorted(math.atan2(spots[other][1] - here[1], spots[other][0] - here[0]) for other in others)
    if not angles:
        return -0.5 * math.pi, 2.0 * math.pi
    after = [*angles[1:], angles[0] + 2.0 * math.pi]
    gap, start = max((end - start, start) for start, end in zip(angles, after, strict=True))
    return start + 0.5 * gap, gap


def _petals(
    edges: list[GraphEdge], at: Point, gap: tuple[float, float], colors: Mapping[str, str]
) -> Iterator[str]:
    direction, width = gap
    step = min(_PETAL_STEP, width / len(edges))
    for lane, edge in enumerate(edges):
        angle = direction + step * (lane - 0.5 * (len(edges) - 1))
        controls = [_polar(at, _PETAL, angle + side) for side in (-_PETAL_SPREAD, _PETAL_SPREAD)]
        yield svg.curve([at, *controls, at], colors[edge.balloon])
        yield svg.text(edge.bubble, _polar(at, 0.7 * _PETAL, angle), "name")


def _bows(edges: list[GraphEdge], spots: Mapping[int, Point], colors: Mapping[str, str]) -> Iterator[str]:
    low, high = sorted((edges[0].start, edges[0].end))
    (x0, y0), (x1, y1) = spots[low], spots[high]
    far = math.dist(spots[low], spots[high]) or 1.0
    for lane, edge in enumerate(edges):
        bow = _BOW * (lane - 0.5 * (len(edges) - 1))
        across = (-bow * (y1 - y0) / far, bow * (x1 - x0) / far)
        middle = (0.5 * (x0 + x1), 0.5 * (y0 + y1))
        control = (middle[0] + 2.0 * across[0], middle[1] + 2.0 * across[1])
        yield svg.curve([spots[low], control, spots[high]], colors[edge.balloon])
        yield svg.text(edge.bubble, (middle[0] + across[0], middle[1] + across[1] + 4.0), "name")


def _polar(center: Point, radius: float, angle: float) -> Point:
    return center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)
