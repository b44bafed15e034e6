"""`press`: a finger presses into a bubble, stays there, and is taken away."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.choices import one_of
from balloon_usd.language.lengths import at_most, cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Force, Length, length_entry, written_length
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.moves import Press as PressMove
from balloon_usd.operations.pressing import Pressing

if TYPE_CHECKING:
    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.layout import PlacedBubble
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

PRESSING = ("depth", "force")
"""Keys that say how a finger presses: exactly one of them."""
PRESS_SECONDS = 1.0
"""Pressing with a finger, holding and releasing, s."""
FAR_FROM_FINGER = 1.0 / 3.0
"""Share of a pressed bubble's length beyond which the other hand holds its ends."""


class PressedBubble(Entries):
    """What a finger presses: a bubble, the place on it, and how deep or how hard."""

    bubble: Name
    """The bubble that is pressed."""
    at: Length | None = None
    """Distance from the bubble's start along the inflated bubble; its middle when absent; m in Python."""
    depth: Length | None = None
    """How deep the finger goes; m in Python."""
    force: Force | None = None
    """How hard it presses, instead of depth; N."""


class Press(Pressing):
    """Press a finger into a bubble, hold it there, and take it away."""

    word: ClassVar[str] = "press"
    called: ClassVar[tuple[str, ...]] = ("dent", "poke")
    value_model: ClassVar[type[Entries] | None] = PressedBubble
    example: ClassVar[str] = """\
format: 1
name: dented
units: cm
balloons:
  main: {size: 260, color: blue, length: 11, tail: 5}
steps:
  - press: {bubble: main_rest, depth: 2.5}
    point: down
"""
    sources: ClassVar[tuple[str, ...]] = ("Kosaka 2008, 4.2.2: a force from above",)

    press: PressedBubble
    """Press a finger into a bubble, hold it there, and take it away."""

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        press = self.press
        lengths = {"at": press.at, "depth": press.depth}
        entries: dict[str, object] = {"bubble": press.bubble}
        entries |= {key: length_entry(length, units) for key, length in lengths.items() if length is not None}
        return entries if press.force is None else entries | {"force": press.force}

    @classmethod
    def value_of(
        cls,
        units: Units,
        /,
        bubble: str,
        *,
        at: LengthLike | None = None,
        depth: LengthLike | None = None,
        force: float | str | None = None,
    ) -> object:
        """Return its value as it stands in a file: at a distance from the bubble's start, a depth or N."""
        lengths = {"at": at, "depth": depth}
        value: dict[str, object] = {"bubble": bubble}
        value |= {key: written_length(it, units) for key, it in lengths.items() if it is not None}
        return value if force is None else value | {"force": force}

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of a bubble that does not exist by now, and unless it is told how hard or how deep."""
        super().check(value, place, bench)
        if not isinstance(value, dict):
            return
        path = (*place.path, cls.word)
        given = [key for key in PRESSING if key in value]
        if not given:
            bench.complain(path, f"does not say how deep or how hard, expected {one_of(PRESSING)}")
        elif len(given) > 1:
            what = f"stands beside {given[0]}, expected exactly {one_of(PRESSING)}"
            bench.complain((*path, given[1]), what)

    def perform(self, score: Score, index: int) -> None:
        """Press, while the other hand holds the ends that are far from the finger."""
        press, bubble = self.press, score.layout.bubble(self.press.bubble)
        self._require_inside(score, bubble, index)
        at = 0.5 * bubble.length if press.at is None else press.at
        start, end = score.layout.ends(press.bubble)
        far_end = score.layout.guides(press.bubble)[-1] if end is None else end
        ends = ((start, at), (far_end, bubble.length - at))
        move = PressMove(
            score.now,
            PRESS_SECONDS if self.seconds is None else self.seconds,
            index,
            f"press: {press.bubble}",
            balloon=bubble.balloon,
            along=bubble.rest_place(at),
            point=score.towards(self.point or "down"),
            force=press.force or 0.0,
            depth=press.depth or 0.0,
            holds=tuple(ring for ring, away in ends if away > FAR_FROM_FINGER * bubble.length),
        )
        self.press_and_let_go(score, move)

    def _require_inside(self, score: Score, bubble: PlacedBubble, index: int) -> None:
        """Refuse a finger beside the bubble, or one that would come out at its other side."""
        press = self.press
        told: dict[tuple[str, ...], str] = {}
        if press.at is not None and press.at >= bubble.length:
            text = (
                f"{cm(press.at)} does not lie inside {press.bubble}, "
                f"expected less than {at_most(bubble.length)}"
            )
            told[self.word, "at"] = text
        if press.depth is not None and press.depth >= bubble.width:
            text = (
                f"{cm(press.depth)} goes through a {bubble.size}, expected less than {at_most(bubble.width)}"
            )
            told[self.word, "depth"] = text
        if told:
            score.refuse(index, told)
