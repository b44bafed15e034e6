"""What holds when the hands let go for good, and what comes undone.

A lock holds by the friction of its wound necks, which grows with every turn (capstan); of too few turns it
slips. A joint that no lock and no ring holds untwists. Until the last step is done makers hold what they have
made, also while they wait, so nothing comes undone before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.plan.graph import sculpture_graph

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.language.joint import Joint
    from balloon_usd.plan.graph import SculptureGraph
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

HOLDING_TURNS = 2.0
"""Turns below which a twist unwinds: makers advise 2 to 4, three as a rule."""


@dataclass(frozen=True)
class LooseJoint:
    """A joint that untwists once it is let go."""

    end: Joint
    """The joint as the end of the bubble before it."""
    beyond: frozenset[str]
    """Bubbles that turn with what lies beyond it, all those that hang together there."""
    before: frozenset[str]
    """Bubbles that turn with what lies before it."""


@dataclass(frozen=True)
class Holding:
    """What the friction of locks and the rings that they close hold, of a finished sculpture."""

    graph: SculptureGraph
    """The sculpture without the locks that slip."""
    loose: tuple[LooseJoint, ...]
    """Joints that untwist, in plan order."""


def holding_of(recipe: Recipe, strips: Mapping[str, Strip]) -> Holding:
    """Return what holds a sculpture when the hands let go."""
    graph = sculpture_graph(recipe, strips, least_turns=HOLDING_TURNS)
    loose = [_loose(graph, joint.index) for joint in graph.joints if graph.springs_back(joint.index)]
    return Holding(graph, tuple(loose))


def _loose(graph: SculptureGraph, joint: int) -> LooseJoint:
    """Part a sculpture at a joint of two bubbles."""
    before, after = graph.joints[joint].ends
    return LooseJoint(before, _side(graph, joint, after.bubble), _side(graph, joint, before.bubble))


def _side(graph: SculptureGraph, joint: int, first: str) -> frozenset[str]:
    """Return a bubble at a joint and all that hang together with it without that joint."""
    found, joints = {first}, {joint}
    fresh = [edge for edge in graph.edges if edge.bubble == first]
    while fresh:
        reached = {end for edge in fresh for end in (edge.start, edge.end)} - joints
        joints |= reached
        fresh = [e for e in graph.edges if e.bubble not in found and reached & {e.start, e.end}]
        found |= {edge.bubble for edge in fresh}
    return frozenset(found)
