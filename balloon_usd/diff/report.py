"""What was found, as lines for people and as JSON for programs."""

from __future__ import annotations

import math
from dataclasses import asdict
from itertools import groupby
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from balloon_usd.diff.difference import Difference
    from balloon_usd.diff.two_files import Comparison

LINES = 200
"""Differences that are told to people: nobody reads more."""
FORMAT = 1
"""Version of the JSON."""


def diff_text(comparison: Comparison) -> str:
    """Write the differences prim by prim; a sentence says so if there is none."""
    told = comparison.differences[:LINES]
    lines = []
    for place, group in groupby(told, key=lambda difference: (difference.selection, difference.prim)):
        mine = list(group)
        if len(mine) == 1 or not any(place):
            lines += [str(difference) for difference in mine]
            continue
        selection, prim = place
        lines.append(f"[{selection}] {prim}" if selection else prim)
        lines += [f"  {_within(difference)}" for difference in mine]
    hidden = len(comparison.differences) - len(told)
    if hidden:
        lines.append(f"{hidden} more, which --json has")
    return "\n".join(lines) or "no difference"


def diff_json(comparison: Comparison) -> dict[str, Any]:
    """Return all differences as plain data, with the measures of every time code."""
    return {
        "format": FORMAT,
        "first": str(comparison.first),
        "second": str(comparison.second),
        "same": comparison.same,
        "differences": [_plain(asdict(difference)) for difference in comparison.differences],
    }


def _within(difference: Difference) -> str:
    return f"{difference.name}: {difference.text}" if difference.name else difference.text


def _plain(value: Any) -> Any:
    """Turn records into dictionaries and what JSON has no number for into null."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
