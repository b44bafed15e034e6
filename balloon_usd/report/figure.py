"""The figure of a report: all bubbles over time, with the steps of the recipe above them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.report.axis import time_axis
from balloon_usd.report.crossings import crossing_panel
from balloon_usd.report.labels import rows_for
from balloon_usd.report.palette import ALARM, INK, PALE_INK, PAPER, STEP_RULE, bubble_color
from balloon_usd.report.panel import (
    LABEL_HEIGHT,
    LEADER,
    TITLE_HEIGHT,
    Curve,
    Panel,
    draw_panel,
)
from balloon_usd.report.paper import Paper, text_width

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray
    from PIL import Image

    from balloon_usd.report.axis import Axis
    from balloon_usd.report.history import History
    from balloon_usd.report.palette import Color
    from balloon_usd.report.step_marks import StepMark

# All in pixels. Margins, title and text are those of the contact sheet.
MARGIN = 24
HEADER = 46
TITLE_SIZE = 22
TEXT_SIZE = 14
PLOT_LEFT = 84
PLOT_WIDTH = 1500
STEP_ROW = 20
STEP_GAP = 18
PANEL_HEIGHT = 230
LOW_PANEL = 180
"""Height of a panel of few curves."""
BETWEEN = 14
FOOTER = 52
NAME_BEGIN = LEADER + 54
"""From the panel's edge to a bubble's name."""
NAMES_LEAST = 150


def draw_figure(history: History, *, detail: str, failed: str = "") -> Image.Image:
    """Return the figure of a run: pressure, volume, stretch, contact, tail and crossings over time.

    Args:
        history: frames of a sculpture, at least one.
        detail: level of detail of the mesh, for the header.
        failed: why the simulation ended after these frames, if it did; written below.
    """
    panels = panels_of(history)
    heights = [_height(panel) for panel in panels]
    across = _across(history)
    marks = history.events
    moments = [max((mark.time_code - 1) / history.plan.recipe.fps, across.low) for mark in marks]
    widths = [text_width(mark.text, TEXT_SIZE) for mark in marks]
    rows = rows_for([across.place(moment) for moment in moments], widths, STEP_GAP)
    first = HEADER + MARGIN + (max(rows) + 1 if rows else 0) * STEP_ROW + 8
    bottom = first + sum(heights) + BETWEEN * (len(panels) - 1)
    paper = Paper(_width(panels, across, moments, widths), bottom + FOOTER)
    _write_header(paper, history, detail)
    _mark_steps(paper, marks, moments, rows, across, first)
    top = first
    for panel, height in zip(panels, heights, strict=True):
        draw_panel(paper, panel, history.times, moments, across, (top, top + height))
        top += height + BETWEEN
    _write_times(paper, across, bottom)
    if failed:
        paper.text((MARGIN, bottom + 28), _cut(f"simulation failed {failed}", paper), ALARM, TEXT_SIZE, "lt")
    return paper.picture()


def panels_of(history: History) -> tuple[Panel, ...]:
    """Return what is drawn, in units that makers know; no panel of tails where no balloon has one."""
    names = history.bubble_names
    most = history.plan.recipe.physics.traits.burst_stretch
    limit = None if most is None else (most, "a tube bursts")
    pressure = _curves(names, 1e-3 * history.pressure)
    volume, stretch = _curves(names, 1e6 * history.volume), _curves(names, history.stretch)
    panels = [
        Panel("Pressure", "kPa", "above that of the room, in each bubble", pressure, 2),
        Panel("Gas", "mL", "volume of each bubble", volume, 1),
        Panel("Highest stretch", "", "anywhere in the wall of each bubble", stretch, 2, limit),
    ]
    if history.contact is not None:
        contact = _curves(names, history.contact)
        panels.append(Panel("Contact", "N", "force of all walls that press on each bubble", contact, 1))
    if history.tail_names:
        tails = tuple(
            Curve(name, 100.0 * history.tail[:, index], _balloon_color(index))
            for index, name in enumerate(history.tail_names)
        )
        panels.append(Panel("Tail left", "cm", "flat rubber at the tip of each balloon", tails, 1))
    if crossings := crossing_panel(history.crossings, history.plan.recipe.fps):
        panels.append(crossings)
    return tuple(panels)


def _curves(names: Sequence[str], columns: NDArray[np.float64]) -> tuple[Curve, ...]:
    return tuple(Curve(name, columns[:, k], bubble_color(k)) for k, name in enumerate(names))


def _balloon_color(index: int) -> Color:
    """Ink for the first balloon, since a balloon is no bubble, then the colours of the table."""
    return INK if index == 0 else bubble_color(index - 1)


def _height(panel: Panel) -> int:
    """Return the height of a panel with its title, with room for all names beside it."""
    least = PANEL_HEIGHT if len(panel.curves) > 1 or panel.limit else LOW_PANEL
    return TITLE_HEIGHT + max(least, LABEL_HEIGHT * len(panel.curves))


def _across(history: History) -> Axis:
    times = history.times
    least = 1.0 / history.plan.recipe.fps
    end = max(float(times[-1]), float(times[0]) + least)
    return time_axis(float(times[0]), end, PLOT_LEFT, PLOT_LEFT + PLOT_WIDTH)


def _width(panels: Sequence[Panel], across: Axis, moments: Sequence[float], widths: Sequence[float]) -> int:
    """Return the width of the paper, with room for all names and for the text of the last steps."""
    names = [curve.name for panel in panels for curve in panel.curves]
    named = across.end + NAME_BEGIN + max(NAMES_LEAST, *(text_width(name, TEXT_SIZE) for name in names))
    told = [across.place(moment) + width for moment, width in zip(moments, widths, strict=True)]
    return round(max(named, *told) if told else named) + MARGIN


def _write_header(paper: Paper, history: History, detail: str) -> None:
    recipe = history.plan.recipe
    paper.text((MARGIN, MARGIN + 2), recipe.title or recipe.name, INK, TITLE_SIZE, "lt")
    first, last = history.time_codes[0], history.time_codes[-1]
    seconds = (last - first) / recipe.fps
    facts = f"{recipe.physics.model}, {detail},  frames {first} to {last},  {seconds:.1f} s"
    paper.text((paper.size[0] - MARGIN, MARGIN + 6), facts, PALE_INK, TEXT_SIZE, "rt")


def _mark_steps(
    paper: Paper,
    marks: Sequence[StepMark],
    moments: Sequence[float],
    rows: Sequence[int],
    across: Axis,
    panels: float,
) -> None:
    """Write the steps above the panels, which begin at a pixel; the lowest row is the nearest."""
    heights = [panels - 12 - row * STEP_ROW for row in rows]
    places = list(zip(map(across.place, moments), heights, strict=True))
    for x, y in places:
        paper.line([(x, y - 7), (x, panels + TITLE_HEIGHT)], STEP_RULE, 0.6)
    # The words of a lower row cover the lines that come down from a higher one.
    for mark, (x, y) in zip(marks, places, strict=True):
        paper.box((x + 2, y - 8), (x + 8 + text_width(mark.text, TEXT_SIZE), y + 8), PAPER)
        paper.text((x + 5, y), mark.text, INK, TEXT_SIZE)


def _cut(text: str, paper: Paper) -> str:
    """Return as much of a text as fits on a line."""
    room = paper.size[0] - 2 * MARGIN
    return next(text[:end] for end in range(len(text), -1, -1) if text_width(text[:end], TEXT_SIZE) <= room)


def _write_times(paper: Paper, across: Axis, bottom: float) -> None:
    for tick in across.ticks:
        x = across.place(tick)
        paper.line([(x, bottom), (x, bottom + 5)], PALE_INK)
        paper.text((x, bottom + 9), across.text(tick), PALE_INK, TEXT_SIZE - 1, "mt")
    paper.text((across.end + 30, bottom + 9), "seconds", PALE_INK, TEXT_SIZE - 1, "lt")
