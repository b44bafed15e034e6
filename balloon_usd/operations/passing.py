"""What operations share in which a bubble is brought into a closed ring of others, which then holds it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.language.lengths import at_most, cm
from balloon_usd.language.names import Name
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import OnBalloon, Pointed, Timed
from balloon_usd.operations.moves import Move, PassThrough
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import HAND_SPEED, SETTLE_SECONDS
from balloon_usd.operations.wide_balls import wide_ball
from balloon_usd.operations.workpiece import ContactKind

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

LEAST_HOLE = 1.5
"""Length of a bubble that closes on itself below which it is a ball without a hole, in its widths."""
STUCK_IN_LOOP, STUCK_IN_RING = 0.9, 1.4
"""Length beyond which a bubble gets stuck in a ring of one bubble, or of more, in its depth: in simulations
of a 260 one of 7.5 cm stays in a loop of 18 and slips back out of one of 15, one of 6 stays in one of 15 and
not in one of 12; and one of 8 goes between two of 6, one of 9 does not.
"""
WIDE = 0.84
"""Width beyond which a ball that is wider than the sides of its ring may not come through it, in its depth:
in simulations one of 6.8 cm goes through two 260 of 8.4, and one of 11.5 gets stuck in two 350 of 13.6.
"""
MOST_SIDES = 64
"""Largest number of bubbles of a ring."""
LEAST_SECONDS = 2.4
"""Shortest way through a ring and back, s."""
LONGEST = 2.0
"""Length beyond which a bubble is not brought through a ring, in the depth of the ring: half of the way round
it. What is that long is threaded.
"""
WAY = 3.0
"""Way of the end of a bubble through a ring and back, in its lengths."""


Ring = Annotated[tuple[Name, ...], Field(min_length=1, max_length=MOST_SIDES)]
"""The bubbles of a ring: one that closes on itself, or those of a lock."""


class Passing(OnBalloon, Pointed, Timed, Operation):
    """An operation whose value names a bubble and the ring into which it is brought."""

    word: ClassVar[ContactKind]
    ring_key: ClassVar[str]
    """Key of the ring in its value."""
    beyond: ClassVar[float]
    """How far the free end of the bubble swings beyond the plane of the ring, rad."""
    by_row: ClassVar[bool] = False
    """Whether a row of bubbles may lie between the ring and the bubble that goes through."""
    dip: ClassVar[float] = 0.0
    """How far its middle is pressed beyond that plane, in its widths, where its other end stays in it."""

    @property
    def bubble(self) -> str:
        """The bubble that goes through."""
        named: str = getattr(self, self.word).bubble
        return named

    @property
    def ring(self) -> tuple[str, ...]:
        """The bubbles that form the ring."""
        named: tuple[str, ...] = getattr(getattr(self, self.word), self.ring_key)
        return named

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that goes through, and those of the ring."""
        return (self.bubble, *self.ring)

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return {"bubble": self.bubble, self.ring_key: list(self.ring)}

    @classmethod
    def value_of(cls, units: Units, /, bubble: str, *ring: str) -> object:
        """Return its value as it stands in a file: a bubble, and those of the ring."""
        return {"bubble": bubble, cls.ring_key: list(ring)}

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that goes through, and those of the ring."""
        return tuple(name for _, name in names_in(value, cls.ring_key) if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Bring a bubble that is there, and has its gas, into a closed ring of others."""
        path, names = (*place.path, cls.word), cls.uses(value)
        piece = cls.piece_with(names[0], place, bench) if names else bench.piece
        found = [
            isinstance(name, str) and cls.finds(name, (*path, *at), piece, bench)
            for at, name in names_in(value, cls.ring_key)
        ]
        if len(names) < 2 or not all(found) or not set(names) <= piece.bubbles.keys():
            return
        fault = next(cls._faults(piece, names[0], names[1:]), None)
        if fault is not None:
            bench.complain(path, fault)
        elif bench.is_open(names[1:], path) and cls.fits(names[0], (*path, "bubble"), bench):
            bench.piece.touch(place.index, cls.word, names[0], names[1:])

    @classmethod
    def piece_with(cls, name: str, place: Place, bench: Workbench) -> Workpiece:
        """Return the workpiece on which a bubble of a name is brought into a ring."""
        return bench.piece

    @classmethod
    def finds(cls, name: str, path: Path, piece: Workpiece, bench: Workbench) -> bool:
        """Say whether a bubble is there and has its gas, and complain if it does not."""
        return bench.has_name(name, path) and bench.find_firm(name, path)

    @classmethod
    def _faults(cls, piece: Workpiece, name: str, ring: Sequence[str]) -> Iterator[str]:
        """Yield why a bubble cannot be brought into a ring of others."""
        if len({name, *ring}) <= len(ring):
            yield "names a bubble twice, expected each once"
        elif closing := [each for each in ring if len(ring) > 1 and piece.is_closed([each])]:
            others = [each for each in ring if each not in closing]
            one = len(closing) == 1
            what = "closes on itself and is no side" if one else "close on themselves and are no sides"
            yield f"{all_of(closing)} {what} of the ring, expected {', '.join(others) or 'one ring'}"
        elif not piece.is_closed(ring):
            what = f"{all_of(ring)} form no closed ring" if len(ring) > 1 else f"{ring[0]} is no closed ring"
            yield f"{what} by now, expected a loop, a fold, or all bubbles that a lock before closes to one"
        elif name in piece.gripped():
            yield f"{name} is held by others already, expected each bubble once"
        else:
            yield from cls._faults_of_ends(piece, name, ring)

    @classmethod
    def _faults_of_ends(cls, piece: Workpiece, name: str, ring: Sequence[str]) -> Iterator[str]:
        """Yield what is wrong at the ends of a bubble that is to be brought into a ring of others."""
        corners = {
            end
            for each in ring
            for end in piece.joint(Joint(each, "start")) + piece.joint(Joint(each, "end"))
        }
        ends = [end for end in ends_of(name) if end not in corners]
        if len(ends) == 2:
            if not (cls.by_row and piece.row_from(ring, name)):
                expected = "a bubble that does" + " or hangs on one by a row of bubbles" * cls.by_row
                yield f"{name} does not begin at a joint of {all_of(ring)}, expected {expected}"
                return
            ends = ends[1:]
        if not ends:
            yield f"{name} hangs on {all_of(ring)} with both ends, expected one with a free end"
            return
        more = piece.hangs_on(ends[0]) or (ends[0] in piece.open_ends.values())
        if cls.word == "push" and more:
            what = f"what hangs on {ends[0]} does not fit through"
            yield f"{what}, expected a bubble at the end of a balloon, or roll"
        if cls.word == "roll" and not more:
            yield f"nothing hangs on {ends[0]}, expected push"

    @classmethod
    def fits(cls, name: str, path: Path, bench: Workbench) -> bool:
        """Say whether it can be done with a bubble, and complain if it cannot."""
        return True

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield a ring without a hole, and a bubble that is far too long for its ring."""
        if len(self.ring) == 1 and (fault := without_hole(self.ring[0], layout)):
            yield (self.word, self.ring_key), f"{fault}, expected a loop or a fold, or bubbles of a lock"
        else:
            yield from self.misfits(layout)

    def misfits(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield a bubble that is far too long for its ring."""
        length, depth = self.length(layout), depth_of(layout, self.ring)
        if length > LONGEST * depth:
            what = f"{self.bubble} is {cm(length)} long, and {all_of(self.ring)} only {cm(depth)} deep"
            yield (self.word, "bubble"), f"{what}, expected {at_most(LONGEST * depth)} or less"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a bubble that gets stuck in its ring."""
        length, depth = self.length(layout), depth_of(layout, self.ring)
        most = (STUCK_IN_LOOP if len(self.ring) == 1 else STUCK_IN_RING) * depth
        if length > most:
            yield Caution(
                index,
                f"{self.bubble} ({cm(length)}) may not come through {all_of(self.ring)}",
                f"the ring is {cm(depth)} deep, and it gets stuck at its far end",
                f"make it {cm(most)} long, or less",
            )
        ball = wide_ball(index, layout, self.bubble, self.ring, WIDE * depth, "not come through")
        if ball is not None:
            yield ball

    def brought(self, layout: Layout) -> tuple[str, ...]:
        """Return what goes through: the bubble, and what hangs on it."""
        return (self.bubble,)

    def length(self, layout: Layout) -> float:
        """Return how long that is, m."""
        return sum(layout.bubble(name).length for name in self.brought(layout))

    def hand_seconds(self, length: float) -> float:
        """Return how long a calm maker takes to bring a bubble of a length (m) there, s."""
        return max(LEAST_SECONDS, WAY * length / HAND_SPEED)

    def as_moved(self, move: PassThrough, layout: Layout) -> PassThrough:
        """Return the move that brings it there, given what all such moves have."""
        return move

    def perform(self, score: Score, index: int) -> None:
        """Bring it there, wait until the ring has closed on it, and let go."""
        layout, bubble = score.layout, score.layout.bubble(self.bubble)
        opening = _around(score, self.ring)
        base, row, led = _held_and_led(score, self.bubble, opening)
        more = [ring for name in self.brought(layout)[1:] for ring in layout.along(name)[1:]]
        text = f"{self.word}: {self.bubble}"
        seconds = self.hand_seconds(self.length(layout))
        doing = f"bring {self.bubble} through its ring"
        score.refuse_haste(index, self.seconds, seconds + SETTLE_SECONDS, doing)
        move = PassThrough(
            score.now,
            seconds / score.pace.leading,
            index,
            text,
            bubble=self.bubble,
            base=base,
            led=(*row, *led, *more),
            row=len(row),
            opening=opening,
            width=bubble.width,
            tube=max(layout.bubble(name).width for name in self.ring),
            beyond=self.beyond,
            dip=self.dip * bubble.width,
            point=None if self.point is None else score.towards(self.point),
        )
        score.add(self.as_moved(move, layout))
        score.add(Move(score.now, SETTLE_SECONDS, index, text))
        score.let_go(index)


def names_in(value: object, key: str) -> list[tuple[Path, object]]:
    """Return all that stands in a value for the name of a bubble and, under a key, of others that hold it,
    with their places in it.
    """
    others = value.get(key) if isinstance(value, dict) else None
    if not isinstance(value, dict) or not isinstance(others, (list, tuple)):
        return []
    sides = [((key, at), name) for at, name in enumerate(others[:MOST_SIDES])]
    return [(("bubble",), value.get("bubble")), *sides]


def without_hole(name: str, layout: Layout) -> str | None:
    """Return that a bubble which closes on itself has no hole, in words; None where it has one."""
    bubble = layout.bubble(name)
    hollow = bubble.hollow and bubble.length >= LEAST_HOLE * bubble.width
    return None if hollow else f"{name} ({cm(bubble.length)}) has no hole"


def depth_of(layout: Layout, ring: Sequence[str]) -> float:
    """Return how far a ring of bubbles reaches from a joint of it, m."""
    return 0.5 * sum(layout.bubble(name).length for name in ring)


def _held_and_led(
    score: Score, bubble: str, ring: Sequence[int]
) -> tuple[int, tuple[int, ...], tuple[int, ...]]:
    """Return the ring of the end of a bubble that lies in a ring of others, those of a row of bubbles that
    hangs there before it, and its own away from it.

    `ring`: rings of these others.
    """
    layout: Layout = score.layout
    start, end = layout.ends(bubble)
    guides = layout.guides(bubble)
    corners = {score.joints.root(each) for each in ring}
    if end is not None and score.joints.root(end) in corners:
        return end, (), (*guides[::-1], start)
    base, row = _row(score, start, corners)
    return base, row, guides if end is None else (*guides, end)


def _row(score: Score, start: int, corners: Container[int]) -> tuple[int, tuple[int, ...]]:
    """Return the last ring before another of its balloon that is one of some joints, and those from there to
    the other; none of what closes on itself, such as ears.
    """
    row: list[int] = []
    for ring in range(start, -1, -1):
        joint = score.joints.root(ring)
        if joint in corners:
            return ring, tuple(row[::-1])
        known = next((k for k, each in enumerate(row) if score.joints.root(each) == joint), None)
        row = [*row, ring] if known is None else row[: known + 1]
    raise AssertionError("a bubble that is brought into a ring hangs on it")


def _around(score: Score, bubbles: Sequence[str]) -> tuple[int, ...]:
    """Return the rings of bubbles that form a closed ring, in order round it."""
    layout, left = score.layout, list(bubbles)
    found: list[int] = []
    at, _ = layout.ends(left[0])
    while left:
        here = score.joints.root(at)
        for name in left:
            start, end = layout.ends(name)
            assert end is not None, "no tip lies in a closed ring"
            if here == score.joints.root(start):
                found += [start, *layout.guides(name)]
                at = end
                break
            if here == score.joints.root(end):
                found += [end, *layout.guides(name)[::-1]]
                at = start
                break
        left.remove(name)
    return tuple(found)
