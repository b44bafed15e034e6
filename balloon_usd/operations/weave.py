"""`weave`: a row of bubbles, each twisted to a joint of others as soon as it is made."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from pydantic import Field

from balloon_usd.language.joint import Joint, JointEntry, ends_of, readable_joints
from balloon_usd.language.quantities import length_entry, written_length
from balloon_usd.operations.modifiers import Entries, Turned
from balloon_usd.operations.operation import BubbleKind, Lengths, MakesBubbles

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class WovenRow(Entries):
    """What is woven to what."""

    bubbles: Lengths
    """Bubbles of the row, in order."""
    to: tuple[JointEntry, ...] = Field(min_length=1)
    """A joint of others for the end of each; with one more, the first is for the start of the row."""


class Weave(Turned, MakesBubbles):
    """Twist a row of bubbles off, and each, as soon as it is made, to a joint of others."""

    word: ClassVar[str] = "weave"
    bubble_kind: ClassVar[BubbleKind | None] = "bubble"
    across: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = WovenRow
    example: ClassVar[str] = """\
format: 1
name: frill
units: cm
balloons:
  band: {size: 260, color: red, length: 16, tail: 7}
  main: {size: 260, color: white, length: 24, tail: 7}
steps:
  - bubbles: {band_1: 6, band_2: 6, band_3: 6, band_4: 6}
    balloon: band
  - weave:
      bubbles: {frill_1: 12, frill_2: 12, frill_3: 12, frill_4: 12}
      to: [band_1.start, band_1.end, band_2.end, band_3.end, band_4.end]
    balloon: main
"""
    sources: ClassVar[tuple[str, ...]] = (
        "bpmizuki.hatenablog.jp: はしご編み, the ladder weave",
        "balloonotherapy.blogspot.com 2015-02: a vase, row on row",
        "balloonhq.com: weaving, rows on spokes",
    )

    weave: WovenRow
    """Twist bubbles off, and each, as soon as it is made, to a joint of others."""

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles that it twists off: inflated length (m) by name."""
        return self.weave.bubbles

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        lengths = {name: length_entry(length, units) for name, length in self.lengths.items()}
        return {"bubbles": lengths, "to": [str(each) for each in self.weave.to]}

    @classmethod
    def value_of(cls, units: Units, /, bubbles: Mapping[str, LengthLike], to: Sequence[str]) -> object:
        """Return its value as it stands in a file: lengths by bubble, and joints such as "nose.end"."""
        lengths = {name: written_length(length, units) for name, length in bubbles.items()}
        return {"bubbles": lengths, "to": list(to)}

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles of the row."""
        bubbles = value.get("bubbles") if isinstance(value, dict) else None
        return tuple(bubbles) if isinstance(bubbles, dict) else ()

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles to whose joints it is woven."""
        return tuple(each.bubble for each in _joints_in(value))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, and let their ends become one with joints that are there."""
        path = (*place.path, cls.word)
        names, joints = cls.makes(value), _joints_in(value)
        found = [bench.find_firm(each.bubble, (*path, "to")) for each in joints]
        made = [bench.make(name, (*path, "bubbles", name), place.balloon) for name in names]
        # What is no joint is told where it stands.
        whole = isinstance(value, dict) and names and joints and len(joints) == len(value["to"])
        if not whole or not all(found) or not all(made):
            return
        if len(joints) not in (len(names), len(names) + 1):
            counts = f"{len(joints)} joints for {len(names)} bubbles"
            bench.complain((*path, "to"), f"{counts}, expected as many, or one more for the start")
            return
        if bench.knows([*names, *(each.bubble for each in joints)]):
            for end, other in _pairs(names, joints):
                bench.join((*path, "to"), [other, end], [str(other), str(end)])

    def perform(self, score: Score, index: int) -> None:
        """Twist one bubble after another off, and each to its joint."""
        pairs = dict(_pairs(tuple(self.lengths), self.weave.to))
        for name in self.lengths:
            score.twist(name, self.turns, index)
            for end in ends_of(name):
                if (other := pairs.get(end)) is not None:
                    self._lock(end, other, score, index)

    def _lock(self, end: Joint, other: Joint, score: Score, index: int) -> None:
        """Bring two joints together and twist them into one."""
        first, last = sorted(score.twistable((end, other), self.word, index))
        text = f"{self.word}: {end.bubble}"
        score.together(first, last, None, text, index)
        score.weld((first, last), self.turns, text, index)


def _pairs(names: Sequence[str], joints: Sequence[Joint]) -> Iterator[tuple[Joint, Joint]]:
    """Yield each end of a row of bubbles with the joint of others to which it is woven."""
    if len(joints) > len(names):
        yield Joint(names[0], "start"), joints[0]
    for name, other in zip(names, joints[-len(names) :], strict=True):
        yield Joint(name, "end"), other


def _joints_in(value: object) -> tuple[Joint, ...]:
    """Return the joints that a value names, as far as they can be read."""
    return readable_joints(value.get("to")) if isinstance(value, dict) else ()
