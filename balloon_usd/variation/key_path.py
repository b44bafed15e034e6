"""Places in a recipe as a user names them: `balloons.main.tail`, `steps.0.bubbles.nose`, `steps[0].turns`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.language.choices import unknown
from balloon_usd.language.problem import path_text, printable, quoted
from balloon_usd.operations.entries import steps_in
from balloon_usd.operations.table import BY_WORD, words_in
from balloon_usd.recipe.balloons import Balloon
from balloon_usd.recipe.kosaka import Kosaka
from balloon_usd.recipe.physics import Physics
from balloon_usd.recipe.recipe import Recipe
from balloon_usd.recipe.repeats import LET

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pydantic import BaseModel

    from balloon_usd.language.problem import Path

GIVEN = ("format", "name")
"""Keys that a variation does not let choose."""
BLOCKS: tuple[Path, ...] = (("physics",), ("physics", "kosaka"))
"""Blocks of which an entry can be set where the whole block is absent."""

_INDEX = re.compile(r"\[([^\[\].]*)\]")
_LONGEST_NUMBER = 6
_NOTHING = object()
"""Stands where a key is allowed and absent."""


def find_path(text: str, data: object) -> Path:
    """Return the place in the plain data of a recipe that a text names; its last key may be absent.

    Places in lists are numbers from 0, or a bubble's name where only one entry has it.

    Raises:
        ValueError: there is no such place, with the nearest that is known.
    """
    parts = _INDEX.sub(r".\1", text.strip()).split(".")
    if not all(parts):
        example = "balloons.main.tail or steps[0].bubbles.nose"
        raise ValueError(f"no path, expected keys such as {example}")
    path: Path = ()
    node = data
    for at, part in enumerate(parts):
        key = _key(path, node, part, parts[at + 1 :], data)
        path = (*path, key)
        node = _below(node, key, path)
    return path


def _key(path: Path, node: object, part: str, following: Sequence[str], data: object) -> str | int:
    if isinstance(node, list):
        return _index(path, node, part, following, data)
    if node is _NOTHING:
        raise ValueError(f"{path_text(path)} is not there, expected a value for all of it")
    if not isinstance(node, dict):
        raise ValueError(
            f"{path_text(path)} is {quoted(node)}, which has no parts: expected the path to end there"
        )
    if not path and part in GIVEN:
        raise ValueError("is not varied, since each variation gets its own name: expected another key")
    allowed = _keys(path, node)
    if part not in allowed:
        raise ValueError(unknown(_kind(path), part, allowed))
    return part


def _below(node: object, key: str | int, path: Path) -> object:
    if isinstance(node, dict) and key not in node:
        return {} if path in BLOCKS else _NOTHING
    return node[key]  # type: ignore[index]  # it was found there


def _kind(path: Path) -> str:
    """Say what the keys of a mapping name."""
    match path:
        case ("balloons",):
            return "balloon"
        case ("steps", int(), str(word)) if word in BY_WORD and BY_WORD[word].by_bubble:
            return "bubble"
    return "key"


def _keys(path: Path, node: dict[str, object]) -> list[str]:
    """List the keys of a mapping that can be set: those of the language, or the names in it."""
    model: type[BaseModel] | None = None
    match path:
        case ():
            return [key for key in (*Recipe.model_fields, LET) if key not in GIVEN]
        case ("steps", int()):
            return _step_keys(node)
        case ("balloons", _):
            model = Balloon
        case ("steps", int(), str(word)) if word in BY_WORD:
            model = BY_WORD[word].value_model
        case ("physics",):
            model = Physics
        case ("physics", "kosaka"):
            model = Kosaka
    return list(node if model is None else model.model_fields)


def _step_keys(step: dict[str, object]) -> list[str]:
    """List what a step has, and what may stand beside its operation."""
    beside = [key for word in words_in(step) for key in BY_WORD[word].modifiers()]
    return list(dict.fromkeys([*step, *beside]))


def _index(path: Path, entries: list[object], part: str, following: Sequence[str], data: object) -> int:
    if part.isascii() and part.isdecimal():
        if len(part) > _LONGEST_NUMBER or int(part) >= len(entries):
            last = len(entries) - 1
            raise ValueError(f"{path_text(path)} has no place {printable(part)}, expected 0 to {last}")
        return int(part)
    steps = {int(step.path[1]): step.names for step in steps_in(data)} if path == ("steps",) else {}
    names = [steps.get(at, ()) if steps else (entry,) for at, entry in enumerate(entries)]
    found = [at for at, known in enumerate(names) if part in known]
    if len(found) > 1 and following:
        found = [at for at in found if _leads_on(entries[at], following[0])] or found
    if not found:
        known = dict.fromkeys(name for entry in names for name in entry if isinstance(name, str))
        raise ValueError(_unknown_place(part, known))
    if len(found) > 1:
        places = " and ".join(path_text((*path, at)) for at in found)
        raise ValueError(f"{quoted(part)} is in {places}, expected one of them by its number")
    return found[0]


def _unknown_place(part: str, known: Iterable[str]) -> str:
    names = list(known)
    return unknown("bubble", part, names) if names else f"{quoted(part)} is no place, expected a number"


def _leads_on(step: object, part: str) -> bool:
    return isinstance(step, dict) and part in _step_keys(step)
