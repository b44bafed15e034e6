"""`tulip_link`: the end of another balloon is pressed in with the knot, and a tulip is twisted over it."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.joint import Joint
from balloon_usd.language.lengths import at_most
from balloon_usd.language.names import Name
from balloon_usd.language.problem import quoted
from balloon_usd.language.quantities import Length, length_entry, written_length
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.inverting import INVERT_SECONDS, InvertsBubble, fault_at_knot
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.moves import FaceKnot, PressIn

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import ContactKind, Workpiece

FACE_SECONDS = 2.0
"""Shortest time in which a balloon is turned until it faces the knot of another, s."""
WIDE = 1.4
"""Width of what is pressed in, in that of the tulip's tube, beyond which it may lean: a whole 350 in a 260 by
6 to 15 degrees, a 646 in a 350 by 29, a 260 in a 260 and a ball of 4 cm of a 350 in a 260 by 3 at most.
"""
SECONDS_PER_METRE = 8.0
"""Time for each metre of the longest balloon that is turned, s/m: its end stays below 1.3 m/s."""


class LinkingTulip(Entries):
    """A tulip, and what is pressed into it."""

    bubble: Name
    """The tulip that is made, the first bubble of its balloon."""
    length: Length
    """Its length before the knot is pressed in; m in Python."""
    over: Name
    """The first bubble of another balloon, or all of it, which is pressed in with its knot ahead."""


class TulipLink(InvertsBubble):
    """Press the end of another balloon in with the knot, and twist a tulip over it."""

    word: ClassVar[ContactKind] = "tulip_link"
    value_model: ClassVar[type[Entries] | None] = LinkingTulip
    across: ClassVar[bool] = True
    gas: ClassVar[float] = 0.6
    example: ClassVar[str] = """\
format: 1
name: candle
units: cm
balloons:
  main: {size: 260, color: white, length: 14, tail: 6}
  fire: {size: 160, color: orange, length: 7, tail: 2.5}
steps:
  - rest: flame
    balloon: fire
  - tulip_link: {bubble: socket, length: 7, over: flame}
    balloon: main
  - rest: wax
    balloon: main
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonotherapy.blogspot.com 2013-03: the candle, of two balloons",
    )

    tulip_link: LinkingTulip
    """Press the end of another balloon in with the knot, and twist a tulip over it."""

    @property
    def lengths(self) -> dict[str, float]:
        """The tulip that it makes: its length (m) by its name."""
        return {self.tulip_link.bubble: self.tulip_link.length}

    @property
    def names(self) -> tuple[str, ...]:
        """The tulip, and what is pressed into it."""
        return self.tulip_link.bubble, self.tulip_link.over

    def path_of(self, bubble: str) -> tuple[str, ...]:
        """Return the keys under which the length of its tulip stands."""
        return (self.word, "length")

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        link = self.tulip_link
        return {"bubble": link.bubble, "length": length_entry(link.length, units), "over": link.over}

    @classmethod
    def value_of(cls, units: Units, /, bubble: str, length: LengthLike, over: str) -> object:
        """Return its value as it stands in a file: a tulip, its length, and what it is twisted over."""
        return {"bubble": bubble, "length": written_length(length, units), "over": over}

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the tulip that it makes."""
        return _names_in(value, "bubble")

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is pressed in."""
        return _names_in(value, "over")

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make a tulip over the first bubble of another balloon, whose knot is free."""
        path, known = (*place.path, cls.word), len(bench.complaints)
        made = [name for name in cls.makes(value) if bench.make(name, (*path, "bubble"), place.balloon)]
        for name in made:
            bench.close(name, (*path, "bubble"))
            cls.check_first(name, (*path, "bubble"), place, bench)
        over = cls.uses(value)
        found = [
            bench.has_name(name, (*path, "over")) and bench.find_firm(name, (*path, "over")) for name in over
        ]
        if len(bench.complaints) > known or not (
            made and over and all(found) and bench.knows((*made, *over))
        ):
            return
        if fault := _fault(bench.piece, made[0], over[0]):
            bench.complain((*path, "over"), fault)
        else:
            bench.join(path, [Joint(made[0], "start"), Joint(over[0], "start")], (*made, *over))
            bench.piece.touch(place.index, cls.word, over[0], made)

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of what is so wide that it does not stand straight in the tulip."""
        link = self.tulip_link
        socket, over = layout.bubble(link.bubble), layout.bubble(link.over)
        if min(over.width, over.length) > WIDE * socket.width:
            yield Caution(
                index,
                f"{link.over} may lean on {link.bubble}",
                f"a {over.size} is so wide that it hardly goes into a {socket.size}",
                f"twist a bubble of {at_most(socket.width)} off at its knot, or make {link.bubble} wider",
            )

    def perform(self, score: Score, index: int) -> None:
        """Twist the tulip off, bring both balloons into line, press them together, twist both into one."""
        link, layout = self.tulip_link, score.layout
        begin, lead = score.now, score.pace.leading
        score.twist(link.bubble, self.turns, index)
        knot, neck = layout.ends(link.bubble)
        assert neck is not None, "what is left of a balloon is no tulip"
        other, _ = layout.ends(link.over)
        balloons = {ring: layout.ring(ring).balloon for ring in (knot, other)}
        longest = {ring: score.longest_with(balloon) for ring, balloon in balloons.items()}
        moved, _ = score.lead_in(knot, other, index)
        face = max(FACE_SECONDS, SECONDS_PER_METRE * longest[moved]) / lead
        rings = {"knot": knot, "neck": neck, "other": other, "moved": moved}
        score.add(FaceKnot(score.now, face, index, self.label, **rings))
        score.add(PressIn(score.now, INVERT_SECONDS / lead, index, self.label, **rings))
        score.weld((knot, neck, other), self.turns, self.label, index)
        score.refuse_haste(index, self.seconds, score.now - begin, "press the end of a balloon into another")


def _names_in(value: object, key: str) -> tuple[str, ...]:
    name = value.get(key) if isinstance(value, dict) else None
    return (name,) if isinstance(name, str) else ()


def _fault(piece: Workpiece, tulip: str, over: str) -> str:
    """Say why a bubble cannot be pressed into a tulip; nothing where it can."""
    balloon, knot = piece.bubbles[over].balloon, Joint(over, "start")
    if balloon == piece.bubbles[tulip].balloon:
        return f"{quoted(over)} is of {quoted(balloon)} itself, expected the first bubble of another balloon"
    if fault := fault_at_knot(
        piece, over, if_gone="another balloon", if_other="the one at the knot, which goes ahead"
    ):
        return fault
    if others := [str(end) for end in piece.joint(knot) if end != knot]:
        return f"the knot of {quoted(balloon)} is twisted to {others[0]} by now, expected one that is free"
    return f"{over} is held by others already, expected each bubble once" if over in piece.gripped() else ""
