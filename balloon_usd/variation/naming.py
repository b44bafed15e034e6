"""Names of variations: with their values where these are few and short, else with numbers."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.language.names import NAME_LIMIT
from balloon_usd.recipe.writer import flow_text

if TYPE_CHECKING:
    from collections.abc import Sequence

FEW = 100
"""Variations that are still told apart by their values."""
LONGEST_VALUE = 24
"""Letters of a value in a name."""

_NO_LETTERS = re.compile(r"[^A-Za-z0-9]+")


def names_with_values(base: str, values: Sequence[Sequence[object]]) -> list[str]:
    """Return names such as dog_red_8, one for each row of values; numbered ones where these do not serve."""
    if len(values) <= FEW:
        words = [[_word(value) for value in row] for row in values]
        names = ["_".join([base, *row]) for row in words]
        told = all(0 < len(word) <= LONGEST_VALUE for row in words for word in row)
        unlike = len({name.lower() for name in names}) == len(names)
        if told and unlike and max(map(len, names)) <= NAME_LIMIT:
            return names
    return numbered_names(base, len(values))


def numbered_names(base: str, count: int) -> list[str]:
    """Return names such as dog_01 to dog_12; a long name is cut, and never itself among them."""
    width = len(str(count))
    names = _numbered(base, count, width)
    return _numbered(base, count, width + 1) if base.lower() in map(str.lower, names) else names


def _numbered(base: str, count: int, width: int) -> list[str]:
    kept = base[: NAME_LIMIT - 1 - width]
    return [f"{kept}_{number:0{width}}" for number in range(1, count + 1)]


def _word(value: object) -> str:
    """Return the letters and digits of a value, nothing of one in another script."""
    text = value if isinstance(value, str) else flow_text(value)
    return _NO_LETTERS.sub("_", text).strip("_") if text.isascii() else ""
