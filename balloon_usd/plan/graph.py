"""The sculpture graph: joints are vertices, bubbles are edges.

A balloon is a trail through the graph from its knot to its tip; locks, loops, folds and ears merge its
joints.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from balloon_usd.language.joint import Joint

if TYPE_CHECKING:
    import networkx as nx

    from balloon_usd.operations.workpiece import Contact, Workpiece


@dataclass(frozen=True)
class GraphJoint:
    """One vertex: every bubble end that meets here."""

    index: int
    ends: tuple[Joint, ...]
    """Bubble ends, in plan order; within a strip the end of one bubble is the start of the next."""
    merged: bool
    """Whether a step brought several joints together here."""
    free: bool
    """Whether both bubbles that meet here are free to spin, so that the joint unwinds."""

    def __str__(self) -> str:
        return " = ".join(str(end) for end in self.ends)


@dataclass(frozen=True)
class GraphEdge:
    """One edge: a bubble from its start joint to its end joint."""

    bubble: str
    balloon: str
    start: int
    """Index of the joint at its start."""
    end: int
    """Index of the joint at its end."""


@dataclass(frozen=True)
class SculptureGraph:
    """Joints, bubbles and contacts of a workpiece, after its last step or any other."""

    joints: tuple[GraphJoint, ...]
    edges: tuple[GraphEdge, ...]
    """In plan order over all balloons."""
    pieces: tuple[frozenset[int], ...]
    """Joints of every connected piece."""
    bridges: frozenset[str]
    """Bubbles that belong to no closed ring."""
    contacts: tuple[Contact, ...]

    @property
    def multigraph(self) -> nx.MultiGraph[int]:
        """The same as a networkx multigraph: nodes are joint indices, keys are bubble names."""
        import networkx as nx  # noqa: PLC0415  # slow to import, and a simulation needs none

        graph: nx.MultiGraph[int] = nx.MultiGraph()
        graph.add_nodes_from(range(len(self.joints)))
        for edge in self.edges:
            graph.add_edge(edge.start, edge.end, key=edge.bubble, balloon=edge.balloon)
        return graph

    def degree(self, joint: int) -> int:
        """Return how many bubble ends meet in a joint."""
        return sum((edge.start == joint) + (edge.end == joint) for edge in self.edges)

    def edges_at(self, joint: int) -> tuple[GraphEdge, ...]:
        """Return the bubbles that end in a joint, each once."""
        return tuple(edge for edge in self.edges if joint in {edge.start, edge.end})

    def springs_back(self, joint: int) -> bool:
        """Return whether a joint unwinds when it is let go, because both its bubbles are free to spin."""
        return self.joints[joint].free

    def joint_of(self, end: Joint) -> GraphJoint:
        """Return the joint in which a bubble end lies.

        Raises:
            KeyError: no bubble of this name.
        """
        for edge in self.edges:
            if edge.bubble == end.bubble:
                return self.joints[edge.start if end.end == "start" else edge.end]
        raise KeyError(end.bubble)

    @cached_property
    def odd_joints(self) -> tuple[int, ...]:
        """Joints in which an odd number of bubble ends meet."""
        return tuple(joint.index for joint in self.joints if self.degree(joint.index) % 2)

    @property
    def rings(self) -> int:
        """Number of independent closed rings (first Betti number)."""
        return len(self.edges) - len(self.joints) + len(self.pieces)

    @property
    def fewest_balloons(self) -> int:
        """Fewest balloons that can be twisted into this graph without popping a bubble.

        Half the odd joints of every piece, at least one (Demaine, Demaine & Hart 2008, theorems 1 and 2), and
        two for each tulip that is twisted over another balloon, for it takes the knots of both.
        """
        odd = set(self.odd_joints)
        links = [
            self.joint_of(Joint(c.bubble, "start")).index for c in self.contacts if c.kind == "tulip_link"
        ]
        return sum(
            max(1, len(odd & piece) // 2, 2 * sum(link in piece for link in links)) for piece in self.pieces
        )

    @property
    def one_stroke(self) -> bool:
        """Whether a single balloon could make all of it."""
        return self.fewest_balloons == 1


def sculpture_graph(piece: Workpiece) -> SculptureGraph:
    """Return the graph of what is made of the balloons."""
    free = set(piece.free_joints())
    joints = tuple(
        GraphJoint(index, ends, piece.is_merged(ends), ends in free)
        for index, ends in enumerate(piece.joints)
    )
    index = {end: joint.index for joint in joints for end in joint.ends}
    edges = tuple(
        GraphEdge(b, piece.bubbles[b].balloon, index[Joint(b, "start")], index[Joint(b, "end")])
        for trail in piece.trails
        for b in trail
    )
    ends_of = {edge.bubble: (edge.start, edge.end) for edge in edges}
    pieces = tuple(frozenset(end for b in found for end in ends_of[b]) for found in piece.pieces())
    return SculptureGraph(joints, edges, pieces, piece.bridges(), piece.contacts)
