"""Where every part of a recipe stands in its file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from balloon_usd.language.problem import Complaint, Notice, Path, Place, Problem, escaped, path_text

if TYPE_CHECKING:
    from collections.abc import Iterable

_START = Place(1, 1)


@dataclass(frozen=True)
class Marks:
    """The places of a file's keys and values, by path."""

    file: str
    keys: dict[Path, Place] = field(default_factory=dict)
    values: dict[Path, Place] = field(default_factory=dict)
    """Places of plain values only: a list or mapping is found by its key."""
    moved: tuple[tuple[Path, Path], ...] = ()
    """Parts that an upgrade has moved, in order: each path before it and after it."""
    repeats: dict[Path, str] = field(default_factory=dict)
    """In which of its repeats a part is written out, as `k = 3`, of parts that stand once in the file."""

    def written(self, path: Path) -> Path:
        """Return where a part stands in the file, as its writer wrote it."""
        for before, after in reversed(self.moved):
            if path[: len(after)] == after:
                path = (*before, *path[len(after) :])
        return path

    def place(self, path: Path) -> Place:
        """Find the place of a path, or of the nearest enclosing one that stands in the file."""
        path = self.written(path)
        for end in range(len(path), 0, -1):
            found = self.values.get(path[:end]) or self.keys.get(path[:end])
            if found is not None:
                return found
        return _START

    def problem(self, path: Path, text: str, at: Place | None = None) -> Problem:
        """Make a problem of what is wrong at a path."""
        line, column = at or self.place(path)
        repeat = self.repeats.get(path[:2])
        where = f" (with {repeat})" if repeat else ""
        return Problem(self.file, line, column, path_text(self.written(path)), escaped(text + where))

    def notice(self, path: Path, text: str) -> Notice:
        """Make a notice of what should be known of a path."""
        return Notice(self.file, *self.place(path), escaped(text))

    def problems(self, complaints: Iterable[Complaint]) -> list[Problem]:
        """Look up the places of complaints."""
        return [self.problem(complaint.path, complaint.text, complaint.at) for complaint in complaints]
