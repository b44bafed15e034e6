"""What operations share that lead bubbles side by side about each other, as strands of a rope or a plait."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import cm
from balloon_usd.operations.caution import Caution, unequal
from balloon_usd.operations.modifiers import Timed
from balloon_usd.operations.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.operations.layout import Layout, PlacedBubble
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece


class OfStrands(Timed, Operation):
    """An operation whose value has a list of bubbles, which are strands."""

    most: ClassVar[int]
    """Bubbles that it takes at most."""

    @property
    def names(self) -> tuple[str, ...]:
        """Bubbles that are its strands."""
        named: tuple[str, ...] = getattr(self, self.word).bubbles
        return named

    @property
    def places(self) -> int:
        """At how many places hands hold each bubble, evenly."""
        raise NotImplementedError

    def held_at(self, piece: Workpiece) -> dict[str, int]:
        """Return at how many places hands hold its strands."""
        return dict.fromkeys(self.names, self.places)

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return its bubbles."""
        named = value.get("bubbles") if isinstance(value, dict) else None
        if not isinstance(named, (list, tuple)):
            return ()
        return tuple(name for name in named[: cls.most] if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Take bubbles that are there, each once, have their gas, and lie as they must."""
        path: Path = (*place.path, cls.word, "bubbles")
        names = cls.uses(value)
        found = [
            bench.has_name(name, (*path, k)) and bench.find_firm(name, (*path, k))
            for k, name in enumerate(names)
        ]
        # What is no name is told where it stands.
        whole = names and isinstance(value, dict) and len(names) == len(value["bubbles"])
        if not whole or not all(found) or not bench.knows(names):
            return
        if len(set(names)) < len(names):
            bench.complain(path, "names a bubble twice, expected each once")
            return
        known = len(bench.complaints)
        cls.take(names, path, bench)
        if len(bench.complaints) == known:
            bench.wind(names, path)

    @classmethod
    def take(cls, names: Sequence[str], path: Path, bench: Workbench) -> None:
        """Take different bubbles that are there, or complain of how they lie."""
        raise NotImplementedError

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of strands of unequal lengths."""
        by_length = sorted(self.names, key=lambda name: layout.bubble(name).length)
        short, long = (layout.bubble(by_length[k]).length for k in (0, -1))
        if unequal((short, long)):
            yield Caution(
                index,
                f"{by_length[-1]} ({cm(long)}) is longer than {by_length[0]} ({cm(short)})",
                "strands end in the same joints, so the longer one bows out",
                f"make all {cm(long)} long",
            )

    def shortest(self, layout: Layout) -> float:
        """Return the length of the shortest bubble, m."""
        return min(layout.bubble(name).length for name in self.names)

    def widest(self, layout: Layout) -> PlacedBubble:
        """Return the bubble of the widest balloon."""
        return max((layout.bubble(name) for name in self.names), key=lambda bubble: bubble.width)

    def rows(self, score: Score) -> list[tuple[int, ...]]:
        """Return the rings of each bubble, from its start to its end, which is no tip."""
        return [score.layout.along(name) for name in self.names]


def from_joint(joint: int, rows: Sequence[tuple[int, ...]], score: Score) -> tuple[tuple[int, ...], ...]:
    """Return rows of rings, each turned so that it begins in a joint, named by a ring of it."""
    root = score.joints.root
    return tuple(row if root(row[0]) == root(joint) else row[::-1] for row in rows)
