"""A sheet with both stages side by side at some time codes, and the distance in colour beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from balloon_usd.diff.moments import shown_moments
from balloon_usd.diff.movement_text import length_text
from balloon_usd.diff.ramp import end_of_scale, ramp
from balloon_usd.diff.side_by_side import SideBySide, Trio
from balloon_usd.preview.contact_sheet import GUTTER, INK, MARGIN, PALE_INK, PAPER, TEXT_SIZE, TITLE_SIZE

if TYPE_CHECKING:
    from balloon_usd.diff.two_files import Comparison

SIZE = (480, 320)
"""Width and height of one picture (pixels)."""
HEAD = 76
CAPTION = 30
SCALE_WIDTH, SCALE_HEIGHT = 200, 12
RING = 13
"""Radius of the ring round the point that moved farthest (pixels)."""
FAINT = 0.02
"""Share of the scale below which no ring is drawn: there is nothing to see."""
LONGEST_NAME = 56
"""Characters of a file's path that fit above a picture."""


@np.errstate(invalid="ignore", over="ignore")
def draw_sheet(comparison: Comparison, *, device: str = "auto") -> Image.Image:
    """Draw the first, the worst and the last time code that differ.

    Raises:
        DiffError: a stage shows no mesh, or cannot be drawn.
    """
    stages = SideBySide((comparison.first, comparison.second), SIZE, device)
    moments = shown_moments(comparison, *stages.range)
    known = [rows.max() for moment in moments for rows in stages.distances(moment) if rows is not None]
    scale = end_of_scale(float(max(known, default=0.0)))
    height = HEAD + 2 * MARGIN + len(moments) * (SIZE[1] + CAPTION) + (len(moments) - 1) * GUTTER
    sheet = Image.new("RGB", (2 * MARGIN + 3 * SIZE[0] + 2 * GUTTER, height), PAPER)
    _head(sheet, comparison, scale)
    for row, moment in enumerate(moments):
        _row(sheet, MARGIN + HEAD + row * (SIZE[1] + CAPTION + GUTTER), stages.draw(moment, scale), scale)
    return sheet


def _left(column: int) -> int:
    return MARGIN + column * (SIZE[0] + GUTTER)


def _head(sheet: Image.Image, comparison: Comparison, scale: float) -> None:
    """Name the columns, and draw the scale above the last."""
    pen = ImageDraw.Draw(sheet)
    title, text = ImageFont.load_default(TITLE_SIZE), ImageFont.load_default(TEXT_SIZE)
    for column, name in enumerate(("first", "second", "moved")):
        pen.text((_left(column), MARGIN), name, INK, title, anchor="lt")
    for column, file in enumerate((comparison.first, comparison.second)):
        name = str(file)
        shown = name if len(name) <= LONGEST_NAME else f"...{name[3 - LONGEST_NAME :]}"
        pen.text((_left(column), MARGIN + 34), shown, PALE_INK, text, anchor="lt")
    colors = np.rint(ramp(np.linspace(0.0, 1.0, SCALE_WIDTH))).astype(np.uint8)
    right, top = _left(2) + SIZE[0], MARGIN + 34
    bar = Image.fromarray(np.tile(colors, (SCALE_HEIGHT, 1, 1)))
    sheet.paste(bar, (right - SCALE_WIDTH, top))
    for share, anchor in ((0.0, "lt"), (0.5, "mt"), (1.0, "rt")):
        x = right - SCALE_WIDTH + share * SCALE_WIDTH
        label = length_text(share * scale) if share else "0"
        pen.text((x, top + SCALE_HEIGHT + 5), label, PALE_INK, text, anchor=anchor)


def _row(sheet: Image.Image, top: int, trio: Trio, scale: float) -> None:
    """Paste the pictures of one time code, and say below what they show."""
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(TEXT_SIZE)
    for column, picture in enumerate(trio.pictures):
        sheet.paste(Image.fromarray(picture), (_left(column), top))
    middle = top + SIZE[1] + CAPTION // 2
    pen.text((_left(0), middle), f"frame {trio.time_code:g}", INK, font, anchor="lm")
    said = f"up to {length_text(trio.distance)}" if trio.worst else "nothing moved"
    if trio.lone:
        said += "; dark blue: only in the second stage"
    pen.text((_left(2), middle), said, INK, font, anchor="lm")
    if trio.worst and trio.distance > FAINT * scale:
        x, y = _left(2) + trio.worst[0], top + trio.worst[1]
        pen.ellipse([x - RING, y - RING, x + RING, y + RING], outline=INK, width=2)
