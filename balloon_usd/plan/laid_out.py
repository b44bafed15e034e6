"""What operations ask of the balloons that are laid out: their rings and bubbles, by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_theory import bulges_once_stretched
from balloon_usd.plan.nesting import BRINGING_SPEED, hosts_of
from balloon_usd.plan.parking import parked

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.language.joint import Joint
    from balloon_usd.plan.rings import PlannedRing, RingTable
    from balloon_usd.plan.strip import PlannedBubble, Strip


INFLATE_SPEED = 0.38
"""Inflated length blown up per second, m/s: a maker with a hand pump."""
INFLATE_LEAST = 3.0
"""Shortest time in which a tube is blown up, s."""


@dataclass(frozen=True)
class _Placed:
    """A bubble on its strip."""

    strip: Strip
    planned: PlannedBubble

    @property
    def balloon(self) -> str:
        return self.strip.balloon

    @property
    def hollow(self) -> bool:
        return self.planned.hollow

    @property
    def looped(self) -> bool:
        return self.planned.looped

    @property
    def halved(self) -> bool:
        return self.planned.halved

    @property
    def length(self) -> float:
        return self.planned.length

    @property
    def width(self) -> float:
        return self.strip.width_of(self.planned)

    @property
    def size(self) -> str:
        return self.strip.size.name

    @property
    def of_round(self) -> bool:
        return self.strip.is_round

    @property
    def flat_radius(self) -> float:
        return self.strip.size.radius

    @property
    def flat_tail(self) -> float:
        planned = self.planned
        return planned.rest_end - self.strip.rest_place(planned, planned.length)

    @property
    def front(self) -> float:
        return self.planned.front

    @property
    def tip_gives_way(self) -> bool:
        return bulges_once_stretched(self.strip.rubber)

    def rest_place(self, at: float) -> float:
        return self.strip.rest_place(self.planned, at)


class LaidOut:
    """Rings and bubbles of laid strips, as operations ask for them; see `operations.score.Layout`."""

    def __init__(self, strips: Mapping[str, Strip], table: RingTable) -> None:
        self._table, self._strips = table, strips
        self._parked = parked(strips)
        self._joints: dict[str, list[int]] = {name: [] for name in strips}
        for number, ring in enumerate(table.rings):
            if ring.joint:
                self._joints[ring.balloon].append(number)
        self._bubbles = {b.name: _Placed(strip, b) for strip in strips.values() for b in strip.bubbles}

    def ring(self, index: int) -> PlannedRing:
        """Return a ring by its number, in order along the balloons."""
        return self._table.rings[index]

    def bubble(self, name: str) -> _Placed:
        """Return a bubble."""
        return self._bubbles[name]

    def parked(self, balloon: str) -> float:
        """Return how far to the side a balloon lies until it is joined, m."""
        return self._parked[balloon]

    def place(self, ring: int) -> tuple[float, float]:
        """Return where a ring lies on its straight balloon, along it and to the side, m."""
        at = self._table.rings[ring]
        bubble = self._bubbles[at.bubble].planned
        return bubble.start if at.along == 0.0 else bubble.end, self._parked[at.balloon]

    def joint(self, end: Joint) -> int | None:
        """Return the ring of a bubble's end, None for the tip, which has none."""
        return self._table.joint(end)

    def ends(self, bubble: str) -> tuple[int, int | None]:
        """Return the rings of a bubble's start and end."""
        return self._table.ends(bubble)

    def length(self, balloon: str) -> float:
        """Return how long a balloon is when it is blown up and twisted, and straight, m."""
        bubbles = self._strips[balloon].bubbles
        return bubbles[-1].end - bubbles[0].start

    def joints_of(self, balloon: str) -> Sequence[int]:
        """Return the rings of a balloon that can be closed, from its knot on."""
        return self._joints[balloon]

    def pump_seconds(self, balloon: str) -> float:
        """Return how long a maker takes to blow a balloon up, s."""
        shape = self._strips[balloon].shape
        return max(INFLATE_LEAST, self.length(balloon) / INFLATE_SPEED) if shape is None else shape.seconds

    def is_let_down(self, balloon: str) -> bool:
        """Return whether air is let out of a balloon that was blown up farther."""
        return self._strips[balloon].overblown is not None

    def bring_seconds(self, balloon: str) -> float:
        """Return how long hands bring what lies in a balloon to its place, s; 0 where nothing does."""
        guests = (host for host in hosts_of(self._strips).values() if host.balloon == balloon)
        return max((abs(host.way) / BRINGING_SPEED for host in guests), default=0.0)

    def guides(self, bubble: str) -> tuple[int, ...]:
        """Return the guide rings inside a bubble, from its start to its end."""
        return self._table.guides(bubble)

    def onward(self, bubble: str) -> tuple[str, ...]:
        """Return a bubble and those behind it on its balloon, away from the knot."""
        return self._table.onward(bubble)

    def along(self, bubble: str) -> tuple[int, ...]:
        """Return all rings of a bubble, from its start to its end; the tip has none."""
        return self._table.along(bubble)
