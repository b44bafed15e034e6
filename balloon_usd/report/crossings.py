"""The crossings of walls in a report: as rows of numbers, and as a panel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.quality.crossing_history import pair_text
from balloon_usd.report.palette import INK, bubble_color
from balloon_usd.report.panel import Curve, Panel

if TYPE_CHECKING:
    from balloon_usd.quality.crossing_history import CrossingHistory

NAMED = 5
"""Pairs of bubbles that have a curve: those that cross most."""


def crossing_rows(crossings: CrossingHistory | None) -> dict[str, Any] | None:
    """Return the crossings in every frame in which they were counted; None where they were not."""
    if crossings is None or not crossings.frames:
        return None
    return {
        "time_code": list(crossings.frames),
        "count": [found.count for found in crossings.frames.values()],
        "in_necks": [found.in_necks for found in crossings.frames.values()],
        "bubbles": [{"pair": list(pair), "count": crossings.counts_of(pair)} for pair in crossings.pairs()],
    }


def crossing_panel(crossings: CrossingHistory | None, fps: float) -> Panel | None:
    """Return the panel of crossings: all of them and the worst pairs; None where nothing crosses."""
    pairs = crossings.pairs() if crossings else []
    if not crossings or not pairs:
        return None
    curves = [
        Curve(pair_text(pair), _values(crossings.counts_of(pair)), bubble_color(index))
        for index, pair in enumerate(pairs[:NAMED])
    ]
    every = Curve("all", _values([found.count for found in crossings.frames.values()]), INK)
    times = (np.array(list(crossings.frames), dtype=np.float64) - 1.0) / fps
    note = "edges that pierce a wall, outside of necks"
    return Panel("Crossings", "1", note, (every, *(curves if len(pairs) > 1 else ())), 0, times=times)


def _values(counts: list[int]) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array(counts, dtype=np.float64)
