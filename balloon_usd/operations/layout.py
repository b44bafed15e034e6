"""Where the bubbles and joints of a recipe lie on their balloons, as far as operations ask."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.language.joint import Joint


class Ring(Protocol):
    """A place along a balloon that hands can hold."""

    @property
    def balloon(self) -> str:
        """Its balloon."""

    @property
    def along(self) -> float:
        """Unstressed distance from the knot, m."""

    @property
    def joint(self) -> bool:
        """Whether it can be closed."""

    @property
    def bubble(self) -> str:
        """Bubble that it ends or lies in."""

    @property
    def flat(self) -> bool:
        """Whether it lies on the flat tail that is left."""


class PlacedBubble(Protocol):
    """A bubble on its balloon."""

    @property
    def balloon(self) -> str:
        """Its balloon."""

    @property
    def hollow(self) -> bool:
        """Whether it has a hole once its two ends are one, if it is long enough: no ear and no tulip has."""

    @property
    def looped(self) -> bool:
        """Whether it is made a loop or a fold: its two ends are one, and it is long enough to be no ball."""

    @property
    def halved(self) -> bool:
        """Whether its two halves lie side by side, as those of a fold."""

    @property
    def length(self) -> float:
        """Inflated length, m."""

    @property
    def width(self) -> float:
        """Diameter of its balloon, m."""

    @property
    def size(self) -> str:
        """Name of the size of its balloon."""

    @property
    def of_round(self) -> bool:
        """Whether its balloon is a round one."""

    @property
    def flat_radius(self) -> float:
        """Radius of its balloon before it is blown up, m."""

    @property
    def flat_tail(self) -> float:
        """Flat rubber that its gas does not fill, m: of what is left of a tube, its tail."""

    @property
    def front(self) -> float:
        """Unstressed distance of the gas's end from the knot before it is twisted off, m."""

    @property
    def tip_gives_way(self) -> bool:
        """Whether the tip of its balloon, once stretched, bulges at the pressure of the tube."""

    def rest_place(self, at: float) -> float:
        """Return the unstressed distance from the knot (m) of a place in the bubble (m, inflated)."""


class Layout(Protocol):
    """Rings and bubbles of a sculpture, by name."""

    def ring(self, index: int) -> Ring:
        """Return a ring by its number, in order along the balloons."""

    def bubble(self, name: str) -> PlacedBubble:
        """Return a bubble."""

    def parked(self, balloon: str) -> float:
        """Return how far to the side a balloon lies until it is joined, m."""

    def place(self, ring: int) -> tuple[float, float]:
        """Return where a ring lies on its straight balloon, along it and to the side, m."""

    def joint(self, end: Joint) -> int | None:
        """Return the ring of a bubble's end, None for the tip, which has none."""

    def ends(self, bubble: str) -> tuple[int, int | None]:
        """Return the rings of a bubble's start and end."""

    def length(self, balloon: str) -> float:
        """Return how long a balloon is when it is blown up and twisted, and straight, m."""

    def joints_of(self, balloon: str) -> Sequence[int]:
        """Return the rings of a balloon that can be closed, from its knot on."""

    def pump_seconds(self, balloon: str) -> float:
        """Return how long a maker takes to blow a balloon up, s."""

    def is_let_down(self, balloon: str) -> bool:
        """Return whether air is let out of a balloon that was blown up farther."""

    def bring_seconds(self, balloon: str) -> float:
        """Return how long hands bring what lies in a balloon to its place, s; 0 where nothing does."""

    def guides(self, bubble: str) -> tuple[int, ...]:
        """Return the guide rings inside a bubble, from its start to its end."""

    def onward(self, bubble: str) -> tuple[str, ...]:
        """Return a bubble and those behind it on its balloon, away from the knot."""

    def along(self, bubble: str) -> tuple[int, ...]:
        """Return all rings of a bubble, from its start to its end; the tip has none."""
