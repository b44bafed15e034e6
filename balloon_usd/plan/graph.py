"""The sculpture graph: joints are vertices, bubbles are edges.

A balloon is a trail through the graph from its knot to its tip; locks, loops, folds and ears merge its
joints.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from balloon_usd.language.joint import Joint
from balloon_usd.operations.disjoint_sets import DisjointSets
from balloon_usd.operations.modifiers import Turned
from balloon_usd.plan.connections import Connections

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx

    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

ContactKind = Literal["roll", "push", "tuck", "thread"]


@dataclass(frozen=True)
class GraphJoint:
    """One vertex: every bubble end that meets here."""

    index: int
    ends: tuple[Joint, ...]
    """Bubble ends, in plan order; within a strip the end of one bubble is the start of the next."""
    merged: bool
    """Whether a lock, loop, fold or ear brought several joints together here."""

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
class Contact:
    """Two bubbles held against each other without a common joint."""

    kind: ContactKind
    bubble: str
    other: str


@dataclass(frozen=True)
class SculptureGraph:
    """Joints, bubbles and contacts of a sculpture."""

    joints: tuple[GraphJoint, ...]
    edges: tuple[GraphEdge, ...]
    """In plan order over all balloons."""
    contacts: tuple[Contact, ...] = ()

    @cached_property
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
        """Return whether a joint unwinds when it is let go.

        It does where just two bubbles meet, unmerged, and neither belongs to a closed ring: both are free to
        spin. Within a ring, turning one bubble would have to turn the ring.
        """
        if self.joints[joint].merged or self.degree(joint) != 2:
            return False
        return all(edge.bubble in self.bridges for edge in self.edges_at(joint))

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

    @cached_property
    def _connections(self) -> Connections:
        return Connections(len(self.joints), [(edge.start, edge.end) for edge in self.edges])

    @cached_property
    def pieces(self) -> tuple[frozenset[int], ...]:
        """Joints of every connected piece."""
        return self._connections.pieces

    @property
    def rings(self) -> int:
        """Number of independent closed rings (first Betti number)."""
        return len(self.edges) - len(self.joints) + len(self.pieces)

    @property
    def fewest_balloons(self) -> int:
        """Fewest balloons that can be twisted into this graph without popping a bubble.

        Half the odd joints of every piece, at least one (Demaine, Demaine & Hart 2008, theorems 1 and 2).
        """
        odd = set(self.odd_joints)
        return sum(max(1, len(odd & piece) // 2) for piece in self.pieces)

    @property
    def one_stroke(self) -> bool:
        """Whether a single balloon could make all of it."""
        return self.fewest_balloons == 1

    @cached_property
    def bridges(self) -> frozenset[str]:
        """Bubbles that belong to no closed ring."""
        return frozenset(self.edges[edge].bubble for edge in self._connections.bridges)


def sculpture_graph(
    recipe: Recipe, strips: Mapping[str, Strip], *, least_turns: float = 0.0
) -> SculptureGraph:
    """Return the graph that the steps of a recipe make of its strips, without merging joints with fewer
    turns than `least_turns`.
    """
    bubbles = [bubble for strip in strips.values() for bubble in strip.bubbles]
    groups: DisjointSets[Joint] = DisjointSets()
    for strip in strips.values():
        for before, after in zip(strip.bubbles, strip.bubbles[1:], strict=False):
            groups.merge([Joint(before.name, "end"), Joint(after.name, "start")])
    merged = _merge_steps(recipe, groups, least_turns)
    joints = _joints(bubbles, groups, merged)
    index = {end: joint.index for joint in joints for end in joint.ends}
    edges = tuple(
        GraphEdge(b.name, b.balloon, index[Joint(b.name, "start")], index[Joint(b.name, "end")])
        for b in bubbles
    )
    return SculptureGraph(joints, edges)


def _merge_steps(recipe: Recipe, groups: DisjointSets[Joint], least_turns: float) -> list[Joint]:
    """Merge what the steps merge; return one bubble end of every merged joint."""
    merged: list[Joint] = []
    for step in recipe.steps:
        if isinstance(step, Turned) and step.turns < least_turns:
            continue
        for meeting in step.joined:
            merged.append(meeting[0])
            groups.merge(meeting)
    return merged


def _joints(
    bubbles: list[PlannedBubble], groups: DisjointSets[Joint], merged: list[Joint]
) -> tuple[GraphJoint, ...]:
    members: dict[Joint, list[Joint]] = {}
    for bubble in bubbles:
        for end in (Joint(bubble.name, "start"), Joint(bubble.name, "end")):
            members.setdefault(groups.root(end), []).append(end)
    roots = {groups.root(end) for end in merged}
    return tuple(
        GraphJoint(index, tuple(ends), root in roots) for index, (root, ends) in enumerate(members.items())
    )
