"""What is varied: places in a recipe, each with its values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from balloon_usd.language.problem import path_text, printable, quoted
from balloon_usd.variation.key_path import find_path
from balloon_usd.variation.values import listed, read_values

if TYPE_CHECKING:
    from balloon_usd.language.problem import Path
    from balloon_usd.variation.values import Values

Setting = str | Sequence[object]
"""Values as a text (`red,blue`, `8..14/2`, `8..14`), or one by one."""
Settings = Mapping[str, Setting] | Iterable[tuple[str, Setting]]
"""Values by the path where they are set."""


@dataclass(frozen=True)
class Parameter:
    """A place in a recipe and the values that it takes."""

    path: Path
    values: Values

    @property
    def name(self) -> str:
        """The path as problems show it."""
        return path_text(self.path)


def read_parameters(settings: Settings, data: object) -> tuple[list[Parameter], list[str]]:
    """Read what is set in the plain data of a recipe; also return all that is wrong with it.

    `data`: None if the recipe cannot be read; then nothing is looked up in it.
    """
    parameters: list[Parameter] = []
    problems: list[str] = []
    pairs = list(settings.items() if isinstance(settings, Mapping) else settings)
    for text, setting in pairs:
        path, values, shown = None, None, printable(text) or quoted(text)
        try:
            values = read_values(setting) if isinstance(setting, str) else listed(setting)
        except ValueError as error:
            problems.append(f"{shown}: {error}")
        try:
            path = find_path(text, data) if data is not None else None
        except ValueError as error:
            problems.append(f"{shown}: {error}")
        if path is not None and values is not None:
            parameters.append(Parameter(path, values))
    if not pairs:
        problems.append(
            "nothing is varied, expected a path and its values, such as balloons.main.tail=8..14/2"
        )
    return parameters, [*problems, *_conflicts(parameters)]


def _conflicts(parameters: Sequence[Parameter]) -> list[str]:
    """Say which parameters set the same part of the recipe."""
    found = []
    for one, other in combinations(sorted(parameters, key=lambda parameter: len(parameter.path)), 2):
        if one.path == other.path:
            found.append(f"{one.name} is set twice, expected all its values in one list")
        elif other.path[: len(one.path)] == one.path:
            found.append(f"{other.name} is set, and all of {one.name} is, too: expected one of them")
    return found
