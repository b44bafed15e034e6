"""The workbench: steps are tried on a workpiece, with complaints of what cannot be done."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of, unknown
from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.language.names import is_name, name_of_end
from balloon_usd.language.problem import PROBLEMS_SHOWN, Complaint, Path, path_text, quoted
from balloon_usd.operations.insertions import Insertions
from balloon_usd.operations.workpiece import Workpiece

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence


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


class Workbench:
    """A workpiece in the making, and complaints about steps that cannot be done to it."""

    def __init__(
        self,
        balloons: Iterable[str],
        made_ever: Mapping[str, Path],
        rests: Mapping[str, UnnamedRest],
        pumped: Mapping[str, Path],
        rows: Mapping[str, Sequence[str]],
        rounds: Mapping[str, bool],
    ) -> None:
        """Begin with balloons of which nothing is made.

        Args:
            balloons: their names.
            made_ever: where each bubble is made that any step makes, for words about steps in a wrong order.
            rests: what is left of balloons in the end, by the names that it gets.
            pumped: where each balloon is blown up that is not so from the beginning.
            rows: all bubbles that steps make of each balloon, from its knot on.
            rounds: which of them are round, and whether they are hearts.
        """
        self.complaints: list[Complaint] = []
        self._balloons = tuple(balloons)
        self.piece = Workpiece(self._balloons)
        self._made_at: dict[str, Path] = {}
        self._popped_at: dict[str, Path] = {}
        self._cut_at: dict[str, Path] = {}
        self._tipped_at: dict[str, Path] = {}
        self._curved_at: dict[str, tuple[str, Path]] = {}
        self._wound_at: dict[str, Path] = {}
        """Where bubbles were wound or plaited."""
        self._ended: dict[str, Path] = {}
        self._tied_at: dict[str, Path] = {}
        """Where the tip behind a rest was tied."""
        self._made_ever, self._rests = made_ever, rests
        self._pumped, self._rows, self._rounds = pumped, rows, rounds
        self._told_round: set[Path] = set()
        """Steps of which is told that they take no round balloon."""
        self._insertions = Insertions(made_ever, pumped)
        self._told_flat: set[str] = set()
        """Balloons of which was told that they are worked on while they are flat."""

    @property
    def full(self) -> bool:
        """More complaints than anybody reads."""
        return len(self.complaints) > PROBLEMS_SHOWN

    def complain(self, path: Path, text: str) -> None:
        """Note that something makes no sense."""
        self.complaints.append(Complaint(path, text))

    def balloon_of(self, path: Path, named: str | None, *, makes: bool, twists: bool = False) -> str | None:
        """Return the balloon a step works on; None when that cannot be known.

        Args:
            path: of the step.
            named: the balloon that it names.
            makes: whether it makes something and names no balloon at all.
            twists: whether that is twisted off, as of tubes alone.
        """
        known = self._balloons
        if named is not None:
            if named in known:
                return named
            if known:
                self.complain((*path, "balloon"), unknown("balloon", named, known))
            return None
        if len(known) > 1 and makes:
            may = [name for name in known if not (twists and name in self._rounds)] or known
            self.complain(path, f"does not say on which balloon, expected balloon: {one_of(may)}")
        return known[0] if len(known) == 1 else None

    def blow_up(self, balloon: str, path: Path) -> None:
        """Complain of a balloon that is not there, or is blown up already."""
        if balloon not in self._balloons:
            if self._balloons:
                self.complain(path, unknown("balloon", balloon, self._balloons))
        elif path != (first := self._pumped[balloon]):
            what = f"balloon {quoted(balloon)} is blown up at {path_text(first)}, expected each balloon once"
            self.complain(path, what)

    def require_blown_up(self, place: Place, balloon: str | None, bubbles: Iterable[str]) -> None:
        """Complain of work on a balloon, or on bubbles of one, before it is blown up: once a balloon."""
        for name in dict.fromkeys([balloon, *map(self._owner, bubbles)]):
            later = None if name is None else self._pumped.get(name)
            if name is None or later is None or int(later[1]) <= place.index or name in self._told_flat:
                continue
            self._told_flat.add(name)
            what = f"balloon {quoted(name)} is flat until {path_text(later)} blows it up"
            self.complain(place.path, f"{what}: expected this step after that one")

    def is_of_round(self, name: str) -> bool:
        """Say whether a bubble is a round balloon, or twisted off one."""
        return self._owner(name) in self._rounds

    def is_round_end(self, name: str) -> bool:
        """Say whether a bubble is a round balloon, or what twists leave of one: its end is no joint."""
        made = self.piece.bubbles.get(name)
        return self.is_of_round(name) and (made is None or made.last)

    def rounds_among(self, balloon: str | None, bubbles: Iterable[str]) -> dict[str, bool]:
        """Return those of a balloon, and of some bubbles, that are round, and whether they are hearts."""
        owners = dict.fromkeys([balloon, *map(self._owner, bubbles)])
        return {name: self._rounds[name] for name in owners if name is not None and name in self._rounds}

    def refuse_rounds(self, word: str, path: Path, refused: Mapping[str, bool], *, rounds: bool) -> None:
        """Complain of a step of a word that takes no such round balloons; told is whether they are hearts.

        `rounds`: whether it takes those that are none.
        """
        for name, heart in refused.items():
            what = f"takes no {'heart' if heart else 'round balloon'}, and {quoted(name)} is one"
            self.complain((*path, word), f"{what}, expected a tube{' or a round balloon' if rounds else ''}")
            self._told_round.add(path)

    def note_use(self, path: Path, bubbles: Iterable[str]) -> None:
        """Take note of the bubbles on which a step works: hands reach none that lies in another balloon."""
        self._insertions.used += [(path, name) for name in bubbles]

    def insert(self, balloon: str, bubble: str, path: Path) -> None:
        """Put a flat balloon where a bubble of another will be."""
        put_in = self._insertions.put_in
        if balloon not in self._balloons:
            if self._balloons:
                self.complain(path, unknown("balloon", balloon, self._balloons))
        elif balloon in put_in:
            bubble, at = put_in[balloon]
            what = f"balloon {quoted(balloon)} was put into {bubble} at {path_text(at)}"
            self.complain(path, f"{what}, expected each balloon once")
        elif bubble in self._made_at:
            what = f"bubble {quoted(bubble)} was made at {path_text(self._made_at[bubble])}"
            self.complain(path, f"{what}, expected this step before the balloon is blown up")
        else:
            put_in[balloon] = bubble, path

    def lay_in(self, piece: Workpiece) -> None:
        """Put balloons into bubbles of a finished workpiece, and complain of those that hands get nowhere."""
        self.complaints += self._insertions.lay_in(piece, self._cut_at | self._popped_at)

    def make(self, name: str, path: Path, balloon: str | None, *, last: bool = False) -> bool:
        """Make a bubble behind those that are there, and say whether it is new.

        `last`: nothing more is made of the balloon.
        """
        if name in self._made_at:
            first = path_text(self._made_at[name])
            self.complain(path, f"bubble {quoted(name)} was made at {first}, expected a new name")
            return False
        self._made_at[name] = path
        if balloon is None:
            return True
        # Of what cannot be made of a round one is told that alone.
        if balloon in self._ended and path[:2] not in self._told_round:
            end = path_text(self._ended[balloon])
            what = f"balloon {quoted(balloon)} has ended at {end}, expected nothing made of it after its rest"
            self.complain(path, what)
        if last:
            self._ended.setdefault(balloon, path)
        self.piece.make(int(path[1]), name, balloon, last=last)
        return True

    def pop(self, name: str, path: Path) -> None:
        """Burst a bubble that is there, whole, and of which each neighbour is shut for good."""
        if not self.has_name(name, path) or not self.find_firm(name, path) or name not in self.piece.bubbles:
            return
        if (twist := self._open_twist(name)) is not None:
            what = f"the twist {twist} would let the gas of both out"
            self.complain(path, f"{what}, expected an ear or a lock there first")
            return
        if self.piece.row(self.piece.bubbles[name].balloon) == [name]:
            more = "" if self.piece.bubbles[name].last else ", or this step after more is made of it"
            what = f"bubble {quoted(name)} is all that there is of its balloon"
            self.complain(path, f"{what}, expected another{more}")
            return
        self._popped_at[name] = path
        self.piece.pop(int(path[1]), name)

    def cut(self, name: str, path: Path) -> None:
        """Cut off a bubble at an end of its balloon, which is popped if it was not."""
        if name in self._cut_at:
            at = path_text(self._cut_at[name])
            self.complain(path, f"bubble {quoted(name)} was cut off at {at}, expected each once")
            return
        if name in self.piece.bubbles and not self._has_free_end(name):
            what = f"both ends of {quoted(name)} hang on something"
            self.complain(path, f"{what}, expected a bubble at an end of its balloon that hangs on nothing")
            return
        if name not in self._popped_at:
            self.pop(name, path)
        if name in self._popped_at:
            self._cut_at[name] = path

    def _has_free_end(self, name: str) -> bool:
        row = self.piece.row(self.piece.bubbles[name].balloon)
        free = [end for end, at in ((Joint(name, "start"), 0), (Joint(name, "end"), -1)) if row[at] == name]
        return any(len(self.piece.joint(end)) == 1 for end in free)

    def has_name(self, name: str, path: Path) -> bool:
        """Say whether what a step names got its name before, and complain if that is yet to come."""
        if name in self._rests and name not in self._made_at:
            what = f"bubble {quoted(name)} has no name of its own yet"
            self.complain(path, f"{what}, expected a step before that gives it one: rest: NAME")
            return False
        return True

    def _open_twist(self, name: str) -> str | None:
        """Return which twist at an end of a bubble only itself holds, in words; None where all hold."""
        for end in ends_of(name):
            joint = self.piece.joint(end)
            if self.piece.is_merged(joint):
                continue
            others = [each.bubble for each in joint if each != end]
            if others:
                return f"between {quoted(name)} and {quoted(others[0])}"
            if end in self.piece.open_ends.values():
                return f"behind {quoted(name)}"
        return None

    def tip(self, name: str, place: Place, path: Path) -> None:
        """Stretch the tip of what is left of a balloon, once."""
        known = len(self.complaints)
        self.find_rest(name, place, path)
        if len(self.complaints) > known:
            return
        if name in self._tipped_at:
            at = path_text(self._tipped_at[name])
            self.complain(path, f"the tip of {quoted(name)} was stretched at {at}, expected each tip once")
        self._tipped_at.setdefault(name, path)

    def curve(self, word: str, name: str, place: Place, *, once: bool) -> None:
        """Lead a bubble that is there onto a curve by a step of a word.

        `once`: what such a step curves is left so, and was straight before.
        """
        path = (*place.path, word, name)
        known = len(self.complaints)
        self.find_whole(name, place, path)
        if len(self.complaints) > known:
            return
        if not self._is_unwound(name, path, "this step before that one, or another bubble"):
            return
        before, at = self._curved_at.get(name, (word, None))
        if at is not None and (once or before != word):
            expected = "that once" if before == word else f"{before} or {word} alone"
            self.complain(path, f"bubble {quoted(name)} was curved at {path_text(at)}, expected {expected}")
        self._curved_at.setdefault(name, (word, path))

    def wind(self, names: Sequence[str], path: Path) -> None:
        """Lead bubbles about each other, which hold none and are held by none."""
        for contact in self.piece.holding():
            if contact.kind != "wrap" and not {contact.bubble, *contact.others}.isdisjoint(names):
                what = f"step {contact.step + 1} {contact.text}, {contact.which_hold}"
                self.complain(path, f"{what}: expected bubbles between which nothing lies")
                return
        self._wound_at |= dict.fromkeys(names, path)

    def is_open(self, ring: Iterable[str], path: Path) -> bool:
        """Say whether anything goes between some bubbles; complain if they are wound about each other."""
        return all(self._is_unwound(name, path, "bubbles with room between them") for name in ring)

    def _is_unwound(self, name: str, path: Path, expected: str) -> bool:
        if name in self._wound_at:
            what = f"{name} is wound or plaited at {path_text(self._wound_at[name])}"
            self.complain(path, f"{what}, expected {expected}")
        return name not in self._wound_at

    def close_tip(self, name: str, path: Path) -> bool:
        """Let what is left of a balloon end in a joint, once; say whether it can."""
        if name in self._tipped_at:
            at = path_text(self._tipped_at[name])
            self.complain(path, f"the tip of {quoted(name)} is a ball since {at}, expected a flat one")
        elif name in self._tied_at:
            at = path_text(self._tied_at[name])
            self.complain(path, f"the tip of {quoted(name)} was tied at {at}, expected each tip once")
        elif self.is_round_end(name):
            what = f"{name} is a round balloon, which has no flat tip"
            self.complain(path, f"{what}, expected {self._round_start(name)}")
        elif self.piece.is_merged([Joint(name, "end")]):
            what = f"{name}.end is joined to others before its tip is closed"
            self.complain(path, f"{what}, expected this step before that one")
        elif any((each.kind, each.bubble) == ("thread", name) for each in self.piece.contacts):
            what = f"bubble {quoted(name)} is threaded through a ring, of which it would be pulled out"
            self.complain(path, f"{what}, expected thread or tie alone")
        else:
            self._tied_at[name] = path
        return self._tied_at.get(name) == path

    def find_firm(self, name: str, path: Path, rests: Iterable[str] = ()) -> bool:
        """Say whether a bubble exists by now and has its gas, and complain if it does not; as `find`."""
        if not self.find(name, path, rests):
            return False
        if name in self._popped_at:
            at = path_text(self._popped_at[name])
            self.complain(path, f"bubble {quoted(name)} was popped at {at}, expected one that has its gas")
            return False
        return True

    def find_joint(self, end: Joint, path: Path) -> bool:
        """Say whether a joint is there by now on which more hangs than a popped bubble; complain if not."""
        if not self.find(end.bubble, path):
            return False
        if end.end == "end" and self.is_round_end(end.bubble):
            what = f"{end} is the far side of a round balloon"
            self.complain(path, f"{what}, expected {self._round_start(end.bubble)}")
            return False
        if end.bubble not in self.piece.bubbles or end.bubble not in self._popped_at:
            return True
        if all(each.bubble in self._popped_at for each in self.piece.joint(end)):
            at = path_text(self._popped_at[end.bubble])
            what = f"bubble {quoted(end.bubble)} was popped at {at}, and nothing else hangs on {end}"
            self.complain(path, f"{what}, expected a joint of a bubble that has its gas")
            return False
        return True

    def close(self, name: str, path: Path) -> None:
        """Let the two ends of a new bubble become one."""
        if name in self.piece.bubbles:
            self.piece.join(int(path[1]), ends_of(name))

    def find(self, name: str, path: Path, rests: Iterable[str] = ()) -> bool:
        """Say whether a bubble exists by now, and complain if it does not; `rests` could be meant, too."""
        if name in self._cut_at:
            at = path_text(self._cut_at[name])
            self.complain(path, f"bubble {quoted(name)} was cut off at {at}, expected one that is there")
            return False
        if name in self._made_at:
            return True
        later = self._made_ever.get(name)
        if later is not None:
            what = f"bubble {quoted(name)} does not exist yet, it is made at {path_text(later)}"
            self.complain(path, f"{what}: expected this step after that one")
        elif is_name(name) and not self.full:
            # Of what is no name is told where it stands.
            self.complain(path, self._unknown(name, rests))
        return False

    def _unknown(self, name: str, rests: Iterable[str]) -> str:
        """Say that there is no bubble of a name, and what was meant."""
        if name in self._balloons:
            named = f"expected the name of a bubble of it, such as {{rest: NAME, balloon: {name}}} gives"
            return f"{quoted(name)} is a balloon, {named}"
        return unknown("bubble", name, [*self._made_at, *rests])

    def find_rest(self, name: str, place: Place, path: Path) -> None:
        """Complain unless a bubble is what is left of a balloon by now, and has its gas."""
        known = len(self.complaints)
        self.find_whole(name, place, path)
        if len(self.complaints) == known and name not in self._rests:
            self.has_tail(name, path)

    def with_next(self, name: str, place: Place) -> Workpiece:
        """Return the workpiece as it is, what is left of a balloon as its last bubble where the next that is
        made of it has a name.
        """
        balloon = self._owner(name)
        if balloon is None or self._next(balloon) != name:
            return self.piece
        found = self.piece.after(place.index)
        found.make(place.index, name, balloon, last=True)
        return found

    def find_left(self, name: str, path: Path) -> bool:
        """Say whether a bubble may be what is left of a balloon; complain if it is made after another, or by
        no step.
        """
        owner = self._owner(name)
        other = None if owner is None or name in self._made_at else self._next(owner)
        if other not in (None, name):
            what = f"bubble {quoted(name)} is made after {quoted(other)}"
            self.complain(path, f"{what}, expected {quoted(other)}, with which what is left begins")
        elif owner is None and name not in self._made_ever and is_name(name):
            left = list(self._left())
            later = f"no step makes bubble {quoted(name)}, expected rest: {name} in a step after this one"
            self.complain(path, unknown("bubble", name, left) if left else later)
        else:
            return True
        return False

    def _left(self) -> Iterator[str]:
        """Yield what is left of each balloon that is begun, by the bubble made of it next, or its rest."""
        for balloon in self.piece.balloons:
            last = self.piece.row(balloon)[-1]
            if (name := self._next(balloon)) or self.piece.bubbles[last].last:
                yield name or last

    def _next(self, balloon: str) -> str | None:
        return next((each for each in self._rows[balloon] if each not in self._made_at), None)

    def has_tail(self, name: str, path: Path, *, expected: str = "its rest") -> bool:
        """Say whether a bubble that is there is what is left of a balloon, and complain if it is not."""
        if name in self._tied_at:
            at = path_text(self._tied_at[name])
            self.complain(path, f"the tip of {quoted(name)} was tied at {at}, expected one that is free")
            return False
        if name in self.piece.bubbles and not self.piece.bubbles[name].last:
            what = f"bubble {quoted(name)} is not what is left of a balloon"
            self.complain(path, f"{what}, expected {expected}")
            return False
        return True

    def find_whole(self, name: str, place: Place, path: Path) -> None:
        """Complain if a bubble, which may be an unnamed rest, does not exist by now."""
        if name not in self._rests:
            rests = (rest for rest, found in self._rests.items() if found.last <= place.index)
            self.find_firm(name, path, rests)
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

    def _round_start(self, name: str) -> str:
        """The joint at which a round balloon, or what twists leave of one, begins."""
        owner = self._owner(name)
        twisted = owner is not None and self._rows[owner][:1] != [name]
        return f"{name}.start" if twisted else f"{name}.start, its nozzle"

    def _owner(self, name: str) -> str | None:
        if made := self.piece.bubbles.get(name):
            return made.balloon
        if name in self._rests:
            return self._rests[name].balloon
        return next((balloon for balloon, row in self._rows.items() if name in row), None)

    def knows(self, names: Iterable[str]) -> bool:
        """Whether it is known on which balloon each of these bubbles is."""
        return all(name in self.piece.bubbles for name in names)

    def join(self, path: Path, ends: Sequence[Joint], names: Sequence[str]) -> None:
        """Let joints become one; where two of them are already one, something else was meant."""
        if self.piece.are_one(ends):
            what = f"{', '.join(names)}: these joints are already one, expected different joints"
            self.complain(path, what)
        self.piece.join(int(path[1]), ends)

    def finished(self, steps: int) -> Workpiece:
        """Return the workpiece, with the unnamed rests and the tied tips of its balloons, made after so many
        steps.
        """
        for name, rest in self._rests.items():
            self.piece.make(steps, name, rest.balloon, last=True)
        for tied in self._tied_at:
            balloon = self.piece.bubbles[tied].balloon
            self.piece.make(steps, name_of_end(balloon, "tip", self._made_ever), balloon, last=True)
        self.lay_in(self.piece)
        return self.piece
