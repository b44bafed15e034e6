"""`push`: a finger presses into a bubble, stays there, and is taken away."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.choices import one_of
from balloon_usd.language.lengths import cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Force, Length, length_entry
from balloon_usd.operations.modifiers import Entries, OnBalloon, Pointed, Timed
from balloon_usd.operations.moves import POINTS, Move
from balloon_usd.operations.moves import Push as PushMove
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from balloon_usd.operations.score import PlacedBubble, Score
    from balloon_usd.operations.workbench import Place, Workbench

PRESSING = ("depth", "force")
"""Keys that say how a finger pushes: exactly one of them."""
PUSH_SECONDS = 1.0
"""Pressing with a finger, holding and releasing, s."""
FAR_FROM_FINGER = 1.0 / 3.0
"""Share of a pushed bubble's length beyond which the other hand holds its ends."""


class PushedBubble(Entries):
    """What a finger pushes: a bubble, the place on it, and how deep or how hard."""

    bubble: Name
    """The bubble that is pushed."""
    at: Length | None = None
    """Distance from the bubble's start along the inflated bubble; its middle when absent; m in Python."""
    depth: Length | None = None
    """How deep the finger goes; m in Python."""
    force: Force | None = None
    """How hard it pushes, instead of depth; N."""


class Push(OnBalloon, Pointed, Timed, Operation):
    """Push a finger into a bubble, hold it there, and take it away."""

    word: ClassVar[str] = "push"
    value_model: ClassVar[type[Entries] | None] = PushedBubble
    keeps_time: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: pressed
units: cm
balloons:
  main: {size: 260, color: blue, tail: 10}
steps:
  - bubbles: {a: 10}
  - push: {bubble: a, depth: 1.5}
    point: down
  - rest: b
"""

    push: PushedBubble
    """Push a finger into a bubble, hold it there, and take it away."""

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that is pushed."""
        return (self.push.bubble,)

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        push = self.push
        lengths = {"at": push.at, "depth": push.depth}
        entries: dict[str, object] = {"bubble": push.bubble}
        entries |= {key: length_entry(length, units) for key, length in lengths.items() if length is not None}
        return entries if push.force is None else entries | {"force": push.force}

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is pushed."""
        bubble = value.get("bubble") if isinstance(value, dict) else None
        return (bubble,) if isinstance(bubble, str) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of a bubble that does not exist by now, and unless it is told how hard or how deep."""
        path = (*place.path, cls.word)
        for bubble in cls.uses(value):
            bench.find_whole(bubble, place, (*path, "bubble"))
        if not isinstance(value, dict):
            return
        given = [key for key in PRESSING if key in value]
        if not given:
            bench.complain(path, f"does not say how deep or how hard, expected {one_of(PRESSING)}")
        elif len(given) > 1:
            what = f"stands beside {given[0]}, expected exactly {one_of(PRESSING)}"
            bench.complain((*path, given[1]), what)

    def perform(self, score: Score, index: int) -> None:
        """Press, while the other hand holds the ends that are far from the finger."""
        push, bubble = self.push, score.layout.bubble(self.push.bubble)
        self._require_inside(score, bubble, index)
        at = 0.5 * bubble.length if push.at is None else push.at
        start, end = score.layout.ends(push.bubble)
        far_end = score.layout.guides(push.bubble)[-1] if end is None else end
        ends = ((start, at), (far_end, bubble.length - at))
        move = PushMove(
            score.now,
            PUSH_SECONDS if self.seconds is None else self.seconds,
            index,
            f"push: {push.bubble}",
            balloon=bubble.balloon,
            along=bubble.rest_place(at),
            point=POINTS[self.point or "down"],
            force=push.force or 0.0,
            depth=push.depth or 0.0,
            holds=tuple(ring for ring, away in ends if away > FAR_FROM_FINGER * bubble.length),
        )
        score.add(move)
        score.add(Move(score.now, 2.0 * SETTLE_SECONDS, index, move.text))
        score.let_go(index)

    def _require_inside(self, score: Score, bubble: PlacedBubble, index: int) -> None:
        """Refuse a finger beside the bubble, or one that would come out at its other side."""
        push = self.push
        told: dict[tuple[str, ...], str] = {}
        if push.at is not None and push.at >= bubble.length:
            text = f"{cm(push.at)} does not lie inside {push.bubble}, expected less than {cm(bubble.length)}"
            told[self.word, "at"] = text
        if push.depth is not None and push.depth >= bubble.width:
            text = f"{cm(push.depth)} goes through a {bubble.size}, expected less than {cm(bubble.width)}"
            told[self.word, "depth"] = text
        if told:
            score.refuse(index, told)
