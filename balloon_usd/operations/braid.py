"""`braid`: three bubbles that hang on one joint are plaited, and their ends twisted together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Between
from balloon_usd.operations import moves
from balloon_usd.operations.modifiers import Entries, Turned
from balloon_usd.operations.score import SETTLE_SECONDS
from balloon_usd.operations.strands import OfStrands, from_joint

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Workbench

STRANDS = 3
"""Bubbles of a plait."""
CROSSING = 1.75
"""Length of each strand for a crossing below which there is no room, in its widths."""
PLACES_A_CROSSING = 1.5
"""At how many places hands hold each strand for a crossing."""
CROSSING_SECONDS = 1.0
"""Time of a crossing, s."""
GATHERING_SECONDS = 2.5
"""Time in which the strands are laid beside each other before, and their ends brought together behind, s."""


class Ends(NamedTuple):
    """The joints of a bubble, each as all bubble ends in it."""

    start: tuple[Joint, ...]
    end: tuple[Joint, ...]


class BraidedBubbles(Entries):
    """What is plaited, and how far."""

    bubbles: Annotated[tuple[Name, ...], Field(min_length=STRANDS, max_length=STRANDS)]
    """Three bubbles that begin or end in one joint, their other ends free."""
    crossings: Annotated[int, Between(1, 60, whole=True)]
    """How often an outer strand is laid over the middle one, from both sides in turns."""


class Braid(Turned, OfStrands):
    """Plait three bubbles that hang on one joint, and twist their free ends together."""

    word: ClassVar[str] = "braid"
    called: ClassVar[tuple[str, ...]] = ("plait",)
    most: ClassVar[int] = STRANDS
    value_model: ClassVar[type[Entries] | None] = BraidedBubbles
    example: ClassVar[str] = """\
format: 1
name: braid
units: cm
balloons:
  red: {size: 160, color: red, inflated: 52}
  white: {size: 160, color: white, inflated: 52}
  blue: {size: 160, color: blue, inflated: 52}
steps:
  - bubbles: {red_end: 2}
    balloon: red
  - bubbles: {white_end: 2}
    balloon: white
  - bubbles: {blue_end: 2}
    balloon: blue
  - lock: {joints: [red_end.end, white_end.end, blue_end.end]}
  - bubbles: {red_strand: 45}
    balloon: red
  - bubbles: {white_strand: 45}
    balloon: white
  - bubbles: {blue_strand: 45}
    balloon: blue
  - braid: {bubbles: [red_strand, white_strand, blue_strand], crossings: 6}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "clownantics.com: braids and spirals",
        "balloonotherapy.blogspot.com 2016-09: balloons braided to a broom",
    )

    braid: BraidedBubbles
    """Plait three bubbles that hang on one joint, and twist their free ends together."""

    @property
    def places(self) -> int:
        """At how many places hands hold each bubble, evenly."""
        return math.ceil(PLACES_A_CROSSING * self.braid.crossings) + 3

    @classmethod
    def value_of(cls, units: Units, /, *bubbles: str, crossings: int) -> object:
        """Return its value as it stands in a file: three bubbles, and how often they cross."""
        return {"bubbles": list(bubbles), "crossings": crossings}

    @classmethod
    def take(cls, names: Sequence[str], path: Path, bench: Workbench) -> None:
        """Join the free ends of bubbles that hang on one joint."""
        if len(names) < STRANDS:
            return
        ends = [Ends(*map(bench.piece.joint, ends_of(name))) for name in names]
        common = set.intersection(*map(set, ends))
        expected = "expected three bubbles that a lock has joined at one end"
        if len(common) != 1 or any(each.start == each.end for each in ends):
            bench.complain(path, f"{all_of(names)} do not hang on one joint, {expected}")
            return
        (joint,) = common
        for name in names:
            limb = bench.piece.limb(name)
            if limb is None or limb.joint not in joint or len(limb.bubbles.intersection(names)) > 1:
                bench.complain(path, f"the other end of {name} is not free, {expected} and nowhere else")
                return
        free = [
            Joint(name, "end" if each.start == joint else "start")
            for name, each in zip(names, ends, strict=True)
        ]
        bench.join(path, free, names)

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield more crossings than there is length for."""
        shortest, widest = self.shortest(layout), self.widest(layout)
        least = CROSSING * self.braid.crossings * widest.width
        if shortest < least:
            most = math.floor(shortest / (CROSSING * widest.width))
            text = f"{cm(shortest)} of a {widest.size} are too short for {self.braid.crossings} crossings"
            yield (self.word, "crossings"), f"{text}, expected at most {most}, or {at_least(least)}"

    def perform(self, score: Score, index: int) -> None:
        """Lay the strands over each other in turns, and twist their ends together."""
        for name in self.names:
            if score.layout.ends(name)[1] is None:
                what = f"{name} ends in the tip of its balloon, which cannot be twisted"
                score.refuse(index, {(self.word, "bubbles"): f"{what}, expected a bubble between two joints"})
        calm = GATHERING_SECONDS + CROSSING_SECONDS * self.braid.crossings
        score.refuse_haste(index, self.seconds, calm + SETTLE_SECONDS, f"braid {all_of(self.names)}")
        text = f"{self.word}: {all_of(self.names)}"
        rows = self.rows(score)
        roots = ({score.joints.root(row[0]), score.joints.root(row[-1])} for row in rows)
        (joint,) = set.intersection(*roots)
        strands = from_joint(joint, rows, score)
        move = moves.Plait(
            score.now,
            calm / score.pace.leading,
            index,
            text,
            bubbles=self.names,
            strands=strands,
            crossings=self.braid.crossings,
            width=self.widest(score.layout).width,
        )
        score.add(move)
        score.weld(tuple(strand[-1] for strand in strands), self.turns, text, index)
