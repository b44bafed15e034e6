"""Paper to draw on: smooth lines, and words that stay sharp."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from PIL import Image, ImageDraw, ImageFont

from balloon_usd.report.palette import PAPER

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.report.palette import Color

    Place = tuple[float, float]
    Font = ImageFont.ImageFont | ImageFont.FreeTypeFont

FINER = 2
"""Lines are drawn so many times larger and then made smaller, which smooths their edges."""
DASH, GAP = 7.0, 5.0
"""Lengths along a dashed line (pixels)."""


@cache
def font(size: int) -> Font:
    """Return the type of the contact sheet in a size (pixels)."""
    return ImageFont.load_default(size)


def text_width(words: str, size: int) -> float:
    """Return how wide words are (pixels)."""
    return float(font(size).getlength(words))


class Paper:
    """A picture in the making; places are pixels of the finished one, y down."""

    def __init__(self, width: int, height: int) -> None:
        self.size = (width, height)
        self._large = Image.new("RGB", (FINER * width, FINER * height), PAPER)
        self._pen = ImageDraw.Draw(self._large)
        self._words: list[tuple[Place, str, Color, int, str]] = []

    def box(self, corner: Place, opposite: Place, color: Color) -> None:
        """Fill a rectangle."""
        self._pen.rectangle([_finer(corner), _finer(opposite)], fill=color)

    def line(self, points: Sequence[Place], color: Color, width: float = 1.0) -> None:
        """Draw a line through points; a single one is a dot."""
        if len(points) == 1:
            self.dot(points[0], color, 1.5 * width)
            return
        self._pen.line([_finer(point) for point in points], color, round(FINER * width), joint="curve")

    def dashes(self, start: Place, end: float, color: Color) -> None:
        """Draw a dashed level line as far as the pixel `end`."""
        left, y = start
        while left < end:
            self.line([(left, y), (min(left + DASH, end), y)], color)
            left += DASH + GAP

    def dot(self, place: Place, color: Color, radius: float) -> None:
        """Draw a filled circle."""
        self._pen.circle(_finer(place), FINER * radius, fill=color)

    def text(self, place: Place, words: str, color: Color, size: int, anchor: str = "lm") -> None:
        """Write words, anchored as Pillow has it: left, middle or right, and top, middle or baseline."""
        self._words.append((place, words, color, size, anchor))

    def picture(self) -> Image.Image:
        """Return what was drawn."""
        picture = self._large.reduce(FINER)
        pen = ImageDraw.Draw(picture)
        for place, words, color, size, anchor in self._words:
            pen.text(place, words, color, font(size), anchor=anchor)
        return picture


def _finer(place: Place) -> Place:
    return FINER * place[0], FINER * place[1]
