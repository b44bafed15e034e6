"""What hangs together: connected pieces and closed rings of bubbles.

A graph library would do; but its import takes 0.12 to 0.3 s, a tenth of the start of a simulation, which
asks for what comes undone in the end, and more than all else of a plan.
"""

from __future__ import annotations

from collections import deque
from functools import cached_property
from typing import TYPE_CHECKING

from balloon_usd.operations.disjoint_sets import DisjointSets

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.joint import Joint

    Ends = Mapping[str, tuple[Joint, Joint]]
    """Joints at the two ends of bubbles, by their names."""


class Connections:
    """A graph with joints as vertices and bubbles as edges."""

    def __init__(self, ends: Ends) -> None:
        """Take the joints at the ends of every bubble, each joint named by one of its ends."""
        self._ends = ends
        self._at: dict[Joint, list[str]] = {}
        for bubble, joints in ends.items():
            for joint in joints:
                self._at.setdefault(joint, []).append(bubble)

    def pieces(self) -> list[frozenset[str]]:
        """Return the bubbles of each connected piece, in the order of their first ones."""
        met: set[str] = set()
        found = []
        for bubble, (start, _) in self._ends.items():
            if bubble not in met:
                found.append(self.reached(start))
                met |= found[-1]
        return found

    def reached(self, first: Joint, without: str | None = None) -> frozenset[str]:
        """Return the bubbles that are connected to a joint, also if one bubble is left out."""
        return self._walked([first], {first}, without)

    def beyond(self, bubble: str, joint: Joint) -> frozenset[str]:
        """Return a bubble and all that hang together with it on ways that do not pass a joint."""
        coming = [end for end in self._ends[bubble] if end != joint]
        return self._walked(coming, {joint, *coming}) | {bubble}

    def _walked(self, coming: list[Joint], met: set[Joint], without: str | None = None) -> frozenset[str]:
        """Return the bubbles on all ways from some joints that do not go on from joints met before."""
        found = set()
        while coming:
            here = coming.pop()
            for bubble in self._at.get(here, ()):
                if bubble != without:
                    found.add(bubble)
                    there = self._other(bubble, here)
                    if there not in met:
                        met.add(there)
                        coming.append(there)
        return frozenset(found)

    def at(self, joint: Joint) -> frozenset[str]:
        """Return the bubbles with an end in a joint."""
        return frozenset(self._at[joint])

    def hinges(self) -> Iterator[Joint]:
        """Yield the joints at which a piece falls apart."""
        for joint, bubbles in self._at.items():
            if not self.at(joint) <= self.beyond(bubbles[0], joint):
                yield joint

    @cached_property
    def bridges(self) -> frozenset[str]:
        """Bubbles that belong to no closed ring: without any of them a piece falls apart."""
        ways, order = self._spanning_trees()
        walked = {bubble for bubble, _ in ways.values()}
        # Bubbles that close a ring, by the joints at or behind which they have just one of their ends.
        closing: dict[Joint, set[str]] = {joint: set() for joint in order}
        for bubble, joints in self._ends.items():
            if bubble not in walked:
                for joint in joints:
                    closing[joint] ^= {bubble}
        found = set()
        for joint in reversed(order):
            if joint in ways:
                bubble, before = ways[joint]
                if not closing[joint]:
                    found.add(bubble)
                closing[before] ^= closing[joint]
        return frozenset(found)

    def blocks(self) -> list[frozenset[str]]:
        """Return the bubbles of each part that no joint alone holds together, in the order of first ones.

        Bubbles are of one such block if closed rings that share bubbles lead from one to the other. It is
        enough to look at the ring that each bubble outside a spanning tree closes (Whitney 1935).
        """
        together: DisjointSets[str] = DisjointSets()
        for ring in self._rings():
            together.merge(ring)
        found: dict[str, set[str]] = {}
        for bubble in self._ends:
            found.setdefault(together.root(bubble), set()).add(bubble)
        return [frozenset(block) for block in found.values()]

    def _rings(self) -> Iterator[list[str]]:
        """Yield the ring that each bubble outside a spanning tree closes with bubbles of the tree."""
        ways, order = self._spanning_trees()
        walked = {bubble for bubble, _ in ways.values()}
        far: dict[Joint, int] = {}
        for joint in order:
            far[joint] = far[ways[joint][1]] + 1 if joint in ways else 0
        for bubble in self._ends.keys() - walked:
            ring = [bubble]
            one, other = self._ends[bubble]
            while one != other:
                if far[one] < far[other]:
                    one, other = other, one
                beside, one = ways[one]
                ring.append(beside)
            yield ring

    def _spanning_trees(self) -> tuple[dict[Joint, tuple[str, Joint]], list[Joint]]:
        """Return how a walk over all pieces came to each joint, and the joints in the order of the walk."""
        ways: dict[Joint, tuple[str, Joint]] = {}
        order: list[Joint] = []
        met: set[Joint] = set()
        for first in self._at:
            coming = deque([first] if first not in met else [])
            met.add(first)
            while coming:
                here = coming.popleft()
                order.append(here)
                for bubble in self._at[here]:
                    there = self._other(bubble, here)
                    if there not in met:
                        met.add(there)
                        ways[there] = bubble, here
                        coming.append(there)
        return ways, order

    def _other(self, bubble: str, joint: Joint) -> Joint:
        start, end = self._ends[bubble]
        return end if joint == start else start
