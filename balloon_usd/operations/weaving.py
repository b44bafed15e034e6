"""What operations share that twist a row of bubbles off, each, once it is made, to a joint of others."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.language.quantities import length_entry, written_length
from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.operation import BubbleKind, MakesBubbles

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class WeavesRow(Turned, MakesBubbles):
    """An operation whose value has the bubbles of a row, and what of others they are twisted `to`."""

    bubble_kind: ClassVar[BubbleKind | None] = "bubble"
    across: ClassVar[bool] = True
    may_begin_joined: ClassVar[bool] = False
    """Whether the start of its row may be one already with where the others begin."""

    @property
    def _row(self) -> Any:
        return getattr(self, self.word)

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles that it twists off: inflated length (m) by name."""
        found: dict[str, float] = self._row.bubbles
        return found

    def path_of(self, bubble: str) -> tuple[str, ...]:
        """Return the keys under which the length of a bubble stands."""
        return (self.word, "bubbles", bubble)

    @property
    @abstractmethod
    def joints(self) -> tuple[Joint, ...]:
        """Joints of others for the end of each; with one more, the first is for the start of the row."""

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        lengths = {name: length_entry(length, units) for name, length in self.lengths.items()}
        return {"bubbles": lengths, "to": [str(each) for each in self._row.to]}

    @classmethod
    def value_of(cls, units: Units, /, bubbles: Mapping[str, LengthLike], to: Sequence[str]) -> object:
        """Return its value as it stands in a file: lengths by bubble, and to what of others they go."""
        lengths = {name: written_length(length, units) for name, length in bubbles.items()}
        return {"bubbles": lengths, "to": list(to)}

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles of the row."""
        bubbles = value.get("bubbles") if isinstance(value, dict) else None
        return tuple(bubbles) if isinstance(bubbles, dict) else ()

    @classmethod
    @abstractmethod
    def joints_in(cls, value: object) -> tuple[Joint, ...]:
        """Return the joints of others that a value means, as far as they can be read."""

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles to whose joints it is twisted."""
        return tuple(each.bubble for each in cls.joints_in(value))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, and let their ends become one with joints that are there."""
        path = (*place.path, cls.word)
        names, joints = cls.makes(value), cls.joints_in(value)
        found = [bench.find_joint(each, (*path, "to")) for each in joints]
        made = [bench.make(name, (*path, "bubbles", name), place.balloon) for name in names]
        if not names or not joints or not all(found) or not all(made):
            return
        if cls.fits(value, place, bench) and bench.knows([*names, *(each.bubble for each in joints)]):
            for end, other in pairs(names, joints):
                begun = cls.may_begin_joined and end.end == "start" and bench.piece.are_one([other, end])
                if not begun:
                    bench.join((*path, "to"), [other, end], [str(other), str(end)])

    @classmethod
    @abstractmethod
    def fits(cls, value: object, place: Place, bench: Workbench) -> bool:
        """Say whether its bubbles and those of others fit together, and complain if they do not."""

    def perform(self, score: Score, index: int) -> None:
        """Twist one bubble after another off, and each to its joint."""
        joined = dict(pairs(tuple(self.lengths), self.joints))
        for name in self.lengths:
            score.twist(name, self.turns, index)
            for end in ends_of(name):
                if end.end == "end":
                    self.lead(name, score, index)
                if (other := joined.get(end)) is not None:
                    self._lock(end, other, score, index)

    def lead(self, name: str, score: Score, index: int) -> None:
        """Do what is to be done with a bubble before its end is twisted to others."""

    def _lock(self, end: Joint, other: Joint, score: Score, index: int) -> None:
        """Bring two joints together and twist them into one."""
        first, last = sorted(score.twistable((end, other), self.word, index))
        if score.joints.root(first) == score.joints.root(last):
            return
        text = f"{self.word}: {end.bubble}"
        score.together(first, last, None, text, index)
        score.weld((first, last), self.turns, text, index)


def pairs(names: Sequence[str], joints: Sequence[Joint]) -> Iterator[tuple[Joint, Joint]]:
    """Yield each end of a row of bubbles with the joint of others to which it is twisted."""
    if len(joints) > len(names):
        yield Joint(names[0], "start"), joints[0]
    for name, other in zip(names, joints[-len(names) :], strict=True):
        yield Joint(name, "end"), other
