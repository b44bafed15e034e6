"""Rings: the places along a balloon that hands can hold, and the joints that they can close."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_mesh import last_ring
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.language.joint import Joint
from balloon_usd.operations.table import BY_KIND

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from balloon_usd.plan.strip import PlannedBubble, Strip

REST_GUIDE = 0.07
"""Inflated distance from its joint at which the last bubble is felt by the friction of that joint, m."""

SLENDER = 0.25
"""Radius of a bubble, in its lengths, below which it is bent by more than its middle."""
LEAST_APART = 0.5
"""Least unstressed distance of two places at which hands hold a bubble, in R0: rings stand two thirds of that
apart beside joints in the coarsest mesh.
"""
ROUND_GUIDES = (0.5, 0.75)
"""Where hands hold a round balloon, as shares of its wall: near its widest ring, and at its last one before
the tip. Swung by the first alone, three balls of nine did not come into their rings.
"""
WIDEST_LOBE = 0.65
"""Where hands hold what twists leave of one besides its last ring, as a share of the wall up to that."""
BEYOND_FRONT = 0.3
"""Flat rubber that hands hold as they hold a tube that they wind, in that of the tube."""
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
    flat: bool = False
    """Whether it lies on the flat tail that is left."""


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
        rows = [tuple(bubble.name for bubble in strip.bubbles) for strip in strips.values()]
        self._onward = {row[at]: row[at:] for row in rows for at in range(len(row))}

    def joint(self, end: Joint) -> int | None:
        """Return the ring of a bubble's end, or None for the tip, which has none."""
        if end.end == "start":
            return self._index[self._starts[end.bubble]]
        return None if self._onward[end.bubble] == (end.bubble,) else self._index[f"{end.bubble}.end"]

    def ends(self, bubble: str) -> tuple[int, int | None]:
        """Return the rings of a bubble's start and end."""
        start = self.joint(Joint(bubble, "start"))
        assert start is not None, "every bubble starts at a ring"
        return start, self.joint(Joint(bubble, "end"))

    def guides(self, bubble: str) -> tuple[int, ...]:
        """Return the guide rings inside a bubble, from its start to its end."""
        return self._guides.get(bubble, ())

    def onward(self, bubble: str) -> tuple[str, ...]:
        """Return a bubble and those behind it on its balloon, away from the knot."""
        return self._onward[bubble]

    def along(self, bubble: str) -> tuple[int, ...]:
        """Return all rings of a bubble, from its start to its end; the tip has none."""
        start, end = self.ends(bubble)
        return (start, *self.guides(bubble), *(() if end is None else (end,)))


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
    fronts_led = _fronts_led(strip)
    for bubble in strip.bubbles:
        rings += [
            PlannedRing(
                balloon,
                bubble.rest_start + share * bubble.rest_length,
                False,
                bubble.name,
                f"{bubble.name}.{k}",
                flat=_beyond_front(bubble, strip, share),
            )
            for k, share in enumerate(_guide_shares(bubble, strip, fronts_led))
        ]
        if bubble is not strip.bubbles[-1]:
            rings.append(PlannedRing(balloon, bubble.rest_end, True, bubble.name, f"{bubble.name}.end"))
    return rings


def _guide_shares(bubble: PlannedBubble, strip: Strip, fronts_led: Sequence[float]) -> tuple[float, ...]:
    apart = LEAST_APART * strip.size.radius / bubble.rest_length
    inside = (front for front in fronts_led if bubble.rest_start < front < bubble.rest_end)
    fronts = [(front - bubble.rest_start) / bubble.rest_length for front in inside]
    if bubble.kind != "rest":
        own = BY_KIND[bubble.kind].guides
        round_end = strip.inflated_radius / bubble.length
        # Their places alone tell the directions of a bent bubble's ends.
        ends = (round_end, 1.0 - round_end) if bubble.bent and round_end < SLENDER else ()
        evenly = [k / (bubble.places + 1) for k in range(1, bubble.places + 1)]
        return tuple(sorted([*own, *_parted([*ends, *evenly, *fronts], apart, 1.0 - apart, own)]))
    if strip.is_round:
        return _round_guides(bubble, strip)
    stretch = 1.0 if strip.capsule else maxwell_state(strip.rubber).bulged.b
    share = min(REST_GUIDE / stretch / bubble.rest_length, 0.5)
    tip = max(1.0 - TIP_GUIDE * strip.size.radius / bubble.rest_length, 0.5 * (1.0 + share))
    shares = (*_along_the_bend(bubble, strip, tip), tip) if bubble.bent else (share, tip)
    # Behind the last ring of the tube comes the round tip.
    last = 1.0 - strip.size.radius / bubble.rest_length
    return tuple(_parted((*shares, *fronts), apart, last)) or (0.5,)


def _round_guides(bubble: PlannedBubble, strip: Strip) -> tuple[float, ...]:
    if bubble.rest_start == 0.0:
        return ROUND_GUIDES
    last = (last_ring(strip.size, bubble.rest_start) - bubble.rest_start) / bubble.rest_length
    return WIDEST_LOBE * last, last


def _fronts_led(strip: Strip) -> list[float]:
    """Return the unstressed distances from the knot (m) of the round ends of a tube that hands lead by them
    before more is made of it.
    """
    led = [bubble.front for bubble in strip.bubbles[:-1] if bubble.leads]
    if not led:
        return []
    round_end = strip.inflated_radius / maxwell_state(strip.rubber).bulged.b
    return [front - round_end for front in led]


def _parted(shares: Iterable[float], apart: float, last: float, others: Iterable[float] = ()) -> list[float]:
    """Return those of some places, in order, that lie at least so far from each other, from others and from
    the start, and not beyond a last one: each has a ring of its own, so near ones would take many rings.
    """
    kept: list[float] = []
    for share in sorted(shares):
        if apart <= share <= last and all(abs(share - each) >= apart for each in (*others, *kept)):
            kept.append(share)
    return kept


def _along_the_bend(bubble: PlannedBubble, strip: Strip, tip: float) -> list[float]:
    """Shares of the rubber of a last bubble at which hands hold it to bend it, up to where it is round."""
    until = max(bubble.length - strip.inflated_radius, 0.5 * bubble.length)
    front = min((strip.rest_place(bubble, until) - bubble.rest_start) / bubble.rest_length, 0.5 * (1.0 + tip))
    count = max(2, math.ceil(until / REST_GUIDE), bubble.places)
    shares = [front * k / count for k in range(1, count + 1)]
    if bubble.places:
        # Where a tube is wound tight, gas goes on into its flat tail.
        beyond = (front * k / count for k in range(count + 1, math.ceil((1.0 + BEYOND_FRONT) * count) + 1))
        shares += [share for share in beyond if share < tip]
    return shares


def _beyond_front(bubble: PlannedBubble, strip: Strip, share: float) -> bool:
    """Whether a share of a bubble's rubber lies on the flat tail."""
    if bubble.kind != "rest" or not strip.has_tail:
        return False
    return share * bubble.rest_length > strip.rest_place(bubble, bubble.length) - bubble.rest_start
