"""Turns in words."""

from __future__ import annotations

import math

PARTS = 20
"""Parts of a turn in which a limit is told."""


def turns_text(turns: float) -> str:
    """Write a number of turns, either way: `1 turn`, `2.5 turns`."""
    return f"{abs(turns):g} {'turn' if abs(turns) == 1.0 else 'turns'}"


def most_turns(turns: float) -> str:
    """Write the largest number of turns that a reader may take, rounded down."""
    return f"{math.floor(PARTS * turns) / PARTS:g}"
