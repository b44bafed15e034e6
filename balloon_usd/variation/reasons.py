"""Why variations were left out, in few lines."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.language.problem import shortened
from balloon_usd.recipe.writer import flow_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from balloon_usd.variation.result import LeftOut

MOST_REASONS = 20
_NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?")


def reason_lines(left_out: Iterable[LeftOut]) -> list[str]:
    """Return a line for each reason, with the first variation that has it; those of most variations first.

    Reasons that differ in numbers alone are one.
    """
    alike: dict[str, list[LeftOut]] = {}
    for left in left_out:
        alike.setdefault(_NUMBER.sub("#", _reason(left)), []).append(left)
    ordered = sorted(alike.values(), key=len, reverse=True)
    lines = [_line(group) for group in ordered[:MOST_REASONS]]
    hidden = len(ordered) - len(lines)
    return [*lines, f"{hidden} more reasons"] if hidden > 0 else lines


def values_text(values: Mapping[str, object]) -> str:
    """Write what was set, on one line."""
    return ", ".join(f"{path} {shortened(flow_text(value))}" for path, value in values.items())


def _line(group: list[LeftOut]) -> str:
    first = group[0]
    such = f"{len(group)} left out, such as" if len(group) > 1 else "left out:"
    return f"{such} {first.name} ({values_text(first.values)}): {_reason(first)}"


def _reason(left: LeftOut) -> str:
    path, text = left.problem.path, left.problem.text
    return f"{path}: {text}" if path else text
