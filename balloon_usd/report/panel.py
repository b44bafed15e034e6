"""One panel of the figure: curves over time, named where they end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.report.axis import value_axis
from balloon_usd.report.labels import spread
from balloon_usd.report.palette import ALARM, INK, PALE_INK, PANEL, PAPER, RULE, STEP_RULE
from balloon_usd.report.paper import text_width

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.report.axis import Axis
    from balloon_usd.report.palette import Color
    from balloon_usd.report.paper import Paper

TITLE_SIZE, TEXT_SIZE, SMALL_SIZE = 16, 14, 13
TITLE_HEIGHT = 30
LABEL_HEIGHT = 16
LEADER = 26
"""Length of the line from the end of a curve to its name (pixels)."""
CURVE = 2.0
"""Width of a curve (pixels)."""
MANY = 8
"""Curves from which on they are drawn thinner."""
THINNER = 0.75
"""Width of many curves, as a share of that of few."""


@dataclass(frozen=True)
class Curve:
    """What one thing did over time."""

    name: str
    values: NDArray[np.float64]
    """(N,) in the unit of the panel."""
    color: Color


@dataclass(frozen=True)
class Panel:
    """Curves of one quantity."""

    title: str
    unit: str
    """Of the values; "1" for a number, "" for a ratio."""
    note: str
    """What the values are, in a few words."""
    curves: tuple[Curve, ...]
    digits: int
    """Digits after the point of the values at the end."""
    limit: tuple[float, str] | None = None
    """A value that should not be passed, and its name."""
    times: NDArray[np.float64] | None = None
    """Of every value (N,), s; None where they are those of all frames."""

    def axis(self, top: float, bottom: float) -> Axis:
        """Return the axis that shows all values and zero, or one for a ratio."""
        values = np.concatenate([curve.values for curve in self.curves])
        base = 0.0 if self.unit else 1.0
        high = float(values.max()) if self.limit is None else max(float(values.max()), self.limit[0])
        return value_axis(min(base, float(values.min())), max(base, high), bottom, top)


def draw_panel(
    paper: Paper,
    panel: Panel,
    times: NDArray[np.float64],
    moments: Sequence[float],
    across: Axis,
    span: tuple[float, float],
) -> None:
    """Draw a panel between two pixels from above.

    Args:
        paper: to draw on.
        panel: what to draw.
        times: of all frames (N,), s.
        moments: that get a thin upright line, s.
        across: the axis of time.
        span: top and bottom (pixels), the title included.
    """
    times = times if panel.times is None else panel.times
    top, bottom = span[0] + TITLE_HEIGHT, span[1]
    up = panel.axis(top, bottom)
    paper.box((across.start, top), (across.end, bottom), PANEL)
    _write_title(paper, panel, across.start, span[0] + 0.5 * TITLE_HEIGHT - 2)
    for tick in up.ticks:
        y = up.place(tick)
        paper.line([(across.start, y), (across.end, y)], RULE)
        paper.text((across.start - 9, y), up.text(tick), PALE_INK, SMALL_SIZE, "rm")
    draw_moments(paper, moments, across, (top, bottom))
    if panel.limit is not None:
        value, words = panel.limit
        paper.dashes((across.start, up.place(value)), across.end, ALARM)
        paper.text((across.start + 8, up.place(value) + 3), words, ALARM, SMALL_SIZE, "lt")
    width = CURVE if len(panel.curves) < MANY else THINNER * CURVE
    for curve in panel.curves:
        line = [(across.place(t), up.place(v)) for t, v in zip(times, curve.values, strict=True)]
        paper.line(line, curve.color, width)
    _name_curves(paper, panel, up, across.place(times[-1]), across.end, (top, bottom))


def draw_moments(paper: Paper, moments: Sequence[float], across: Axis, span: tuple[float, float]) -> None:
    """Draw a thin upright line at each moment (s)."""
    for moment in moments:
        x = across.place(moment)
        paper.line([(x, span[0]), (x, span[1])], STEP_RULE, 0.6)


def _write_title(paper: Paper, panel: Panel, left: float, y: float) -> None:
    title = f"{panel.title}, {panel.unit}" if panel.unit not in ("", "1") else panel.title
    note = left + text_width(title, TITLE_SIZE) + 12
    paper.box((left + 1, y - 10), (note + text_width(panel.note, SMALL_SIZE) + 6, y + 10), PAPER)
    paper.text((left, y), title, INK, TITLE_SIZE)
    paper.text((note, y + 1), panel.note, PALE_INK, SMALL_SIZE)


def _name_curves(
    paper: Paper, panel: Panel, up: Axis, end: float, edge: float, span: tuple[float, float]
) -> None:
    """Write names and last values beside the ends of the curves, which end at the pixel `end`."""
    ends = [up.place(float(curve.values[-1])) for curve in panel.curves]
    half = 0.5 * LABEL_HEIGHT
    places = spread(ends, LABEL_HEIGHT, span[0] + half - TITLE_HEIGHT, span[1] - half + 4)
    for curve, y, label in zip(panel.curves, ends, places, strict=True):
        paper.line([(end, y), (edge + 6, y), (edge + LEADER - 4, label)], curve.color, 0.6)
        value = f"{curve.values[-1]:.{panel.digits}f}"
        paper.text((edge + LEADER + 44, label), value, INK, TEXT_SIZE, "rm")
        paper.text((edge + LEADER + 54, label), curve.name, curve.color, TEXT_SIZE)
