"""What hangs together in a graph, and what lies on its closed rings."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


class Connections:
    """Connected pieces and bridges of a graph of so many joints, with an edge from joint to joint."""

    def __init__(self, joints: int, edges: Sequence[tuple[int, int]]) -> None:
        self._edges = edges
        self._way: dict[int, tuple[int, int]] = {}
        """Edge by which the walk came to a joint, and the joint before it."""
        at: list[list[int]] = [[] for _ in range(joints)]
        for edge, ends in enumerate(edges):
            for joint in ends:
                at[joint].append(edge)
        self._walks: list[list[int]] = []
        """Joints of every piece in the order in which they were come to."""
        met: set[int] = set()
        for joint in range(joints):
            if joint not in met:
                self._walks.append(self._walk(joint, at, met))

    def _walk(self, first: int, at: Sequence[Sequence[int]], met: set[int]) -> list[int]:
        walk, coming = [], deque([first])
        met.add(first)
        while coming:
            here = coming.popleft()
            walk.append(here)
            for edge in at[here]:
                there = sum(self._edges[edge]) - here
                if there not in met:
                    met.add(there)
                    self._way[there] = (edge, here)
                    coming.append(there)
        return walk

    @property
    def pieces(self) -> tuple[frozenset[int], ...]:
        """Joints of every connected piece, in the order of their first joints."""
        return tuple(map(frozenset, self._walks))

    @property
    def bridges(self) -> frozenset[int]:
        """Edges without which a piece would fall apart: those on no closed ring."""
        walked = {edge for edge, _ in self._way.values()}
        # Edges that close a ring, by the joints at or behind which they have just one of their ends.
        closing: dict[int, set[int]] = {joint: set() for walk in self._walks for joint in walk}
        for edge, ends in enumerate(self._edges):
            if edge not in walked:
                for joint in ends:
                    closing[joint] ^= {edge}
        found = set()
        for walk in self._walks:
            for joint in reversed(walk[1:]):
                edge, before = self._way[joint]
                if not closing[joint]:
                    found.add(edge)
                closing[before] ^= closing[joint]
        return frozenset(found)
