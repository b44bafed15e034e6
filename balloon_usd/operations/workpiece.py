"""The workpiece: what the hands have made of the balloons so far, and the questions that operations ask."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, TypeAlias

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.operations.connections import Connections
from balloon_usd.operations.disjoint_sets import DisjointSets

if TYPE_CHECKING:
    from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence

ContactKind = Literal["roll", "push", "tuck", "thread", "tulip_link", "wrap"]
_BROUGHT: dict[ContactKind, str] = {
    "roll": "rolls {0} between {1}",
    "push": "pushes {0} through {1}",
    "tuck": "tucks {0} between {1}",
    "thread": "threads {0} through {1}",
    "tulip_link": "presses {0} into {1}",
    "wrap": "wraps {1} round the neck of {0}",
}
_TUCKED_INTO = "tucks {0} into {1}"


_LEAVING_FREE = ("thread", "tulip_link", "wrap")
"""Contacts in which a ring or a tulip holds the start of a bubble alone: its end may turn."""


@dataclass(frozen=True)
class Made:
    """A bubble was made behind those that its balloon had, or is what was left of it."""

    step: int
    """Index of the step."""
    bubble: str
    balloon: str
    last: bool = False
    """Whether it is the rest of its balloon, behind which nothing is made."""


@dataclass(frozen=True)
class Joined:
    """Joints became one."""

    step: int
    ends: tuple[Joint, ...]
    """One bubble end of each."""


@dataclass(frozen=True)
class Cut:
    """A balloon was cut through at a joint: its bubbles are two trails from then on."""

    step: int
    end: Joint
    """The joint as the end of the bubble before it."""


@dataclass(frozen=True)
class Contact:
    """A bubble was brought to where others hold it without a common joint."""

    step: int
    kind: ContactKind
    bubble: str
    others: tuple[str, ...]
    ring: bool = True
    """Whether these formed one closed ring then, without which nothing holds it."""

    def is_left_by(self, bubbles: Container[str]) -> bool:
        """Whether what others hold, or one of these, comes along with some bubbles alone: what is wrapped
        round a neck comes along with it.
        """
        return self.kind != "wrap" and len({each in bubbles for each in (self.bubble, *self.others)}) > 1

    @property
    def would_leave(self) -> str:
        """What would happen if just one of both were moved, in words."""
        return f"would take {self.bubble} away from {all_of(self.others)}, {self.which_hold}"

    @property
    def which_hold(self) -> str:
        """That the others hold it, in words that follow their names."""
        return f"which {'holds' if len(self.others) == 1 else 'hold'} it"

    @property
    def text(self) -> str:
        """What was done, in words: `pushes nose through left_ear, right_ear`."""
        words = _TUCKED_INTO if self.kind == "tuck" and len(self.others) == 1 else _BROUGHT[self.kind]
        return words.format(self.bubble, ", ".join(self.others))


@dataclass(frozen=True)
class Popped:
    """A bubble was burst: what is left of its rubber keeps nothing from turning."""

    step: int
    bubble: str


@dataclass(frozen=True)
class Inserted:
    """A balloon was put where a bubble of another will be."""

    step: int
    balloon: str
    bubble: str


@dataclass(frozen=True)
class Limb:
    """A part of a figure that hangs on one joint."""

    joint: Joint
    """One end of a bubble in this joint."""
    bubbles: frozenset[str]
    """All that hangs there together."""


Event: TypeAlias = Made | Joined | Cut | Contact | Popped | Inserted


class Workpiece:
    """Balloons as trails of bubbles, joints that became one, contacts, and how all that came about.

    Each effect takes the index of the step that has it, so that the workpiece can be had as it was after any.
    """

    def __init__(self, balloons: Iterable[str]) -> None:
        """Begin with balloons of which nothing is made."""
        self.history: list[Event] = []
        self._made: dict[str, Made] = {}
        self._trails: dict[str, list[list[str]]] = {name: [] for name in balloons}
        self._joints: DisjointSets[Joint] = DisjointSets()
        self._brought: set[Joint] = set()
        """Ends that a step brought together with others."""
        self._popped: set[str] = set()
        self._known: Connections | None = None
        """What hangs together, if it was asked for since the last event."""
        self._known_stiff: Connections | None = None
        """The same without what is limp."""

    def __getstate__(self) -> dict[str, object]:
        """Leave out what follows from the rest."""
        return self.__dict__ | {"_known": None, "_known_stiff": None}

    # Effects.

    def make(self, step: int, bubble: str, balloon: str, *, last: bool = False) -> None:
        """Make a new bubble behind those of a balloon, which begins with its first."""
        self._do(Made(step, bubble, balloon, last))

    def join(self, step: int, ends: Iterable[Joint]) -> None:
        """Let joints become one."""
        self._do(Joined(step, tuple(ends)))

    def cut(self, step: int, end: Joint) -> None:
        """Cut a balloon through at a joint between two of its bubbles.

        Raises:
            ValueError: no bubble of the balloon follows.
        """
        self._do(Cut(step, end))

    def touch(self, step: int, kind: ContactKind, bubble: str, others: Iterable[str]) -> None:
        """Let others hold a bubble that lies between them, or goes through the ring that they form."""
        named = tuple(others)
        self._do(Contact(step, kind, bubble, named, self.is_closed(named)))

    def insert(self, step: int, balloon: str, bubble: str) -> None:
        """Put a balloon where a bubble of another will be."""
        self._do(Inserted(step, balloon, bubble))

    def pop(self, step: int, bubble: str) -> None:
        """Burst a bubble."""
        self._do(Popped(step, bubble))

    def _do(self, event: Event) -> None:
        if isinstance(event, Made):
            self._make(event)
        elif isinstance(event, Joined):
            self._joints.merge(event.ends)
            self._brought.update(event.ends)
        elif isinstance(event, Cut):
            self._cut(event.end)
        elif isinstance(event, Popped):
            self._popped.add(event.bubble)
        self.history.append(event)
        self._known = self._known_stiff = None

    def _make(self, made: Made) -> None:
        trails = self._trails[made.balloon]
        if trails:
            self._joints.merge([Joint(trails[-1][-1], "end"), Joint(made.bubble, "start")])
            trails[-1].append(made.bubble)
        else:
            trails.append([made.bubble])
        self._made[made.bubble] = made

    def _cut(self, end: Joint) -> None:
        trails = self._trails[self._made[end.bubble].balloon]
        trail = next(trail for trail in trails if end.bubble in trail)
        after = trail.index(end.bubble) + 1
        if end.end != "end" or after == len(trail):
            raise ValueError(f"{end} does not part two bubbles of one balloon")
        at = trails.index(trail)
        trails[at : at + 1] = [trail[:after], trail[after:]]
        self._join_anew()

    def _join_anew(self) -> None:
        """Merge what is one: sets that grew together cannot be parted."""
        self._joints = DisjointSets()
        for trail in self.trails:
            for before, behind in pairwise(trail):
                self._joints.merge([Joint(before, "end"), Joint(behind, "start")])
        for event in self.history:
            if isinstance(event, Joined):
                self._joints.merge(event.ends)

    # The workpiece as it was.

    def after(self, step: int, without: Container[int] = ()) -> Workpiece:
        """Return the workpiece as it was after a step, what was left of its balloons as their last bubbles.

        Args:
            step: its index.
            without: steps whose joints have come apart again.
        """
        found = Workpiece(self._trails)
        for event in self.history:
            if event.step <= step and not (isinstance(event, Joined) and event.step in without):
                found._do(event)
        begun = set(found.balloons)
        for made in self._made.values():
            if made.last and made.balloon in begun and made.bubble not in found._made:
                found._do(made)
                found._call_left(self.row(made.balloon), made)
        return found

    def _call_left(self, names: Container[str], left: Made) -> None:
        """Let contacts of bubbles of some names that are not made yet be of what is left of their balloon."""
        for at, event in enumerate(self.history):
            if isinstance(event, Contact) and event.bubble in names and event.bubble not in self._made:
                self.history[at] = replace(event, bubble=left.bubble)

    # What there is.

    @property
    def bubbles(self) -> Mapping[str, Made]:
        """How every bubble was made, by its name."""
        return self._made

    @property
    def balloons(self) -> tuple[str, ...]:
        """Balloons that are begun."""
        return tuple(balloon for balloon, trails in self._trails.items() if trails)

    @property
    def trails(self) -> tuple[tuple[str, ...], ...]:
        """Bubbles that follow each other along a balloon, from its knot on; a cut balloon has several."""
        return tuple(tuple(trail) for trails in self._trails.values() for trail in trails)

    def row(self, balloon: str) -> Sequence[str]:
        """Return all bubbles of a balloon, from its knot on."""
        return [bubble for trail in self._trails.get(balloon, ()) for bubble in trail]

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Bubbles that others hold without a common joint."""
        return tuple(event for event in self.history if isinstance(event, Contact))

    @property
    def popped(self) -> frozenset[str]:
        """Bubbles that have been burst."""
        return frozenset(self._popped)

    @property
    def joints(self) -> tuple[tuple[Joint, ...], ...]:
        """Bubble ends that are one, by balloon and along it; each joint where its first end comes."""
        members: dict[Joint, list[Joint]] = {}
        for trail in self.trails:
            for end in (Joint(bubble, side) for bubble in trail for side in ("start", "end")):
                members.setdefault(self._joints.root(end), []).append(end)
        return tuple(map(tuple, members.values()))

    @property
    def open_ends(self) -> Mapping[str, Joint | None]:
        """Where what is left of every begun balloon begins, behind its last bubble; of ended ones None."""
        last = {name: self._made[self._trails[name][-1][-1]] for name in self.balloons}
        return {name: None if made.last else Joint(made.bubble, "end") for name, made in last.items()}

    @property
    def chambers(self) -> tuple[tuple[str, ...], ...]:
        """Bubbles that share their gas: each has its own once it is twisted off."""
        return tuple((bubble,) for trail in self.trails for bubble in trail)

    # What operations ask.

    def are_one(self, ends: Sequence[Joint]) -> bool:
        """Whether some of these joints are the same already."""
        return len({self._joints.root(end) for end in ends}) < len(ends)

    def joint(self, end: Joint) -> tuple[Joint, ...]:
        """Return all bubble ends that are one with this."""
        root = self._joints.root(end)
        return next(ends for ends in self.joints if self._joints.root(ends[0]) == root)

    def is_free(self, end: Joint) -> bool:
        """Whether nothing hangs on an end by now, nor is left of its balloon there."""
        return len(self.joint(end)) == 1 and end not in self.open_ends.values()

    def is_merged(self, ends: Iterable[Joint]) -> bool:
        """Whether a step brought several joints together in the one that has all these ends."""
        return not self._brought.isdisjoint(ends)

    def is_closed(self, bubbles: Iterable[str]) -> bool:
        """Whether bubbles form one closed ring by now, such as a loop, or the two of a lock twist."""
        ends = {bubble: self._ends(bubble) for bubble in bubbles}
        meeting = Counter(joint for joints in ends.values() for joint in joints)
        return len(Connections(ends).pieces()) == 1 and set(meeting.values()) == {2}

    @property
    def inside(self) -> dict[str, str]:
        """The bubble in which each balloon lies that lies in another."""
        return {event.balloon: event.bubble for event in self.history if isinstance(event, Inserted)}

    def bridges(self) -> frozenset[str]:
        """Return the bubbles that belong to no closed ring; one of which a bubble is popped is open."""
        return self._stiff.bridges

    def blocks(self) -> list[frozenset[str]]:
        """Return the bubbles of each part that no joint alone holds together, in the order of their first
        ones; popped ones hold nothing.
        """
        return self._stiff.blocks()

    def pieces(self) -> list[frozenset[str]]:
        """Return the bubbles of each connected piece, in the order of their first ones."""
        return self._connections.pieces()

    def free_joints(self) -> list[tuple[Joint, ...]]:
        """Return the joints that unwind when they are let go.

        That is where just two bubbles meet, not brought together by any step, and neither belongs to a closed
        ring, lies in one, or in a row that leads back into one: there, turning one bubble would have to turn
        the ring. What is behind a bubble that was threaded, or round whose neck another is wrapped, is free,
        and so is what hangs on one that is set between others.
        """
        free = self.bridges() - self.gripped() - self._in_rows()
        behind = {end for contact in self.contacts for end in self._left_free(contact)}
        return [
            ends
            for ends in self.joints
            if len(ends) == 2
            and not self.is_merged(ends)
            and all(end.bubble in free or end in behind for end in ends)
        ]

    def _left_free(self, contact: Contact) -> Iterator[Joint]:
        """Yield the ends of a bubble that may turn where others hold it."""
        if contact.kind == "tuck":
            for end in ends_of(contact.bubble):
                if contact.others[0] not in self.hangs_on(end):
                    yield end
        elif contact.kind in _LEAVING_FREE:
            yield Joint(contact.bubble, "end")

    def hangs_with(self, bubble: str) -> frozenset[str]:
        """Return the bubbles that hang together with one, and itself, without what is popped."""
        return self._stiff.reached(self._ends(bubble)[0])

    def free_to_spin(self, end: Joint) -> bool:
        """Whether a joint unwinds when it is let go."""
        return any(end in ends for ends in self.free_joints())

    def hangs_on(self, end: Joint) -> frozenset[str]:
        """Return what hangs on one end of a bubble: all other bubbles that come along when it is moved."""
        return self._stiff.reached(self._joints.root(end), without=end.bubble)

    @property
    def has_limbs(self) -> bool:
        """Whether anything hangs on one joint: of a closed net nothing does."""
        return any(True for _ in self._stiff.hinges())

    def limb(self, bubble: str, apart: Collection[str] = ()) -> Limb | None:
        """Return the smallest part of a figure that has a bubble, and none of some others, and hangs on one
        joint; None where no joint parts it from the rest.
        """
        whole, open_ends = self._stiff, {self._joints.root(end) for end in self.open_ends.values() if end}
        best: tuple[int, Limb] | None = None
        ends = {name: self._ends(name) for name in whole.reached(self._ends(bubble)[0])}
        for joint in dict.fromkeys(end for name in (bubble, *ends) for end in self._ends(name)):
            part = whole.beyond(bubble, joint)
            if not part.isdisjoint(apart) or (whole.at(joint) <= part and joint not in open_ends):
                continue
            inner = {end for name in part for end in ends[name]} - {joint}
            size = len(part) + len(inner & open_ends)
            if best is None or size < best[0]:
                best = size, Limb(joint, part)
        return None if best is None else self._with_wrapped(best[1])

    def _with_wrapped(self, limb: Limb) -> Limb:
        """Return a limb with all that is wrapped round a neck of it, or whose neck it is wrapped round."""
        parts = limb.bubbles
        for contact in self.contacts:
            row = self.row_from(contact.others, contact.bubble) if contact.kind == "wrap" else None
            ring = contact.others[0]
            if row and limb.joint == self._ends(ring)[0] and not parts.isdisjoint((ring, row[0])):
                parts |= self._stiff.beyond(ring, limb.joint) | self._stiff.beyond(row[0], limb.joint)
        return Limb(limb.joint, parts)

    def row_from(self, ring: Iterable[str], bubble: str) -> tuple[str, ...] | None:
        """Return the bubbles of its balloon between a joint of a ring and the start of a bubble, without ears
        and loops; None where more than these hangs there, or it is not made yet.
        """
        corners = {joint for each in ring for joint in self._ends(each)}
        trail = next((trail for trail in self.trails if bubble in trail), None)
        if trail is None:
            return None
        found: list[str] = []
        beside = {self._ends(bubble)[0]: {bubble}}
        """Bubbles of the row at each of its joints."""
        at = self._ends(bubble)[0]
        for name in reversed(trail[: trail.index(bubble)]):
            start, end = self._ends(name)
            if at in corners or name in self._popped:
                break
            beside[at].add(name)
            if start != end:
                if start in beside:
                    return None
                found.insert(0, name)
                beside[start] = {name}
                at = start
        beside.pop(at)
        alone = all({each.bubble for each in self.joint(joint)} == names for joint, names in beside.items())
        return tuple(found) if at in corners and alone else None

    def gripped(self) -> frozenset[str]:
        """Return the bubbles that others hold which still form a closed ring, if they did."""
        return frozenset(each.bubble for each in self.holding())

    def holding(self) -> list[Contact]:
        """Return the contacts in which a bubble is held: their ring closed, and no other popped."""
        firm = (each for each in self.contacts if self._popped.isdisjoint(each.others))
        return [each for each in firm if self.is_closed(each.others) or not each.ring]

    def left_by(self, bubbles: Container[str]) -> Contact | None:
        """Return a contact in which a bubble is held that would be parted from what holds it if some bubbles
        were moved alone.
        """
        return next((each for each in self.holding() if each.is_left_by(bubbles)), None)

    def _in_rows(self) -> frozenset[str]:
        """Return the bubbles of rows that lead from a ring back into it, or from others to what they hold."""
        found: set[str] = set()
        for each in self.holding():
            if each.kind == "tuck":
                found.update(self._row_between(each.bubble, each.others))
            else:
                found.update(self.row_from(each.others, each.bubble) or ())
        return frozenset(found)

    def _row_between(self, bubble: str, others: Iterable[str]) -> Iterator[str]:
        """Yield the bubbles by each of which alone a bubble hangs on all of some others."""
        for name in self.bridges() - {bubble, *others}:
            one, other = (self.hangs_on(end) for end in ends_of(name))
            if (bubble in one and other.issuperset(others)) or (bubble in other and one.issuperset(others)):
                yield name

    @property
    def _connections(self) -> Connections:
        if self._known is None:
            ends = {bubble: self._ends(bubble) for trail in self.trails for bubble in trail}
            self._known = Connections(ends)
        return self._known

    @property
    def _stiff(self) -> Connections:
        """What hangs together so that it turns together."""
        if not self._popped:
            return self._connections
        if self._known_stiff is None:
            firm = (bubble for trail in self.trails for bubble in trail if bubble not in self._popped)
            self._known_stiff = Connections({bubble: self._ends(bubble) for bubble in firm})
        return self._known_stiff

    def _ends(self, bubble: str) -> tuple[Joint, Joint]:
        """Return the joints of a bubble's start and end, each named by one of its ends."""
        return self._joints.root(Joint(bubble, "start")), self._joints.root(Joint(bubble, "end"))
