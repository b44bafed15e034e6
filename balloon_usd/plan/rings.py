"""Rings: the places along a balloon that hands can hold, and the joints that they can close."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.language.joint import Joint
from balloon_usd.operations.table import BY_KIND

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.plan.strip import PlannedBubble, Strip

REST_GUIDE = 0.07
"""Inflated distance from its joint at which the last bubble is felt by the friction of that joint, m."""


TIP_GUIDE = 3.0
"""Unstressed distance from the tip at which hands hold the flat tail, in R0."""


@dataclass(frozen=True)
class PlannedRing:
    """One ring of a balloon."""

    balloon: str
    along: float
    """Unstressed distance from the knot, m."""
    joint: bool
    """Whether it can be closed: it parts two bubbles. Other rings only guide."""
    bubble: str
    """Bubble that it ends (joint) or lies in (guide)."""
    name: str
    """As in a recipe: `nose.end`, or `nose.middle` of a guide; `main.knot` of the knot."""


class RingTable:
    """All rings of a sculpture, in order along its balloons, and how to find them by bubble."""

    def __init__(self, strips: Mapping[str, Strip]) -> None:
        self.rings: tuple[PlannedRing, ...] = tuple(
            ring for strip in strips.values() for ring in _rings(strip)
        )
        self._index = {ring.name: k for k, ring in enumerate(self.rings)}
        self._starts = {
            after.name: f"{before.name}.end"
            for strip in strips.values()
            for before, after in zip(strip.bubbles, strip.bubbles[1:], strict=False)
        }
        self._starts.update({strip.bubbles[0].name: f"{name}.knot" for name, strip in strips.items()})
        self._guides: dict[str, tuple[int, ...]] = {}
        for k, ring in enumerate(self.rings):
            if not ring.joint:
                self._guides[ring.bubble] = (*self._guides.get(ring.bubble, ()), k)
        self._last = {strip.bubbles[-1].name for strip in strips.values()}

    def joint(self, end: Joint) -> int | None:
        """Return the ring of a bubble's end, or None for the tip, which has none."""
        if end.end == "start":
            return self._index[self._starts[end.bubble]]
        return None if end.bubble in self._last else self._index[f"{end.bubble}.end"]

    def ends(self, bubble: str) -> tuple[int, int | None]:
        """Return the rings of a bubble's start and end."""
        start = self.joint(Joint(bubble, "start"))
        assert start is not None, "every bubble starts at a ring"
        return start, self.joint(Joint(bubble, "end"))

    def guides(self, bubble: str) -> tuple[int, ...]:
        """Return the guide rings inside a bubble, from its start to its end."""
        return self._guides.get(bubble, ())


def guide_places(strip: Strip) -> tuple[float, ...]:
    """Return the unstressed distances of the rings that only guide from a strip's knot, m."""
    return tuple(ring.along for ring in _rings(strip) if not ring.joint)


def _rings(strip: Strip) -> list[PlannedRing]:
    """Rings of one balloon: its knot, every joint, and guides inside the bubbles."""
    if strip.shape is not None:
        return []
    balloon = strip.balloon
    first = strip.bubbles[0]
    rings = [PlannedRing(balloon, 0.0, True, first.name, f"{balloon}.knot")]
    for bubble in strip.bubbles:
        rings += [
            PlannedRing(
                balloon,
                bubble.rest_start + share * bubble.rest_length,
                False,
                bubble.name,
                f"{bubble.name}.{k}",
            )
            for k, share in enumerate(_guide_shares(bubble, strip))
        ]
        if bubble is not strip.bubbles[-1]:
            rings.append(PlannedRing(balloon, bubble.rest_end, True, bubble.name, f"{bubble.name}.end"))
    return rings


def _guide_shares(bubble: PlannedBubble, strip: Strip) -> tuple[float, ...]:
    if bubble.kind != "rest":
        return BY_KIND[bubble.kind].guides
    stretch = 1.0 if strip.capsule else maxwell_state(strip.rubber).bulged.b
    share = min(REST_GUIDE / stretch / bubble.rest_length, 0.5)
    return share, max(1.0 - TIP_GUIDE * strip.size.radius / bubble.rest_length, 0.5 * (1.0 + share))
