"""Older forms of the recipe language, read as today's: a table of upgrades of plain data.

As upgrade functions of OpenTimelineIO, each takes data from the form before it to the next one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.operations.entries import steps_in
from balloon_usd.operations.press import PRESSING, Press

if TYPE_CHECKING:
    from balloon_usd.language.problem import Notice, Path
    from balloon_usd.language.yaml_reader import Document


@dataclass(frozen=True)
class Change:
    """A part of a recipe that an upgrade has moved."""

    before: Path
    after: Path
    notice: str
    """What the writer of the recipe should know."""


Upgrade = Callable[[object], Iterator[Change]]
"""Changes plain data of whatever shape in place, and yields what it has moved."""


def upgraded(document: Document) -> tuple[Document, tuple[Notice, ...]]:
    """Return a document in today's language, whose problems still point at what was written; with notices."""
    notices: list[Notice] = []
    for upgrade in UPGRADES:
        for change in upgrade(document.data):
            notices.append(document.marks.notice(change.before, change.notice))
            document = document.moved(change.before, change.after)
    return document, tuple(notices)


def _press(data: object) -> Iterator[Change]:
    """`push: {bubble, depth or force}`, a finger that presses, is called `press`: bubbles are pushed, too."""
    for step in steps_in(data):
        value = step.entries.get("push")
        if isinstance(value, dict) and any(key in value for key in PRESSING) and Press.word not in step.words:
            _rename(step.entries, "push", Press.word)
            text = f"push is called {Press.word} now: {Press.word}: {{...}}"
            yield Change((*step.path, "push"), (*step.path, Press.word), text)


def _rename(entries: dict[str, object], key: str, name: str) -> None:
    """Give a key of a mapping another name, in its place."""
    renamed = {name if each == key else each: value for each, value in entries.items()}
    entries.clear()
    entries.update(renamed)


UPGRADES: tuple[Upgrade, ...] = (_press,)
"""All upgrades, oldest first."""
