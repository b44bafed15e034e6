"""`thread`: what is left of a balloon is bent round and pulled through a closed ring of bubbles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.choices import all_of
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.operations import moves
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.passing import LONGEST, Passing, Ring, depth_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Path
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import ContactKind, Workpiece

SHORTEST = 5.8
"""Length below which a bubble cannot be bent round into its ring, in its widths: in simulations of a 260 one
of 30 cm comes into every ring, one of 27 not into a loop of 20.
"""
NARROW = 1.3
"""Depth of a ring below which a tube may get stuck in it, in its widths: a 260 goes through two bubbles of
6 cm and gets stuck between two of 5; two of 3.2 cm of a 160 let one through, and may be torn.
"""
BENDING_SECONDS = 4.0
"""Time in which the tube is bent round before its ring, and straightened behind it, s."""
PULLING_SPEED = 0.12
"""Length of it that is pulled through, over the rest of that time, m/s."""


class ThreadedBubble(Entries):
    """What is pulled through what."""

    bubble: Name
    """What is left of a balloon, beside the ring: its rest, or the bubble that is made of it next."""
    through: Ring
    """The bubbles of the ring: one that closes on itself, or those of a lock."""


class Thread(Passing):
    """Pull what is left of a balloon through a closed ring of bubbles."""

    word: ClassVar[ContactKind] = "thread"
    called: ClassVar[tuple[str, ...]] = ("pull_through",)
    value_model: ClassVar[type[Entries] | None] = ThreadedBubble
    ring_key: ClassVar[str] = "through"
    beyond: ClassVar[float] = math.radians(35.0)
    by_row: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: sword
units: cm
balloons:
  main: {size: 260, color: orange, length: 29, tail: 6}
steps:
  - bubbles: {grip: 8}
  - loop: {guard: 28}
    point: up
  - rest: blade
  - thread: {bubble: blade, through: [guard]}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "ilgreggeribelle.it: the sword",
        "bpmizuki.hatenablog.jp, 9 and 34: the sword, the cat",
        "balloonhq.com: swords",
    )

    thread: ThreadedBubble
    """Pull what is left of a balloon through a closed ring of bubbles."""

    @classmethod
    def piece_with(cls, name: str, place: Place, bench: Workbench) -> Workpiece:
        """Return the workpiece, with what is left of a balloon as its last bubble if the next has a name."""
        return bench.with_next(name, place)

    @classmethod
    def finds(cls, name: str, path: Path, piece: Workpiece, bench: Workbench) -> bool:
        """Say whether a bubble is there, or is made of what is left next, and complain if it is not."""
        if name in piece.bubbles and name not in bench.piece.bubbles:
            return True
        if path[-1] == "bubble" and not bench.find_left(name, path):
            return False
        return super().finds(name, path, piece, bench)

    @classmethod
    def fits(cls, name: str, path: Path, bench: Workbench) -> bool:
        """Say whether a bubble is what is left of a balloon, and complain if it is not."""
        return bench.has_tail(name, path, expected="its rest, or the bubble that is made of it next")

    def misfits(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield a bubble that is too short to be bent round."""
        bubble, length = layout.bubble(self.bubble), self.length(layout)
        if length < (least := SHORTEST * bubble.width):
            what = f"{cm(length)} of a {bubble.size} are too short to be bent round into a ring"
            beside = {ring for name in self.ring for ring in layout.ends(name)}
            alone = self.brought(layout) == (self.bubble,)
            fits = alone and length <= LONGEST * depth_of(layout, self.ring)
            other = ", or push" if fits and layout.ends(self.bubble)[0] in beside else ""
            yield (self.word, "bubble"), f"{what}, expected at least {at_least(least)}{other}"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a ring in which the tube gets stuck."""
        depth, width = depth_of(layout, self.ring), layout.bubble(self.bubble).width
        if depth < (least := NARROW * width):
            yield Caution(
                index,
                f"{self.bubble} may get stuck in {all_of(self.ring)}",
                f"the way round the ring is {cm(2.0 * depth)}, and the tube {cm(width)} wide",
                f"make the way round it at least {at_least(2.0 * least)} long",
            )

    def brought(self, layout: Layout) -> tuple[str, ...]:
        """Return all that is left of the balloon, of which more bubbles may be made later."""
        return layout.onward(self.bubble)

    def hand_seconds(self, length: float) -> float:
        """Return how long a calm maker takes to pull a tube of a length (m) through, s."""
        return BENDING_SECONDS + length / PULLING_SPEED

    def as_moved(self, move: moves.PassThrough, layout: Layout) -> moves.PassThrough:
        """Return the move that pulls it through, given what all such moves have."""
        front = layout.bubble(self.bubble).front
        blown = tuple(ring for ring in move.led if layout.ring(ring).along <= front)
        beyond = move.led[len(blown) :]
        # Of its flat tail the tip alone is led: held at more places, a tube got stuck in a pair of 6 cm.
        led = (*blown, *beyond[-1:])
        end = layout.ends(self.bubble)[1]
        more = 0 if end is None else len(led) - 1 - led.index(end)
        return moves.Thread(**(vars(move) | {"led": led}), flat=len(led) - len(blown), more=more)
