"""The list beside golden stages, `golden.yaml`: the recipe of each, and what may differ.

    format: 1
    stages:
      pair:
        recipe: ../tests/golden/pair.yaml
        frames: 40
        rms: 1.2e-3
        tolerances: {points: 4e-3, stretch: 4%, pressure: 5 + 2%}

`recipe` alone is needed; its path begins at the list's folder. `frames` keeps the first so many. `rms` is in
metres; `tolerances` are those of `balloon-usd diff --tol`, and `abs` and `rel` hold for all other attributes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.diff import Allowed, Tolerances
from balloon_usd.golden.entry import GoldenEntry
from balloon_usd.golden.error import GoldenError
from balloon_usd.language.choices import unknown
from balloon_usd.language.problem import Complaint, RecipeError, quoted
from balloon_usd.language.yaml_reader import read_yaml

if TYPE_CHECKING:
    from pathlib import Path as File

    from balloon_usd.language.problem import Path

FILE_NAME = "golden.yaml"
FORMAT = 1
MOST_FRAMES = 10**9
"""Frames that can be asked for; the longest animation has far fewer."""
HEAD = ("format", "stages")
KEYS = ("recipe", "frames", "abs", "rel", "rms", "tolerances")


def read_list(folder: File) -> dict[str, GoldenEntry]:
    """Return what the list in a folder says, by the name of the stage; nothing where there is no list.

    Raises:
        GoldenError: it cannot be read, or says something else than it may.
    """
    file = folder / FILE_NAME
    try:
        if file.exists() and not (file.is_file() or file.is_dir()):
            raise GoldenError(f"{file}: cannot be read (it is a pipe or a device)")
        text = file.read_text(encoding="utf-8")
    except FileNotFoundError:
        return {}
    except (OSError, UnicodeDecodeError) as error:
        raise GoldenError(f"{file}: cannot be read ({getattr(error, 'strerror', None) or error})") from error
    if not text.strip():
        raise GoldenError(f"{file}:1:1: nothing stands here, expected format: {FORMAT} and stages")
    try:
        document = read_yaml(text, str(file))
    except RecipeError as error:
        raise GoldenError(str(error)) from error
    reading = _Reading(folder)
    found = reading.stages(document.data)
    problems = document.marks.problems([*document.complaints, *reading.complaints])
    if problems:
        raise GoldenError(str(RecipeError(problems)))
    return found


class _Reading:
    """One pass over the list; gathers all that is wrong."""

    def __init__(self, folder: File) -> None:
        self._folder = folder
        self.complaints: list[Complaint] = []

    def stages(self, data: object) -> dict[str, GoldenEntry]:
        head = self._mapping((), data, HEAD)
        if type(head.get("format")) is not int or head["format"] != FORMAT:
            self._complain(("format",), f"expected format: {FORMAT}")
        stages = self._mapping(("stages",), head.get("stages"), None)
        found = {name: self._entry(("stages", name), given) for name, given in stages.items()}
        return {name: entry for name, entry in found.items() if entry is not None}

    def _entry(self, path: Path, data: object) -> GoldenEntry | None:
        given = self._mapping(path, data, KEYS)
        recipe, frames = given.get("recipe"), given.get("frames")
        if not (isinstance(recipe, str) and recipe.isprintable() and recipe):
            self._complain((*path, "recipe"), "expected the path of a recipe")
            return None
        if "frames" in given and not (type(frames) is int and 0 < frames <= MOST_FRAMES):
            self._complain((*path, "frames"), f"{quoted(frames)} is no number of frames, expected 1 or more")
            return None
        named = self._mapping((*path, "tolerances"), given.get("tolerances", {}), None)
        allowed = {name: self._allowed((*path, "tolerances", name), value) for name, value in named.items()}
        general = Allowed(self._number(path, given, "abs") or 0.0, self._number(path, given, "rel") or 0.0)
        tolerances = Tolerances(general, allowed, self._number(path, given, "rms"))
        return GoldenEntry(self._folder / recipe, frames if isinstance(frames, int) else None, tolerances)

    def _allowed(self, path: Path, value: object) -> Allowed:
        try:
            return Allowed.parse(str(value))
        except ValueError as error:
            self._complain(path, str(error))
            return Allowed()

    def _number(self, path: Path, given: dict[str, object], key: str) -> float | None:
        if key not in given:
            return None
        allowed = self._allowed((*path, key), given[key])
        return allowed.absolute + allowed.relative

    def _mapping(self, path: Path, data: object, keys: tuple[str, ...] | None) -> dict[str, object]:
        """Return a mapping, empty if it is none; tell of keys that are not among those it may have."""
        if not isinstance(data, dict):
            self._complain(path, "expected key: value")
            return {}
        for key in data:
            if keys is not None and key not in keys:
                self._complain((*path, key), unknown("key", key, keys))
        return data

    def _complain(self, path: Path, text: str) -> None:
        self.complaints.append(Complaint(path, text))
