"""What an operation is: its words, its checks, its effect, and the moves of the hands that it takes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import Field

from balloon_usd.language.names import Name, Text
from balloon_usd.language.quantities import Length, length_entry, written_length
from balloon_usd.operations.modifiers import MODIFIERS, Burped, Entries, OnBalloon, Timed

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.caution import Caution
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

BubbleKind = Literal["bubble", "loop", "fold", "ear", "half", "petal", "tulip", "rest", "shape"]
Lengths = Annotated[dict[Name, Length], Field(min_length=1)]


class Operation(Entries):
    """One step of a recipe. A subclass has a field that is called like its word."""

    word: ClassVar[str]
    """Key in the recipe."""
    example: ClassVar[str]
    """A whole short recipe with it."""
    sources: ClassVar[tuple[str, ...]]
    """Books and pages that describe it."""
    called: ClassVar[tuple[str, ...]] = ()
    """What makers call it, too, as somebody may write it who does not know its word."""
    bubble_kind: ClassVar[BubbleKind | None] = None
    """Of the bubbles that it makes."""
    closes: ClassVar[bool] = False
    """Whether it twists the two ends of each of them together."""
    spreads: ClassVar[bool] = False
    """Whether those roll about their balloon until they push each other aside: no hand holds them then."""
    folds: ClassVar[bool] = False
    """Whether it lays the two halves of each of them side by side."""
    inverts: ClassVar[bool] = False
    """Whether it turns the wall of each of them inside: then that wall's outside meets itself."""
    hollow: ClassVar[bool] = False
    """Whether each of them has a hole once its ends are one, if it is long enough."""
    gas: ClassVar[float] = 1.0
    """Share of the gas of its length that hands leave in each of them, if not told to press any out."""
    slack: ClassVar[float] = 1.0
    """Rubber of each of them, in that of a firm bubble of its length."""
    guides: ClassVar[tuple[float, ...]] = (0.5,)
    """Where hands lead each of them, as shares of its length."""
    by_bubble: ClassVar[bool] = False
    """Whether its value has an entry for each bubble."""
    across: ClassVar[bool] = False
    """Whether what it works on may be of other balloons than the one that it names."""
    value_model: ClassVar[type[Entries] | None] = None
    """Of the keys of its value, where that has any."""
    whole: ClassVar[bool] = False
    """Whether it works on whole balloons of any kind, also on those that are not twisted."""
    on_rounds: ClassVar[bool] = False
    """Whether it works on round balloons, too."""
    on_hearts: ClassVar[bool] = True
    """Whether it works on hearts, too, where it does on round balloons."""
    keeps_time: ClassVar[bool] = False
    """Whether its moves take the time that the recipe gives without being stretched."""

    note: Text | None = None
    """A remark for the reader."""

    @classmethod
    def takes_round(cls, *, heart: bool) -> bool:
        """Say whether it works on round balloons, or on hearts."""
        return cls.on_rounds and (cls.on_hearts or not heart)

    @classmethod
    def modifiers(cls) -> tuple[str, ...]:
        """Return what may stand beside it."""
        return tuple(key for key in MODIFIERS if key in cls.model_fields)

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles that it twists off: inflated length (m) by name."""
        return {}

    @property
    def closed(self) -> tuple[str, ...]:
        """Bubbles of each of which it twists the two ends together."""
        return tuple(self.lengths) if self.closes else ()

    @property
    def gas_left(self) -> float:
        """Share of the gas of its length that hands leave in each bubble that it makes."""
        return self.gas

    @property
    def holds(self) -> bool:
        """Whether what it joins stays one when the hands let go."""
        return True

    @property
    def label(self) -> str:
        """The step in a few words, such as `lock: left_ear, right_ear`."""
        return f"{self.word}: {', '.join(self.names)}"

    def path_of(self, bubble: str) -> tuple[str, ...]:
        """Return the keys under which the length of a bubble stands that it makes."""
        return (self.word, bubble)

    @property
    def does(self) -> str:
        """What hands do with joints or bubbles, in a word, such as `locks`."""
        return f"{self.word}s"

    @property
    def names(self) -> tuple[str, ...]:
        """What it makes or works on."""
        return tuple(self.lengths)

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file: lengths in units, angles in degrees."""
        return self.model_dump(include={self.word})[self.word]

    @classmethod
    def value_of(cls, units: Units, /, *what: Any, **keys: Any) -> object:
        """Return its value as it stands in a file with these units, from the arguments of a call in Python.

        Each operation has arguments of its own; lengths among them are in m.
        """
        raise NotImplementedError

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it makes, as far as its value in a file can be read."""
        return ()

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it works on, as far as its value in a file can be read."""
        return ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of what makes no sense, and do the rest, as far as the value can be read."""

    def held_at(self, piece: Workpiece) -> Mapping[str, int]:
        """Return at how many places hands hold bubbles, evenly, besides those of their kinds.

        `piece`: the finished figure.
        """
        return {}

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield what no hands can do: the keys of this step at which it stands, and why not."""
        yield from ()

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Yield what a maker would warn of in a step of this index."""
        yield from ()

    def beyond_reach(self, index: int, layout: Layout, piece: Workpiece) -> Iterator[Caution]:
        """Yield what hands would not bring together in a step of this index.

        `piece`: the finished figure.
        """
        yield from ()

    def perform(self, score: Score, index: int) -> None:
        """Write the moves of a step of this index; raises `RecipeError` where no hand can make it."""


class WorksByBubble(Operation):
    """An operation whose value says something of each of some bubbles that are there."""

    by_bubble: ClassVar[bool] = True

    @property
    def names(self) -> tuple[str, ...]:
        """Bubbles that it works on."""
        return tuple(getattr(self, self.word))

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it works on."""
        return tuple(value) if isinstance(value, dict) else ()


class LengthsByBubble(Operation):
    """An operation whose value has a length for each of some bubbles."""

    by_bubble: ClassVar[bool] = True

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        given: dict[str, float] = getattr(self, self.word)
        return {name: length_entry(length, units) for name, length in given.items()}

    @classmethod
    def value_of(
        cls, units: Units, lengths: Mapping[str, LengthLike] | None = None, /, **more: LengthLike
    ) -> object:
        """Return its value as it stands in a file."""
        return {name: written_length(length, units) for name, length in {**(lengths or {}), **more}.items()}


class MakesBubbles(OnBalloon, Burped, Timed, Operation):
    """An operation that twists bubbles off, from each of which hands may press gas on."""

    @property
    def gas_left(self) -> float:
        """Share of the gas of its length that hands leave in each bubble: without what they press on."""
        return self.gas * (1.0 - 0.01 * (self.burp or 0.0))


class TwistsOff(MakesBubbles, LengthsByBubble):
    """An operation that twists bubbles off, one after another."""

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles that it twists off: inflated length (m) by name."""
        found: dict[str, float] = getattr(self, self.word)
        return found

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it makes."""
        return tuple(value) if isinstance(value, dict) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles."""
        for name in cls.makes(value):
            path = (*place.path, cls.word, name)
            if bench.make(name, path, place.balloon) and cls.closes:
                bench.close(name, path)
