"""Read YAML of unknown origin into plain data, with the place of every part.

Works on PyYAML's event stream with its own stack, so that no input can recurse, build objects, or multiply
itself through aliases. What a recipe never needs (tags, anchors, aliases, keys that are not text) is refused.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import NoReturn

import yaml

from balloon_usd.language.marks import Marks
from balloon_usd.language.problem import Complaint, Path, Place, RecipeError, quoted, shortened
from balloon_usd.language.scalars import plain_scalar

BYTES_LIMIT = 256 * 1024
NODES_LIMIT = 20_000
DEPTH_LIMIT = 32

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_UNPRINTABLE = re.compile(r"[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_LINE_BREAK = re.compile(r"\r\n|[\n\r\x85\u2028\u2029]")


@dataclass(frozen=True)
class Document:
    """Plain data of a YAML file, the places of its parts, and what was refused on the way."""

    data: object
    marks: Marks
    complaints: tuple[Complaint, ...]

    def moved(self, before: Path, after: Path) -> Document:
        """Return it with a part of its data at another path: what stands in the file stays where it is."""
        marks = replace(self.marks, moved=(*self.marks.moved, (before, after)))
        complaints = (
            replace(each, path=(*after, *each.path[len(before) :]))
            if each.path[: len(before)] == before
            else each
            for each in self.complaints
        )
        return Document(self.data, marks, tuple(complaints))


def read_yaml(text: str, file: str) -> Document:
    """Read one YAML document.

    Raises:
        RecipeError: if the text cannot be read to its end (syntax, limits, forbidden characters).
    """
    _refuse_unfit_text(text, file)
    reading = _Reading(Marks(file))
    try:
        for event in yaml.parse(text, Loader=_LOADER):
            reading.take(event)
    except yaml.YAMLError as error:
        reading.stop(_syntax_text(error), _error_place(error))
    if reading.root is None and not reading.complaints:
        reading.stop("the recipe is empty, expected a mapping that begins with format: 1", Place(1, 1))
    return Document(reading.root, reading.marks, tuple(reading.complaints))


def place_in(text: str, index: int) -> Place:
    """Line and column of a character of a text."""
    breaks = [found.end() for found in _LINE_BREAK.finditer(text, 0, index)]
    return Place(1 + len(breaks), 1 + index - (breaks[-1] if breaks else 0))


def _refuse_unfit_text(text: str, file: str) -> None:
    marks = Marks(file)
    size = len(text.encode("utf-8", "surrogatepass"))
    if size > BYTES_LIMIT:
        what = f"the recipe is {size} bytes long, expected at most {BYTES_LIMIT}"
        raise RecipeError([marks.problem((), what)])
    found = _UNPRINTABLE.search(text)
    if found:
        what = f"character U+{ord(found[0]):04X} is not allowed in YAML, expected printable text"
        raise RecipeError([marks.problem((), what, place_in(text, found.start()))])


def _error_place(error: yaml.YAMLError) -> Place | None:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    return Place(mark.line + 1, mark.column + 1) if mark else None


def _syntax_text(error: yaml.YAMLError) -> str:
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
    context, mark = getattr(error, "context", None), getattr(error, "context_mark", None)
    begun = f" {context} that begins at line {mark.line + 1}" if context and mark else ""
    hint = ""
    if "cannot start any token" in problem:
        hint = '; indent with spaces, not tabs, and put texts that begin with %, @ or ` in "quotes"'
    elif "mapping values are not allowed" in problem:
        hint = '; put texts that hold ": " in "quotes" and check the indentation'
    return f"not valid YAML{begun}: {shortened(problem) if len(problem) > 200 else problem}{hint}"


@dataclass
class _Open:
    """A list or mapping whose end has not come yet."""

    container: list[object] | dict[str, object]
    path: Path
    key: str | None = None
    discard: bool = False


@dataclass
class _Reading:
    """The state of one pass over the events."""

    marks: Marks
    root: object = None
    complaints: list[Complaint] = field(default_factory=list)
    documents: int = 0
    nodes: int = 0
    stack: list[_Open] = field(default_factory=list)

    def take(self, event: yaml.Event) -> None:
        if isinstance(event, yaml.DocumentStartEvent):
            self.documents += 1
            if self.documents > 1:
                self.stop("a second YAML document begins here, expected one recipe in a file", _place(event))
        elif isinstance(event, yaml.NodeEvent):
            self._count(event)
            top = self.stack[-1] if self.stack else None
            if top and isinstance(top.container, dict) and top.key is None:
                self._take_key(top, event)
            else:
                self._take_value(event)
        elif isinstance(event, (yaml.SequenceEndEvent, yaml.MappingEndEvent)):
            self.stack.pop()
            self._finish_entry()

    def stop(self, text: str, at: Place | None = None) -> NoReturn:
        """Give up: report this and all that was found before."""
        raise RecipeError(self.marks.problems([*self.complaints, Complaint((), text, at)]))

    def _count(self, event: yaml.Event) -> None:
        self.nodes += 1
        if self.nodes > NODES_LIMIT:
            self.stop(f"more than {NODES_LIMIT} values, expected a recipe for balloons", _place(event))
        opens = isinstance(event, (yaml.SequenceStartEvent, yaml.MappingStartEvent))
        if opens and len(self.stack) >= DEPTH_LIMIT:
            self.stop(f"nested deeper than {DEPTH_LIMIT} levels", _place(event))

    def _take_key(self, top: _Open, event: yaml.Event) -> None:
        if not isinstance(event, yaml.ScalarEvent):
            self.stop("a key that is no plain text, expected key: value", _place(event))
        self._refuse_marks_of_origin(event, (*top.path, event.value))
        top.key = event.value
        path = (*top.path, event.value)
        if event.value in top.container:
            first = self.marks.keys[path].line
            what = f"key {quoted(event.value)} stands here twice, expected it once (first at line {first})"
            self.complaints.append(Complaint(path, what, _place(event)))
            top.discard = True
        else:
            self.marks.keys.setdefault(path, _place(event))

    def _take_value(self, event: yaml.NodeEvent) -> None:
        path = self._path()
        if self.stack and isinstance(self.stack[-1].container, list):
            self.marks.keys.setdefault(path, _place(event))
        if isinstance(event, yaml.AliasEvent):
            alias = f"*{shortened(event.anchor or '')}"
            what = f"YAML aliases are not allowed, expected the value itself instead of {alias}"
            self.complaints.append(Complaint(path, what, _place(event)))
            self._attach(None)
            self._finish_entry()
            return
        self._refuse_marks_of_origin(event, path)
        if isinstance(event, yaml.ScalarEvent):
            self._attach(self._scalar(event, path))
            self._finish_entry()
            return
        container: list[object] | dict[str, object] = {} if isinstance(event, yaml.MappingStartEvent) else []
        self._attach(container)
        self.stack.append(_Open(container, path))

    def _scalar(self, event: yaml.ScalarEvent, path: Path) -> object:
        self.marks.values.setdefault(path, _place(event))
        value = plain_scalar(event.value) if not event.style else event.value
        if value is None and self.stack:
            at = self.marks.keys.get(path) or _place(event)
            self.complaints.append(Complaint(path, "no value, expected one here or no such line", at))
        return value

    def _refuse_marks_of_origin(self, event: yaml.NodeEvent, path: Path) -> None:
        if event.anchor is not None:
            what = f"YAML anchors are not allowed, expected no &{shortened(event.anchor)}"
            self.complaints.append(Complaint(path, what, _place(event)))
        tag = getattr(event, "tag", None)
        if tag is not None:
            what = f"YAML tags are not allowed, expected no {shortened(tag)}"
            self.complaints.append(Complaint(path, what, _place(event)))

    def _path(self) -> Path:
        if not self.stack:
            return ()
        top = self.stack[-1]
        if isinstance(top.container, list):
            return (*top.path, len(top.container))
        return (*top.path, top.key or "")

    def _attach(self, value: object) -> None:
        if not self.stack:
            self.root = value
            return
        top = self.stack[-1]
        if isinstance(top.container, list):
            top.container.append(value)
        elif not top.discard:
            top.container[top.key or ""] = value

    def _finish_entry(self) -> None:
        """The value of a key is complete: the next event is a key again."""
        if self.stack:
            self.stack[-1].key, self.stack[-1].discard = None, False


def _place(event: yaml.Event) -> Place:
    mark = event.start_mark
    assert mark is not None, "the parser marks every event"
    return Place(mark.line + 1, mark.column + 1)
