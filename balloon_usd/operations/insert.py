"""`insert`: balloons are put into others while all of them are flat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import BeforeValidator, Field

from balloon_usd.language.names import Name
from balloon_usd.language.problem import quoted
from balloon_usd.operations.operation import Operation

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


def _entries(value: object) -> object:
    if not isinstance(value, dict):
        raise ValueError(f"{quoted(value)} does not fit, expected entries such as {{bug: cocoon}}")
    return value


class Insert(Operation):
    """Put flat balloons into others that are still flat: each lies in one bubble of those from then on."""

    word: ClassVar[str] = "insert"
    called: ClassVar[tuple[str, ...]] = ("stuff",)
    whole: ClassVar[bool] = True
    on_rounds: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: cocoon
units: cm
balloons:
  shell: {size: 646, color: lime, finish: clear, length: 9, tail: 4}
  bug: {size: 260, color: forest, length: 4, tail: 1.5}
steps:
  - insert: {bug: cocoon}
  - inflate: shell
  - inflate: bug
  - rest: cocoon
    balloon: shell
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonhq.com, twistmail: a bird in an egg",
        "balloonhq.com, column of Dewey: balls put into a tube, for a caterpillar",
    )

    insert: Annotated[dict[Name, Name], Field(min_length=1), BeforeValidator(_entries)]
    """Put flat balloons into others: the bubble in which each will lie, by its name."""

    @property
    def names(self) -> tuple[str, ...]:
        """It works on no bubbles that are there."""
        return ()

    @property
    def label(self) -> str:
        """The step in a few words."""
        return f"{self.word}: " + ", ".join(f"{guest} into {host}" for guest, host in self.insert.items())

    @classmethod
    def value_of(cls, units: Units, /, **inside: str) -> object:
        """Return its value as it stands in a file: the bubble in which each balloon will lie."""
        return dict(inside)

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Put in what is flat, into what is made of others later."""
        for guest, host in value.items() if isinstance(value, dict) else ():
            if isinstance(guest, str) and isinstance(host, str):
                bench.insert(guest, host, (*place.path, cls.word, guest))

    def perform(self, score: Score, index: int) -> None:
        """Nothing is shown of it: what is put in lies there from the beginning."""
