"""The workpiece: what has been made so far, for the questions that operations ask of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of, unknown
from balloon_usd.language.names import NAME_LIMIT
from balloon_usd.language.problem import PROBLEMS_SHOWN, Complaint, Path, path_text, quoted
from balloon_usd.operations.disjoint_sets import DisjointSets

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from balloon_usd.language.joint import Joint

Vertex = tuple[str, int]
"""Joint number (0 = knot) on a balloon."""


@dataclass(frozen=True)
class Place:
    """Where a step stands, and what it works on."""

    path: Path
    """Of the step in the recipe."""
    balloon: str | None
    """The balloon worked on, None when that cannot be known."""

    @property
    def index(self) -> int:
        """Number of the step, from 0."""
        return int(self.path[1])


@dataclass(frozen=True)
class UnnamedRest:
    """What is left of a balloon to which no step gives a name."""

    balloon: str
    last: int
    """Index of the last step that makes something of the balloon."""


class Workpiece:
    """Bubbles on balloons, and which joints are already one; complaints about what cannot be done."""

    def __init__(
        self, balloons: Iterable[str], made_ever: Mapping[str, Path], rests: Mapping[str, UnnamedRest]
    ) -> None:
        """Begin with balloons of which nothing is made.

        Args:
            balloons: their names.
            made_ever: where each bubble is made that any step makes, for words about steps in a wrong order.
            rests: what is left of balloons in the end, by the names that it gets.
        """
        self.complaints: list[Complaint] = []
        self._balloons: dict[str, list[str]] = {name: [] for name in balloons}
        self._bubbles: dict[str, Vertex | None] = {}
        self._made_at: dict[str, Path] = {}
        self._ended: dict[str, Path] = {}
        self._joints: DisjointSets[Vertex] = DisjointSets()
        self._made_ever, self._rests = made_ever, rests

    @property
    def full(self) -> bool:
        """More complaints than anybody reads."""
        return len(self.complaints) > PROBLEMS_SHOWN

    def complain(self, path: Path, text: str) -> None:
        """Note that something makes no sense."""
        self.complaints.append(Complaint(path, text))

    def balloon_of(self, path: Path, named: str | None, *, makes: bool) -> str | None:
        """Return the balloon a step works on; None when that cannot be known.

        Args:
            path: of the step.
            named: the balloon that it names.
            makes: whether it makes something and names no balloon at all.
        """
        known = list(self._balloons)
        if named is not None:
            if named in self._balloons:
                return named
            if known:
                self.complain((*path, "balloon"), unknown("balloon", named, known))
            return None
        if len(known) > 1 and makes:
            self.complain(path, f"does not say on which balloon, expected balloon: {one_of(known)}")
        return known[0] if len(known) == 1 else None

    def make(self, name: str, path: Path, balloon: str | None, *, closed: bool = False) -> None:
        """Make a bubble behind those that are there, `closed` if its two ends become one."""
        if name in self._made_at:
            first = path_text(self._made_at[name])
            self.complain(path, f"bubble {quoted(name)} was made at {first}, expected a new name")
            return
        self._made_at[name] = path
        self._bubbles[name] = None
        if balloon is None:
            return
        if balloon in self._ended:
            end = path_text(self._ended[balloon])
            what = f"balloon {quoted(balloon)} has ended at {end}, expected nothing made of it after its rest"
            self.complain(path, what)
        at = len(self._balloons[balloon])
        self._balloons[balloon].append(name)
        self._bubbles[name] = (balloon, at)
        if closed:
            self._joints.merge([(balloon, at), (balloon, at + 1)])

    def end(self, balloon: str | None, path: Path) -> None:
        """Let nothing more be made of a balloon."""
        if balloon is not None:
            self._ended.setdefault(balloon, path)

    def find(self, name: str, path: Path, rests: Iterable[str] = ()) -> bool:
        """Say whether a bubble exists by now, and complain if it does not; `rests` could be meant, too."""
        if name in self._made_at:
            return True
        later = self._made_ever.get(name)
        if later is not None:
            what = f"bubble {quoted(name)} does not exist yet, it is made at {path_text(later)}"
            self.complain(path, f"{what}: expected this step after that one")
        elif len(name) <= NAME_LIMIT and not self.full:
            self.complain(path, unknown("bubble", name, [*self._made_at, *rests]))
        elif not self.full:
            self.complain(path, f"unknown bubble {quoted(name)}")
        return False

    def find_whole(self, name: str, place: Place, path: Path) -> None:
        """Complain if a bubble, which may be an unnamed rest, does not exist by now."""
        if name not in self._rests:
            self.find(name, path, (rest for rest, found in self._rests.items() if found.last <= place.index))
            return
        rest = self._rests[name]
        if rest.last > place.index:
            what = f"bubble {quoted(name)} does not exist yet"
            later = f"steps[{rest.last}] makes more of {quoted(rest.balloon)}"
            self.complain(path, f"{what}, {later}: expected this step after that one")

    def check_owner(self, path: Path, balloon: str | None, names: Iterable[str]) -> None:
        """Complain of bubbles on another balloon than the one that a step names."""
        if balloon not in self._balloons:
            return
        for name in names:
            if (owner := self._owner(name)) and owner != balloon:
                what = f"bubble {quoted(name)} is on balloon {quoted(owner)}, expected no other balloon named"
                self.complain((*path, "balloon"), what)

    def _owner(self, name: str) -> str | None:
        if vertex := self._bubbles.get(name):
            return vertex[0]
        return self._rests[name].balloon if name in self._rests else None

    def place_of(self, name: str) -> Vertex | None:
        """Return the balloon of a bubble and its number there; None where that is not known."""
        return self._bubbles[name]

    def row(self, balloon: str) -> Sequence[str]:
        """Return the bubbles that are made of a balloon, from its knot on."""
        return self._balloons[balloon]

    def vertex(self, joint: Joint) -> Vertex | None:
        """Return the joint at a bubble's end; None where that is not known."""
        place = self._bubbles[joint.bubble]
        return place and (place[0], place[1] + (joint.end == "end"))

    def join(self, path: Path, vertices: Sequence[Vertex], names: Sequence[str]) -> None:
        """Let joints become one; where two of them are already one, something else was meant."""
        if len({self._joints.root(vertex) for vertex in vertices}) < len(vertices):
            what = f"{', '.join(names)}: these joints are already one, expected different joints"
            self.complain(path, what)
        self._joints.merge(vertices)
