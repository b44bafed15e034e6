"""`tail_ball`: the end of the flat tail is stretched, gives way to the gas, and becomes a ball."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.operations.modifiers import OnBalloon
from balloon_usd.operations.moves import Move, StretchTip
from balloon_usd.operations.operation import Lengths, LengthsByBubble, WorksByBubble
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

STRETCH_SECONDS = 1.0
"""Time in which the tip is stretched and becomes a ball, s."""
SHORTEST = 5.4
"""Least flat rubber at the tip that gives way to the pressure of the tube, in R0: in simulations of a 260
22 mm do, 20 do not.
"""
BETWEEN = 2.5
"""Flat rubber that keeps the ball off the tube, in R0."""


class TailBall(OnBalloon, WorksByBubble, LengthsByBubble):
    """Stretch the end of the flat tail, until it gives way to the gas and becomes a ball."""

    word: ClassVar[str] = "tail_ball"
    called: ClassVar[tuple[str, ...]] = ("poodle_tail",)
    example: ClassVar[str] = """\
format: 1
name: pompom
units: cm
balloons:
  main: {size: 260, color: white, length: 18, tail: 10}
steps:
  - bubbles: {body: 8, left_leg: 5, right_leg: 5}
  - lock: [left_leg, right_leg]
    point: down
  - rest: tail
  - tail_ball: {tail: 2.5}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonhq.com: Twists 101, the poodle's tail",
        "mbfloyd.com: Different twists",
        "isopresso.web.fc2.com: the poodle",
    )

    tail_ball: Lengths
    """Stretch so much flat rubber at the tip, until it gives way to the gas and becomes a ball."""

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of what is not what is left of a balloon."""
        for name in cls.uses(value):
            bench.tip(name, place, (*place.path, cls.word, name))

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield tips that are too short to give way, or longer than the flat tail that is left."""
        for name, stretched in self.tail_ball.items():
            bubble = layout.bubble(name)
            apart, least = BETWEEN * bubble.flat_radius, SHORTEST * bubble.flat_radius
            most = bubble.flat_tail - apart
            if not bubble.tip_gives_way:
                text = (
                    "its rubber stays too hard where it has been stretched, and does not give way to the gas"
                )
                yield (self.word, name), f"{text}, expected rubber: ogden or gent, and softening"
            elif most < least:
                text = f"only {cm(max(bubble.flat_tail, 0.0))} of flat tail are left of {name}"
                text += f", expected {at_least(least + apart)} of it or more: a longer tail"
                yield (self.word, name), f"{text} of {bubble.balloon}"
            elif not least <= stretched <= most:
                text = f"{cm(stretched)} of flat rubber make no ball at this tip"
                yield (self.word, name), f"{text}, expected {at_least(least)} to {at_most(most)}"

    def perform(self, score: Score, index: int) -> None:
        """Stretch each tip, and wait while the gas finds its way."""
        for name, stretched in self.tail_ball.items():
            text = f"tail ball: {name}"
            score.add(StretchTip(score.now, STRETCH_SECONDS, index, text, bubble=name, length=stretched))
            score.add(Move(score.now, SETTLE_SECONDS, index, text))
        score.let_go(index)
