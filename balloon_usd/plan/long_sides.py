"""Long sides: bubbles of a closed ring that are longer than all others of it together."""

from __future__ import annotations

import heapq
from collections import defaultdict
from typing import TYPE_CHECKING

from balloon_usd.language.choices import all_of
from balloon_usd.language.lengths import at_most, cm
from balloon_usd.operations.caution import UNEQUAL, Caution

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.plan.graph import GraphEdge, SculptureGraph
    from balloon_usd.plan.strip import Strip

Ways = dict[int, list["GraphEdge"]]
"""Bubbles that end in a joint, by the joint."""


def long_sides(strips: Mapping[str, Strip], graph: SculptureGraph) -> Iterator[Caution]:
    """Yield a caution for every bubble whose two joints other bubbles hold too near to each other.

    A single bubble beside it makes a pair, of which the lock tells.
    """
    bubbles = {bubble.name: bubble for strip in strips.values() for bubble in strip.bubbles}
    lengths = {name: bubble.length for name, bubble in bubbles.items()}
    sides = [edge for edge in graph.edges if edge.bubble not in graph.bridges and edge.start != edge.end]
    ways: Ways = defaultdict(list)
    for edge in sides:
        ways[edge.start].append(edge)
        ways[edge.end].append(edge)
    for edge in sides:
        others = sorted(_shortest_way(edge, ways, lengths), key=list(bubbles).index)
        length, round_by = lengths[edge.bubble], sum(lengths[other] for other in others)
        if len(others) > 1 and length > (1.0 + UNEQUAL) * round_by:
            yield Caution(
                bubbles[edge.bubble].step,
                f"{edge.bubble} ({cm(length)}) is longer than {all_of(others)} together ({cm(round_by)})",
                "they close a ring, in which it cannot lie straight: it bows out, and they are drawn taut",
                f"make it {at_most(round_by)} long, or the others longer",
            )


def _shortest_way(side: GraphEdge, ways: Ways, lengths: Mapping[str, float]) -> tuple[str, ...]:
    """Return the bubbles of the shortest way between the two joints of a side without it (Dijkstra 1959)."""
    coming: list[tuple[float, tuple[str, ...], int]] = [(0.0, (), side.start)]
    met: set[int] = set()
    while coming:
        far, behind, here = heapq.heappop(coming)
        if here == side.end:
            return behind
        if here in met:
            continue
        met.add(here)
        for edge in ways[here]:
            if edge.bubble != side.bubble:
                there = edge.end if edge.start == here else edge.start
                heapq.heappush(coming, (far + lengths[edge.bubble], (*behind, edge.bubble), there))
    return ()
