"""`rest`: a name for what is left of a balloon."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.names import Name
from balloon_usd.operations.modifiers import OnBalloon, Timed
from balloon_usd.operations.operation import BubbleKind, Operation

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.workbench import Place, Workbench


class Rest(OnBalloon, Timed, Operation):
    """Name what is left of the balloon: nothing more is made of it."""

    word: ClassVar[str] = "rest"
    called: ClassVar[tuple[str, ...]] = ("remainder", "tail")
    on_rounds: ClassVar[bool] = True
    bubble_kind: ClassVar[BubbleKind | None] = "rest"
    example: ClassVar[str] = """\
format: 1
name: magnifier
units: cm
balloons:
  main: {size: 260, color: red, length: 18, tail: 5}
steps:
  - loop: {glass: 34}
  - rest: handle
"""
    sources: ClassVar[tuple[str, ...]] = ("Kosaka 2008, fig. 2.4: the tail of the dog is what is left",)

    rest: Name
    """Name what is left of the balloon: nothing more is made of it."""

    @classmethod
    def value_of(cls, units: Units, /, name: str) -> object:
        """Return its value as it stands in a file."""
        return name

    @property
    def names(self) -> tuple[str, ...]:
        """What it names."""
        return (self.rest,)

    @classmethod
    def makes(cls, value: object) -> tuple[str, ...]:
        """Return the name."""
        return (value,) if isinstance(value, str) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Name the rest, and let nothing more be made of the balloon."""
        path = (*place.path, cls.word)
        for name in cls.makes(value):
            bench.make(name, path, place.balloon, last=True)
