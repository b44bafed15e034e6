"""Balloons that a recipe puts into bubbles of others, and what makes no sense of that."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from balloon_usd.language.choices import unknown
from balloon_usd.language.joint import Joint
from balloon_usd.language.problem import Complaint, Path, quoted

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from balloon_usd.operations.workpiece import Workpiece


@dataclass
class Insertions:
    """What is put into bubbles, and what steps do that matters for it."""

    made_ever: Mapping[str, Path]
    """Where each bubble is made that any step makes."""
    pumped: Mapping[str, Path]
    """Where each balloon is blown up that is not so from the beginning."""
    put_in: dict[str, tuple[str, Path]] = field(default_factory=dict)
    """The bubble into which each balloon is put, and where."""
    used: list[tuple[Path, str]] = field(default_factory=list)
    """Steps that work on bubbles, and these."""

    def lay_in(self, piece: Workpiece, gone: Mapping[str, Path]) -> Iterator[Complaint]:
        """Put balloons into bubbles of a finished workpiece, and yield what hands cannot do of it.

        `gone`: where bubbles are popped or cut off.
        """
        for balloon, (bubble, path) in self.put_in.items():
            problems = list(self._problems(piece, balloon, bubble, gone))
            yield from problems
            if not problems and bubble in piece.bubbles:
                piece.insert(int(path[1]), balloon, bubble)

    def _problems(
        self, piece: Workpiece, balloon: str, bubble: str, gone: Mapping[str, Path]
    ) -> Iterator[Complaint]:
        path, made = self.put_in[balloon][1], piece.bubbles.get(bubble)
        if made is None:
            # What a step that is refused would have made is there, once that is right.
            if bubble not in self.made_ever:
                known = [it.bubble for it in piece.bubbles.values() if it.balloon not in self.put_in]
                yield Complaint(path, unknown("bubble", bubble, known))
        elif made.balloon == balloon or self._lies(piece, made.balloon):
            what = "itself" if made.balloon == balloon else f"{made.balloon}, which lies in another"
            yield Complaint(path, f"lies in {what}, expected a bubble of a balloon that lies in none")
        elif full := self._full_before(path, (balloon, made.balloon)):
            for name in full:
                what = f"balloon {quoted(name)} is blown up by then"
                yield Complaint(path, f"{what}, expected inflate: {name} in a step after this one")
        else:
            yield from self._disturbances(piece, balloon, bubble, gone)

    def _lies(self, piece: Workpiece, balloon: str) -> bool:
        """Whether a balloon is put into a bubble of another."""
        if balloon not in self.put_in:
            return False
        made = piece.bubbles.get(self.put_in[balloon][0])
        return made is None or made.balloon != balloon

    def _full_before(self, path: Path, balloons: Iterable[str]) -> list[str]:
        """Return the balloons that no step after one blows up."""
        later = {name for name, at in self.pumped.items() if int(at[1]) > int(path[1])}
        return [name for name in balloons if name not in later]

    def _disturbances(
        self, piece: Workpiece, balloon: str, bubble: str, gone: Mapping[str, Path]
    ) -> Iterator[Complaint]:
        """Yield the steps that work on what lies in a bubble, or burst that."""
        row, path = piece.row(balloon), self.put_in[balloon][1]
        if len(row) > 1 or (row and len(piece.joint(Joint(row[0], "start"))) > 1):
            what = f"hands reach nothing in {bubble}, but twist {quoted(balloon)}"
            yield Complaint(path, f"{what}, expected nothing made of it but its rest")
        for used, name in self.used:
            if name in row:
                what = f"bubble {quoted(name)} lies in {bubble}, where no hand reaches it"
                yield Complaint(used, f"{what}, expected a bubble of another balloon")
        if bubble in gone:
            what = f"balloon {quoted(balloon)} lies in {quoted(bubble)}"
            yield Complaint(gone[bubble], f"{what}, expected a bubble in which nothing lies")
