"""Distances along the sides of a graph."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from balloon_usd.language.joint import Joint

Node = TypeVar("Node", int, "Joint")


def distances(sides: Iterable[tuple[Node, Node, float]], first: Node) -> Mapping[Node, float]:
    """Return how far every node that hangs together with a first one lies from it along sides (m)."""
    beside: dict[Node, list[tuple[Node, float]]] = {}
    for one, other, length in sides:
        beside.setdefault(one, []).append((other, length))
        beside.setdefault(other, []).append((one, length))
    found: dict[Node, float] = {}
    coming: list[tuple[float, int, Node]] = [(0.0, 0, first)]
    met = 0
    while coming:
        far, _, node = heapq.heappop(coming)
        if node not in found:
            found[node] = far
            for other, length in beside.get(node, ()):
                met += 1
                heapq.heappush(coming, (far + length, met, other))
    return found
