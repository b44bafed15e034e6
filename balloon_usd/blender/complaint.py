# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `balloon-usd` says of a recipe, with the place that it means."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

# A drive of Windows has a colon, too.
_PLACED = re.compile(r".+?:(\d+):(\d+): .+")
CAUTION = ": caution: "
BAD_INPUT = 2
"""Exit code of a command that was given a wrong recipe."""


class Place(NamedTuple):
    """A character of the recipe: line and column, both counted from 1."""

    line: int
    column: int


def first_place(lines: Iterable[str]) -> Place | None:
    """Return the first place that lines of the form file:line:column: text name."""
    for line in lines:
        if match := _PLACED.fullmatch(line):
            return Place(int(match[1]), int(match[2]))
    return None


def cautions(lines: Iterable[str]) -> list[str]:
    """Return the lines that warn of what may go wrong."""
    return [line for line in lines if CAUTION in line]
