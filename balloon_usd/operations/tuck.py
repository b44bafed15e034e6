"""`tuck`: a limb is set astride others, which hold it between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.names import Name
from balloon_usd.operations import moves
from balloon_usd.operations.loop_holes import hole_caution
from balloon_usd.operations.meeting import apart
from balloon_usd.operations.modifiers import Entries, Pointed, Timed
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.passing import names_in, without_hole
from balloon_usd.operations.reach import SECONDS_PER_METRE, limb_reach
from balloon_usd.operations.score import HAND_SPEED, SETTLE_SECONDS
from balloon_usd.operations.wide_balls import wide_ball
from balloon_usd.operations.workpiece import ContactKind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.caution import Caution
    from balloon_usd.operations.layout import Layout, PlacedBubble
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

LEAST_SECONDS = 2.4
"""Shortest time in which a limb is set between others, s."""
WAY = 4.0
"""Way of the end of a limb to a place above the others and down between them, at most, in its lengths."""
WIDE, WIDE_IN_LOOP = 0.85, 1.0 / 3.0
"""Width of a ball that is wider than what it is set into, in the length of the shorter of two bubbles, or of
a loop, beyond which it finds no place: in simulations one of 3.6 cm stays between two of 4.6 and one of 13
slips out from between two of 6, one of 8 cm stays in a loop of 25 cm and one of 12 does not.
"""
MOST = 2
"""Largest number of bubbles between which one is set."""
PLACES, PLACES_OF_LOOP = 3, 7
"""At how many places hands hold a bubble beside which something is set, and a loop around it."""


class TuckedBubble(Entries):
    """What is set between what."""

    bubble: Name
    """The bubble that is set there, which hangs on one joint, with what hangs on it."""
    between: Annotated[tuple[Name, ...], Field(min_length=1, max_length=MOST)]
    """Two bubbles, or one that closes on itself: then it is set into its hole."""


class Tuck(Pointed, Timed, Operation):
    """Set a limb between two others, or into the hole of a loop, where their walls hold it."""

    word: ClassVar[ContactKind] = "tuck"
    on_rounds: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = TuckedBubble
    example: ClassVar[str] = """\
format: 1
name: sleeping_duck
units: cm
balloons:
  main: {size: 260, color: yellow, length: 20, tail: 8}
steps:
  - bubbles: {head: 5}
  - ear: {crest: 2.5}
    point: up
  - bubbles: {neck: 13, left_wing: 12, right_wing: 12}
  - lock: [left_wing, right_wing]
    point: up
  - rest: tail
  - tuck: {bubble: neck, between: [left_wing, right_wing]}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "instructables.com: turtle",
        "professorwonder.com, balloon 4: the head of a penguin",
        "professorwonder.com, balloon 25: the hubs of a tractor's wheels",
    )

    tuck: TuckedBubble
    """Set a limb between two others, or into the hole of a loop, where their walls hold it."""

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that is set there, and those between which it is."""
        return (self.tuck.bubble, *self.tuck.between)

    def held_at(self, piece: Workpiece) -> dict[str, int]:
        """Return at how many places hands hold those between which it is set."""
        between = self.tuck.between
        return {name: PLACES_OF_LOOP if piece.is_closed([name]) else PLACES for name in between}

    @classmethod
    def value_of(cls, units: Units, /, bubble: str, *between: str) -> object:
        """Return its value as it stands in a file: a bubble, and those between which it is set."""
        return {"bubble": bubble, "between": list(between)}

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is set there, and those between which it is."""
        return tuple(name for _, name in names_in(value, "between") if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Set a bubble that is there, has its gas and hangs on one joint, between others that do not hang on
        it.
        """
        path, names = (*place.path, cls.word), cls.uses(value)
        found = [
            isinstance(name, str)
            and bench.has_name(name, (*path, *at))
            and bench.find_firm(name, (*path, *at))
            for at, name in names_in(value, "between")
        ]
        # What is no name is told where it stands.
        if len(names) < 2 or not all(found) or not bench.knows(names):
            return
        at, fault = next(_faults(bench.piece, names[0], names[1:]), ("", ""))
        if fault:
            bench.complain((*path, at), fault)
        elif bench.is_open(names[1:], (*path, "between")):
            bench.piece.touch(place.index, cls.word, names[0], names[1:])

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield a loop without a hole, and a fold, out of which all slips."""
        between = self.tuck.between
        if len(between) > 1:
            return
        if fault := without_hole(between[0], layout):
            yield (self.word, "between"), f"{fault}, expected a loop, or two bubbles"
        elif layout.bubble(between[0]).halved:
            what = f"{between[0]} is a fold, whose halves its twist keeps side by side"
            yield (self.word, "between"), f"{what}, expected a loop, or two bubbles"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a loop whose hole its own wall closes, and of one whose hole is too narrow or too wide."""
        between = [layout.bubble(name) for name in self.tuck.between]
        room = (WIDE_IN_LOOP if len(between) == 1 else WIDE) * min(each.length for each in between)
        ball = wide_ball(index, layout, self.tuck.bubble, self.tuck.between, room, "find no place in")
        if ball is not None:
            yield ball
            return
        if len(between) == 1:
            hole = hole_caution(index, layout, self.tuck.bubble, self.tuck.between[0])
            yield from () if hole is None else (hole,)

    def beyond_reach(self, index: int, layout: Layout, piece: Workpiece) -> Iterator[Caution]:
        """Warn of others that do not meet where it hangs."""
        there = piece.after(index)
        limb = there.limb(self.tuck.bubble, self.tuck.between)
        assert limb is not None, "what is set between others hangs on a joint"
        found = apart(index, layout, there, self.tuck.bubble, limb, self.tuck.between)
        yield from () if found is None else (found,)

    def perform(self, score: Score, index: int) -> None:
        """Spread the others, bring it over them and in, and let them close on it."""
        bubble, *between = (score.layout.bubble(name) for name in self.names)
        turned = 2.0 * SECONDS_PER_METRE * limb_reach(score, self.tuck.bubble, index, self.tuck.between)
        calm = max(LEAST_SECONDS, WAY * bubble.length / HAND_SPEED, turned)
        doing = f"set {self.tuck.bubble} between {all_of(self.tuck.between)}"
        score.refuse_haste(index, self.seconds, calm + SETTLE_SECONDS, doing)
        move = moves.Tuck(
            score.now,
            calm / score.pace.leading,
            index,
            f"{self.word}: {self.tuck.bubble}",
            bubble=self.tuck.bubble,
            between=self.tuck.between,
            width=_across(bubble),
            tube=max(map(_across, between)),
            point=None if self.point is None else score.towards(self.point),
        )
        score.settle(move)


def _across(bubble: PlacedBubble) -> float:
    """Return how much room hands make for a bubble, m: a ball is not wider than it is long."""
    return min(bubble.width, bubble.length)


def _faults(piece: Workpiece, name: str, between: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield at which key it stands, and why, that a bubble cannot be set between others."""
    if len({name, *between}) <= len(between):
        yield "between", "names a bubble twice, expected each once"
        return
    if len(between) == 1 and not piece.is_closed(between):
        yield "between", f"{between[0]} is no closed ring by now, expected a loop, or two bubbles"
    if name in piece.gripped():
        yield "bubble", f"{name} is held by others already, expected each bubble once"
    if circle := [each.bubble for each in piece.holding() if name in each.others and each.bubble in between]:
        yield "between", f"{all_of(circle)} cannot hold {name}, which holds {all_of(circle)}, expected others"
    if apart := [each for each in between if each not in piece.hangs_with(name)]:
        one = "is" if len(apart) == 1 else "are"
        what = f"{all_of(apart)} {one} on another figure than {name}"
        yield "between", f"{what}, expected a step before that joins both"
    yield from _faults_of_limb(piece, name, between)


def _faults_of_limb(piece: Workpiece, name: str, between: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield why no part of a figure with a bubble, and without some others, hangs on one joint."""
    limb = piece.limb(name, between)
    if limb is not None:
        if parted := piece.left_by(limb.bubbles):
            yield "bubble", f"{name} {parted.would_leave}: expected this step before that one"
        return
    limb = piece.limb(name)
    moved = [] if limb is None else [each for each in between if each in limb.bubbles]
    if not moved:
        what = f"no joint is there about which {name} could be turned against {all_of(between)}"
        yield "bubble", f"{what}, expected a bubble that hangs on one joint"
    else:
        hangs = "hangs" if len(moved) == 1 else "hang"
        what = f"{all_of(moved)} {hangs} on {name} and would be turned with it"
        yield "between", f"{what}, expected bubbles of the rest of the figure"
