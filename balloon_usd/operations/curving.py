"""What operations share that lead bubbles onto a curve, of which they keep a part."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.modifiers import OnBalloon, Pointed, Timed
from balloon_usd.operations.operation import WorksByBubble

if TYPE_CHECKING:
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workbench import Place, Workbench


class Curves(OnBalloon, Pointed, Timed, WorksByBubble):
    """An operation that leads bubbles onto a curve, each held at the end on which more hangs."""

    once: ClassVar[bool] = False
    """Whether what it curves was straight before, and is curved no more."""

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of bubbles that do not exist by now, or are curved already."""
        for name in cls.uses(value):
            bench.curve(cls.word, name, place, once=cls.once)

    @staticmethod
    def rings_along(layout: Layout, bubble: str) -> tuple[tuple[int, ...], int]:
        """Return the rings of a bubble from start to end, and how many of the last lie on a flat tail."""
        rings = layout.along(bubble)
        return rings, sum(layout.ring(ring).flat for ring in rings)
