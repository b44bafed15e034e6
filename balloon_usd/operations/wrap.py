"""`wrap`: a bubble is laid round the neck of another, and its two ends are twisted together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from balloon_usd.language.joint import Joint, JointEntry, ends_of, joint
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.operations import moves
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.closing import too_round
from balloon_usd.operations.modifiers import Entries, OnBalloon, Pointed, Timed, Turned
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import GATHER_LEAST, HAND_SPEED, SETTLE_SECONDS, folded
from balloon_usd.operations.workpiece import ContactKind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

PLACES = 7
"""At how many places hands hold the bubble that is laid round, as a loop."""
PLACES_OF_ROW = 3
"""At how many places hands hold each bubble of the row that is laid back."""
REACH = 0.5
"""Length of the row that is laid back below which its end does not reach the hole, in that of the bubble that
is laid round it.
"""
SMALL = 0.45
"""Length of a ball below which it may slip out again, in widths of the tube: 1.8 cm of a 260 did."""
LAYING_SPEED = 0.06
"""Speed at which hands lay the row back, m/s."""
SWINGING_SPEED = 0.5
"""Speed of the far end of what hangs on the row, and is swung round with it, in the mean of the step, m/s: a
tube of a metre moved at 5 m/s where only the row was counted.
"""


class WrappedBubble(Entries):
    """What is laid round what."""

    bubble: Name
    """The bubble that is laid round, and whose two ends become one."""
    neck: JointEntry
    """The joint at which it lies then: the start of a bubble that hangs on its end by a row of others."""
    looks: Literal["forward", "back"] = "forward"
    """To which side the bubble behind that joint comes out: to what is made first, or away from it."""


class Wrap(OnBalloon, Pointed, Turned, Timed, Operation):
    """Lay a bubble round the neck of another behind it, and twist its two ends together."""

    word: ClassVar[ContactKind] = "wrap"
    value_model: ClassVar[type[Entries] | None] = WrappedBubble
    example: ClassVar[str] = """\
format: 1
name: muzzle
units: cm
balloons:
  main: {size: 260, color: orange, length: 8.6, tail: 3.5}
steps:
  - bubbles: {throat: 8}
  - bubbles: {muzzle: 9}
    burp: 40 %
  - bubbles: {behind: 9}
  - rest: nose
  - wrap: {bubble: muzzle, neck: nose.start}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonotherapy.blogspot.com 2015-04: the nose in the muzzle of a teddy bear",
    )

    wrap: WrappedBubble
    """Lay a bubble round the neck of another behind it, and twist its two ends together."""

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that is laid round, and the one behind the neck."""
        return self.wrap.bubble, self.wrap.neck.bubble

    def held_at(self, piece: Workpiece) -> dict[str, int]:
        """Return at how many places hands hold the bubble, and the row that is laid back."""
        row = _row_between(piece, *self.names)
        return {self.wrap.bubble: PLACES, **dict.fromkeys(row, PLACES_OF_ROW)}

    @classmethod
    def value_of(cls, units: Units, /, bubble: str, neck: str, looks: str | None = None) -> object:
        """Return its value as it stands in a file: a bubble, a joint such as "nose.start", and a side."""
        return {"bubble": bubble, "neck": neck} | ({} if looks is None else {"looks": looks})

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is laid round, and the one behind the neck."""
        named = value.get("bubble") if isinstance(value, dict) else None
        return tuple(name for name in (named, _behind(value)) if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Lay a bubble that is there, and has its gas, round a neck behind it."""
        path, names = (*place.path, cls.word), cls.uses(value)
        if len(names) < 2 or not isinstance(value, dict):
            return
        found = [
            bench.has_name(name, (*path, key)) and bench.find_firm(name, (*path, key))
            for name, key in zip(names, ("bubble", "neck"), strict=True)
        ]
        if not all(found) or not bench.knows(names):
            return
        bubble, behind = names
        ends = ends_of(bubble)
        if bench.piece.are_one(ends):
            bench.complain((*path, "bubble"), f"{bubble} is closed already, expected push")
        elif behind in bench.piece.gripped():
            bench.complain(path, f"{behind} is held by others already, expected each bubble once")
        elif joint(value["neck"]).end != "start" or not _row_between(bench.piece, bubble, behind):
            what = f"{value['neck']} does not hang on {bubble}.end by a row of bubbles alone"
            bench.complain((*path, "neck"), f"{what}, expected the start of a bubble farther behind it")
        elif more := _hangs_besides(bench.piece, bubble, behind):
            what = f"{more} hangs on {bubble}.end, too, expected nothing but a row there"
            bench.complain((*path, "bubble"), what)
        else:
            bench.join(path, ends, [bubble])
            bench.piece.touch(place.index, cls.word, behind, [bubble])

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield a bubble that is too short to be bent, and a row that does not reach its hole."""
        bubble = layout.bubble(self.wrap.bubble)
        if (told := too_round(bubble, self.word)) is not None:
            yield (self.word, "bubble"), told
            return
        reach = self._row_length(layout)
        if reach < (least := REACH * bubble.length):
            what = f"{cm(reach)} before {self.wrap.neck} do not reach round into {self.wrap.bubble}"
            yield (self.word, "neck"), f"{what} ({cm(bubble.length)}), expected at least {at_least(least)}"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a ball that slips out of what is laid round its neck."""
        bubble, ball = (layout.bubble(name) for name in self.names)
        if ball.length < (least := SMALL * bubble.width):
            yield Caution(
                index,
                f"{self.wrap.neck.bubble} ({cm(ball.length)}) may slip out of {self.wrap.bubble}",
                f"it is a ball no wider than what gives way between the walls of a {bubble.size}",
                f"make it at least {at_least(least)} long",
            )

    def _row(self, layout: Layout) -> range:
        """Return the rings from behind the bubble that is laid round to the neck."""
        end, (neck, _) = layout.ends(self.wrap.bubble)[1], layout.ends(self.wrap.neck.bubble)
        assert end is not None, "a row hangs on it"
        return range(end + 1, neck + 1)

    def _row_length(self, layout: Layout) -> float:
        """Return the length of the row that is laid back, m."""
        names = dict.fromkeys(layout.ring(ring).bubble for ring in self._row(layout))
        return sum(layout.bubble(name).length for name in names)

    def _swung_length(self, layout: Layout) -> float:
        """Return the length of all that is behind the neck, m."""
        name, end = self.wrap.neck.bubble, layout.ends(self.wrap.neck.bubble)[1]
        length = layout.bubble(name).length
        while end is not None:
            name = layout.ring(end + 1).bubble
            end = layout.ends(name)[1]
            length += layout.bubble(name).length
        return length

    def perform(self, score: Score, index: int) -> None:
        """Lay the row back, bring the two ends of the bubble together round its neck, and twist them."""
        layout = score.layout
        start, end = layout.ends(self.wrap.bubble)
        behind = self.wrap.neck.bubble
        last = layout.ends(behind)[1]
        assert end is not None, "a row hangs on it"
        row = tuple(self._row(layout))
        own = (*layout.guides(behind), *(() if last is None else (last,)))
        length = layout.bubble(self.wrap.bubble).length
        calm = self._row_length(layout) / LAYING_SPEED + max(GATHER_LEAST, length / HAND_SPEED)
        calm = max(calm, math.pi * self._swung_length(layout) / SWINGING_SPEED)
        text = f"{self.word}: {self.wrap.bubble}"
        score.refuse_haste(index, self.seconds, calm + SETTLE_SECONDS, f"wrap {self.wrap.bubble} round")
        point = self.point or "up"
        corners, cheeks = folded(layout, self.wrap.bubble, start, end)
        move = moves.Wrap(
            score.now,
            calm / score.pace.leading,
            index,
            text,
            corners=corners,
            cheeks=cheeks,
            point=score.towards(point),
            across=score.sided(moves.ACROSS[point]),
            bubble=behind,
            led=(*row, *own),
            row=len(row),
            tube=layout.bubble(self.wrap.bubble).width,
            behind=1.0 if self.wrap.looks == "forward" else -1.0,
        )
        score.add(move)
        score.weld((start, end), self.turns, text, index)


def _hangs_besides(piece: Workpiece, bubble: str, behind: str) -> str | None:
    """Return what hangs on the end of a bubble besides the row to the start of another, if anything does."""
    row = piece.row(piece.bubbles[bubble].balloon)
    own = row[row.index(bubble) : row.index(behind)] if behind in row else row
    return next((end.bubble for end in piece.joint(Joint(bubble, "end")) if end.bubble not in own), None)


def _row_between(piece: Workpiece, bubble: str, behind: str) -> tuple[str, ...]:
    """Return the bubbles from the end of one to the start of another, none where they are not all alone."""
    row = piece.row(piece.bubbles[bubble].balloon)
    if bubble == behind or behind not in row:
        return ()
    between = tuple(row[row.index(bubble) + 1 : row.index(behind)])
    return between if piece.row_from([bubble], behind) == between else ()


def _behind(value: object) -> str | None:
    """Return the bubble whose start a value names."""
    try:
        return joint(value["neck"] if isinstance(value, dict) else None).bubble
    except (KeyError, ValueError):
        return None
