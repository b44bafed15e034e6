"""The strip: one balloon as a row of bubbles, inflated and flat."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.balloon.bubble_shape import pinch_length, shortest_stable_bubble
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.operations.table import BY_KIND
from balloon_usd.plan.necks import wall_place
from balloon_usd.plan.open_tube import Twisted, softened

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.operations.operation import BubbleKind
    from balloon_usd.plan.shaped import Shaped


ALL = math.inf
"""Length of a bubble that takes all the gas that is left."""


class Made(NamedTuple):
    """A bubble that a step of the recipe makes."""

    step: int
    """Index of the step; of an unnamed rest, the number of steps."""
    kind: BubbleKind
    bubble: str
    length: float
    """Inflated length, m; `ALL` of a rest whose end is tied."""
    gas: float = 1.0
    """Share of the gas of that length that hands leave in it."""
    drawn: float = 0.0
    """Unstressed rubber that its turns draw into the neck behind it, m; only of tubes."""
    slack: float = 1.0
    """Rubber that hands gather for it, in that of a firm bubble of its length; only of tubes."""

    @property
    def twisted(self) -> Twisted:
        """What it takes of a tube."""
        return Twisted(self.length, self.gas, self.drawn, self.slack)


@dataclass(frozen=True)
class PlannedBubble:
    """One bubble of a strip. Positions are distances from the knot."""

    name: str
    balloon: str
    kind: BubbleKind
    length: float
    """Inflated length, m."""
    start: float
    """Start along the finished strip, m."""
    end: float
    """End along the finished strip, m."""
    rest_start: float
    """Start along the flat tube, or along a capsule before it is twisted, m."""
    rest_end: float
    """End along the same, m; of the last bubble the tip, so its flat tail is included."""
    volume: float
    """Gas, m3, at the pressure at which it is twisted off; in a capsule what its wall holds before."""
    step: int
    """Index of the step that makes it; of an unnamed rest, the number of steps."""
    pressure: float | None = None
    """Gauge pressure at which it is twisted off, Pa; only of bubbles of tubes."""
    bent: bool = False
    """Whether a step bends it: hands then hold it at more places."""
    places: int = 0
    """At how many places more, evenly, hands hold it; 0 of what is not wound round others."""
    gas: float = 1.0
    """Share of the gas of its length that hands leave in it: below 1 of a soft one."""
    drawn: tuple[float, float] = (0.0, 0.0)
    """Unstressed rubber that turns draw in all into the necks before and behind it, half of it from it, m."""
    slack: float = 1.0
    """Rubber that hands gather for it, in that of a firm bubble of its length."""
    front: float = 0.0
    """Unstressed distance of the gas's end from the knot before it is twisted off, m; only of tubes."""
    leads: bool = False
    """Whether hands lead all that is left of its balloon before it is twisted off."""
    width: float | None = None
    """Width of what a twist makes of a round balloon, m; None of others, which are as wide as theirs."""
    tears: bool = False
    """Whether it is popped, and both its ends hang on something: its wall tears in the middle."""

    @property
    def twisted(self) -> Twisted:
        """What it takes of a tube."""
        return Twisted(self.length, self.gas, self.drawn[1], self.slack)

    @property
    def hollow(self) -> bool:
        """Whether it has a hole once its two ends are one, if it is long enough: no ear and no tulip has."""
        maker = BY_KIND.get(self.kind)
        return maker is None or maker.hollow or not maker.closes

    @property
    def looped(self) -> bool:
        """Whether it is made a loop or a fold: its two ends are one, and it is long enough to be no ball."""
        maker = BY_KIND.get(self.kind)
        return maker is not None and maker.hollow

    @property
    def halved(self) -> bool:
        """Whether its two halves lie side by side, as those of a fold."""
        maker = BY_KIND.get(self.kind)
        return maker is not None and maker.folds

    @property
    def rest_length(self) -> float:
        """Length of its rubber, m: unstressed, or in a capsule before it is twisted."""
        return self.rest_end - self.rest_start

    @property
    def wall_length(self) -> float:
        """The same without what turns draw into its necks, m."""
        return self.rest_length - 0.5 * sum(self.drawn)


class BlownRound(NamedTuple):
    """A round balloon or a heart that is blown up, before anything of it is twisted off."""

    width: float
    """m."""
    height: float
    """m."""
    volume: float
    """Gas, m3."""
    pressure: float
    """Gauge, Pa."""
    before: BlownRound | None = None
    """What it was blown up to before air was let out; None where none was."""

    @property
    def most(self) -> BlownRound:
        """The same while it is blown up farthest."""
        return self.before or self


@dataclass(frozen=True)
class Strip:
    """One balloon of a plan."""

    balloon: str
    size: BalloonSize
    """Size with the recipe's own dimensions."""
    rubber: Rubber
    """Law of the rubber, softened or not as the recipe says."""
    tail: float
    """Flat rubber left empty when the balloon is blown up, m."""
    bubbles: tuple[PlannedBubble, ...]
    """From the knot to the tip; the last one owns all remaining rubber."""
    capsule: bool = False
    """Whether it is a closed capsule: it has no flat phase, and what is flat of a tube is, of a capsule, its
    wall before it is twisted.
    """
    inside: str | None = None
    """Bubble of another balloon in which it lies; None where it lies in none."""
    shape: Shaped | None = None
    """What a balloon from a mesh file is; None of others. Its size is that of a ball of the same wall."""

    blown: BlownRound | None = None
    """What a round balloon or a heart is blown up to; None of others."""

    @property
    def has_tail(self) -> bool:
        """Whether it is a tube, of which twists use up a flat tail."""
        return not self.capsule and self.shape is None and not self.is_round

    @property
    def is_round(self) -> bool:
        """Whether it is a round balloon or a heart."""
        return self.blown is not None

    @property
    def width(self) -> float | None:
        """Width to which a round balloon is blown up, m; None of others."""
        return None if self.blown is None else self.blown.width

    @property
    def overblown(self) -> float | None:
        """Width to which a round balloon is blown up before air is let out, m; None where none is."""
        return None if self.blown is None or self.blown.before is None else self.blown.before.width

    @property
    def tip_is_tied(self) -> bool:
        """Whether the last bubble is the flat tip of a tube, which is tied to a joint: it holds no gas."""
        return self.bubbles[-1].length == 0.0

    @property
    def inverted(self) -> bool:
        """Whether its knot is pressed through its first bubble, the wall of which it turns inside."""
        operation = BY_KIND.get(self.bubbles[0].kind)
        return operation is not None and operation.inverts

    @property
    def inflated_radius(self) -> float:
        """Radius of the blown-up balloon, m."""
        if self.blown is not None:
            return 0.5 * self.blown.width
        return self.size.radius * maxwell_state(self.rubber).bulged.a

    @property
    def full_length(self) -> float:
        """Length of a balloon of this kind that is blown up without tail, m."""
        return self.size.length * maxwell_state(self.rubber).bulged.b

    @property
    def capsule_length(self) -> float:
        """Length of a capsule before it is twisted, m."""
        return self.bubbles[-1].rest_end

    def balls(self, longest: float = 1.0) -> dict[int, float]:
        """Return the inflated lengths (m) of the bubbles that are no longer than so many times the shortest
        stable one, by their number: those are told by their length, not by their rubber.
        """
        if not self.has_tail or len(self.bubbles) < 2:
            return {}
        most = longest * shortest_stable_bubble(self.size, softened(self.rubber)).length
        return {k: bubble.length for k, bubble in enumerate(self.bubbles[:-1]) if bubble.length < most}

    def width_of(self, bubble: PlannedBubble) -> float:
        """Return how wide a bubble is, m: as its balloon, but for what is twisted off a round one."""
        return 2.0 * self.inflated_radius if bubble.width is None else bubble.width

    def bubble_at(self, along: float) -> PlannedBubble:
        """Return the bubble that owns the rubber at an unstressed distance from the knot (m)."""
        return next((bubble for bubble in self.bubbles if along <= bubble.rest_end), self.bubbles[-1])

    def rest_place(self, bubble: PlannedBubble, at: float) -> float:
        """Return the unstressed distance from the knot (m) of a place at some distance (m) from a bubble's
        start.
        """
        last = bubble is self.bubbles[-1]
        if bubble.length == 0.0:
            return bubble.rest_start
        if self.capsule:
            necks = (bubble is not self.bubbles[0], not last)
            return bubble.rest_start + wall_place(at, bubble.length, self.inflated_radius, necks)
        taken = bubble.rest_length
        if last and self.has_tail:
            # One end of it is rounded; what it does not fill is flat tail.
            tube = bubble.length + 0.5 * pinch_length(self.size, softened(self.rubber))
            taken = min(taken, tube / maxwell_state(self.rubber).bulged.b)
        return bubble.rest_start + taken * at / bubble.length
