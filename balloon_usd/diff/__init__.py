"""The diff room: two stages of any maker, compared; structure exactly, numbers within a tolerance."""

from __future__ import annotations

from balloon_usd.diff.comparison import differences
from balloon_usd.diff.difference import Difference, Spread
from balloon_usd.diff.error import DamagedStageError, DiffError, DiffNotWrittenError
from balloon_usd.diff.movement import Moment, Movement
from balloon_usd.diff.tolerance import EXACT, Allowed, Tolerances
from balloon_usd.diff.two_files import Comparison, compare_files

__all__ = [
    "EXACT",
    "Allowed",
    "Comparison",
    "DamagedStageError",
    "DiffError",
    "DiffNotWrittenError",
    "Difference",
    "Moment",
    "Movement",
    "Spread",
    "Tolerances",
    "compare_files",
    "differences",
]
