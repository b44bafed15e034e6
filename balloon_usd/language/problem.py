"""What is wrong with a recipe, and where: a place in the file, a path in the recipe, a sentence."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

Path = tuple[str | int, ...]
"""A place in a recipe by keys and positions, such as ("steps", 3, "lock")."""

PROBLEMS_SHOWN = 100
"""A file with more problems than this is not read line by line by anybody."""

_PLAIN_KEY = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)
_TEXT_SHOWN = 48


class Place(NamedTuple):
    """A character of a file: line and column, both counted from 1."""

    line: int
    column: int


@dataclass(frozen=True)
class Complaint:
    """A problem before its place is looked up; `at` overrules the place of `path`."""

    path: Path
    text: str
    at: Place | None = None


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a recipe: what, what was expected, and the nearest valid choice."""

    file: str
    line: int
    column: int
    path: str
    text: str

    def __str__(self) -> str:
        """Format as `file:line:column: path: text`, as compilers do and editors understand."""
        place = f"{self.file}:{self.line}:{self.column}: "
        return f"{place}{self.path}: {self.text}" if self.path else place + self.text


@dataclass(frozen=True)
class Notice:
    """What the writer of a recipe should know though nothing is wrong, such as the new name of a word."""

    file: str
    line: int
    column: int
    text: str

    def __str__(self) -> str:
        """Format as `file:line:column: text`."""
        return f"{self.file}:{self.line}:{self.column}: {self.text}"


class RecipeError(ValueError):
    """A recipe that cannot be used; `problems` holds all of them, in the order of the file."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        ordered = sorted(problems, key=lambda problem: (problem.file, problem.line, problem.column))
        self.problems: tuple[Problem, ...] = tuple(dict.fromkeys(ordered))
        super().__init__(self.problems)

    def __str__(self) -> str:
        """One line for each problem."""
        lines = [str(problem) for problem in self.problems[:PROBLEMS_SHOWN]]
        hidden = len(self.problems) - len(lines)
        if hidden > 0:
            lines.append(f"{self.problems[0].file}: {hidden} more problems")
        return "\n".join(lines)


def path_text(path: Path) -> str:
    """Write a path as in `steps[3].lock` or `balloons.main.tail`."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        elif _PLAIN_KEY.fullmatch(part):
            text += f".{shortened(part)}" if text else shortened(part)
        else:
            text += f"[{quoted(part)}]"
    return text


def shortened(text: str) -> str:
    """Cut a text that would flood the message."""
    return text if len(text) <= _TEXT_SHOWN else text[: _TEXT_SHOWN - 3] + "..."


def quoted(value: object) -> str:
    """Quote a value of the file for a message: no control characters, no flood."""
    shown = printable(as_written(value))
    return f'"{shown}"' if isinstance(value, str) else shown


def as_written(value: object, deep: int = 3) -> str:
    """Return a value as it stands in a file, what is nested deeper than that left out."""
    if isinstance(value, str):
        return value
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    if not isinstance(value, (dict, list, tuple)):
        return repr(value)
    if not deep:
        return "..."
    if isinstance(value, dict):
        entries = (
            f"{as_written(key, deep - 1)}: {as_written(each, deep - 1)}" for key, each in value.items()
        )
        return f"{{{', '.join(entries)}}}"
    return f"[{', '.join(as_written(each, deep - 1) for each in value)}]"


def printable(text: str) -> str:
    """Shorten a text of the file and escape what cannot be printed."""
    return escaped(shortened(text))


def escaped(text: str) -> str:
    """Escape what cannot be printed, such as control characters."""
    return "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in text)
