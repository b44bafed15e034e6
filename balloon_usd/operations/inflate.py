"""`inflate`: balloons are blown up here, and not at the beginning."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from pydantic import BeforeValidator, Field, TypeAdapter, WithJsonSchema

from balloon_usd.language.names import Name, shortest
from balloon_usd.language.problem import quoted
from balloon_usd.language.quantities import Between
from balloon_usd.operations.modifiers import Timed
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import STROKE_SECONDS

if TYPE_CHECKING:
    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

MOST_STROKES = 100
"""Most strokes with which a balloon is blown up."""
_NAME = TypeAdapter(Name).json_schema()
_SCHEMA: dict[str, Any] = {"anyOf": [_NAME, {"type": "array", "items": _NAME, "minItems": 1}]}


def _listed(value: object) -> object:
    if isinstance(value, str):
        return (value,)
    if not isinstance(value, (list, tuple)):
        raise ValueError(f"{quoted(value)} does not fit, expected a balloon, or a list such as [red, blue]")
    return value


class Inflate(Timed, Operation):
    """Blow balloons up now, and not at the beginning: until then they lie there flat."""

    word: ClassVar[str] = "inflate"
    called: ClassVar[tuple[str, ...]] = ("pump", "blow_up")
    whole: ClassVar[bool] = True
    on_rounds: ClassVar[bool] = True
    keeps_time: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: sprout
units: cm
balloons:
  stem: {size: 260, color: green, length: 11, tail: 4}
  leaves: {size: 260, color: yellow, length: 10, tail: 4}
steps:
  - bubbles: {stalk: 12}
    balloon: stem
  - inflate: leaves
    strokes: 3
  - bubbles: {leaf: 9}
    balloon: leaves
  - lock: {joints: [stalk.end, leaf.end]}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloon.com.tw/PART3.HTM: Blowing up a balloon",
        "howtoadult.com: How to blow up a twisty balloon",
    )

    inflate: Annotated[
        tuple[Name, ...], Field(min_length=1), BeforeValidator(_listed), WithJsonSchema(_SCHEMA)
    ]
    """Blow balloons up now, and not at the beginning: until then they lie there flat."""
    strokes: Annotated[int, Between(1, MOST_STROKES, "strokes", whole=True)] | None = None
    """Strokes of a hand pump that blow each of them up; a steady flow when absent."""

    @property
    def names(self) -> tuple[str, ...]:
        """It works on no bubbles."""
        return ()

    @property
    def label(self) -> str:
        """The step in a few words."""
        return f"{self.word}: {', '.join(self.inflate)}"

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return shortest(self.inflate)

    @classmethod
    def value_of(cls, units: Units, /, *balloons: str) -> object:
        """Return its value as it stands in a file: balloons that are blown up at the same time."""
        return shortest(balloons)

    @classmethod
    def places(cls, value: object) -> list[tuple[Path, str]]:
        """Return the balloons that it blows up and where they stand, as far as its value in a file can be
        read.
        """
        if isinstance(value, str):
            return [((cls.word,), value)]
        entries = value if isinstance(value, (list, tuple)) else ()
        return [((cls.word, at), name) for at, name in enumerate(entries) if isinstance(name, str)]

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Blow up balloons that are there and still flat."""
        for path, name in cls.places(value):
            bench.blow_up(name, (*place.path, *path))

    def perform(self, score: Score, index: int) -> None:
        """Pump, at all of them at once, and let the rubber come to rest."""
        if self.strokes is not None:
            calm = self.strokes * STROKE_SECONDS
            score.refuse_haste(index, self.seconds, calm, f"work the pump {self.strokes} times")
        score.inflate(self.inflate, index, self.seconds, self.strokes)
