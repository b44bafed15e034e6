"""Contact sheets: many moments of an animation on one picture."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from balloon_usd.language.choices import unknown
from balloon_usd.openusd import usd_access
from balloon_usd.preview.camera import VIEWS
from balloon_usd.preview.painter import Painter
from balloon_usd.preview.png_file import require_place, write_png
from balloon_usd.preview.read_stage import read_stage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.preview.camera import View
    from balloon_usd.preview.read_stage import StageScene
    from balloon_usd.preview.shot import Shot

    Font = ImageFont.ImageFont | ImageFont.FreeTypeFont

MOST_PIXELS = 8192
"""Width and height of a picture at most: a sheet of eight takes 1.6 GB then."""
MOMENTS = 8
"""Pictures on a sheet when no frames are asked for."""

# All in pixels.
MARGIN = 24
GUTTER = 14
HEADER = 46
CAPTION = 30
TITLE_SIZE = 22
TEXT_SIZE = 14
WORD_GAP = 8

PAPER = (247, 247, 249)
INK = (38, 40, 46)
PALE_INK = (120, 124, 134)

BAR_LENGTHS = (0.01, 0.02, 0.05, 0.10, 0.20, 0.50, 1.0, 2.0, 5.0)
"""Lengths that a scale bar may have (m)."""
LONGEST_BAR = 0.25
"""Share of the picture's width."""


@usd_access()
def draw_contact_sheet(
    stage_path: str | Path,
    png_path: str | Path,
    *,
    frames: Sequence[float] | None = None,
    columns: int = 4,
    size: tuple[int, int] = (480, 320),
    view: View = "three-quarter",
    look: str | None = None,
    device: str = "auto",
) -> Path:
    """Draw moments of a stage, each framed on its own, and write one PNG.

    Args:
        stage_path: any USD stage with meshes; points are drawn as balls.
        png_path: where the sheet goes; replaced when it is complete.
        frames: time codes; None takes eight, the first and the last among them.
        columns: pictures in a row.
        size: width and height of one picture (pixels).
        view: side, three-quarter, front-quarter, front or top.
        look: a variant of the stage's looks, such as stress or thesis; None takes the stage's own.
        device: cpu, cuda:N, or auto for the first CUDA device and else the CPU.

    Raises:
        PreviewError: the stage cannot be read or has no such look, the sheet cannot be written, or there is
            no such device.
        ValueError: there is no such view, a time code is no number, or pictures have no size.
    """
    _require_layout(columns, size, view)
    require_place(Path(png_path))
    scene = read_stage(stage_path, look)
    moments = _moments(scene, frames)
    painter = Painter(scene, device)
    sheet = _empty_sheet(scene, len(moments), columns, size)
    for number, moment in enumerate(moments):
        shot = painter.shoot(moment, view, size)
        row, column = divmod(number, columns)
        left = MARGIN + column * (size[0] + GUTTER)
        top = HEADER + MARGIN + row * (size[1] + CAPTION + GUTTER)
        sheet.paste(Image.fromarray(shot.picture), (left, top))
        words = (f"frame {moment:g}", scene.doing(moment))
        _caption(sheet, (left, top + size[1]), size[0], words, shot)
    return write_png(sheet, Path(png_path))


def _require_layout(columns: int, size: tuple[int, int], view: str) -> None:
    if columns < 1:
        raise ValueError(f"{columns} pictures in a row, expected at least 1")
    if not all(1 <= side <= MOST_PIXELS for side in size):
        raise ValueError(f"pictures of {size[0]} by {size[1]} pixels, expected 1 to {MOST_PIXELS}")
    if view not in VIEWS:
        raise ValueError(unknown("view", view, VIEWS))


def _moments(scene: StageScene, frames: Sequence[float] | None) -> tuple[float, ...]:
    """Return time codes as plain numbers: some that were asked for, or those of a usual sheet."""
    if frames is None:
        return spread_moments(scene.start, scene.end)
    found = tuple(float(frame) for frame in frames)
    if not found or not all(map(isfinite, found)):
        raise ValueError(f"time codes {list(found)}, expected some numbers")
    return found


def spread_moments(start: float, end: float, count: int = MOMENTS) -> tuple[float, ...]:
    """Return up to `count` whole time codes, evenly spread from the first frame to the last."""
    wanted = np.linspace(start, end, count)
    return tuple(float(moment) for moment in np.unique(np.rint(wanted)))


def _empty_sheet(scene: StageScene, count: int, columns: int, size: tuple[int, int]) -> Image.Image:
    """Return the paper with its header."""
    across = min(columns, count)
    rows = -(-count // columns)
    width = 2 * MARGIN + across * size[0] + (across - 1) * GUTTER
    height = HEADER + 2 * MARGIN + rows * (size[1] + CAPTION) + (rows - 1) * GUTTER
    sheet = Image.new("RGB", (width, height), PAPER)
    pen = ImageDraw.Draw(sheet)
    seconds = (scene.end - scene.start) / scene.fps
    facts = f"frames {scene.start:g} to {scene.end:g},  {seconds:.1f} s at {scene.fps:g} fps"
    font, small = ImageFont.load_default(TITLE_SIZE), ImageFont.load_default(TEXT_SIZE)
    room = width - 2 * MARGIN - GUTTER - pen.textlength(facts, small)
    pen.text((MARGIN, MARGIN + 2), _shortened(scene.title, room, pen, font), INK, font, anchor="lt")
    pen.text((width - MARGIN, MARGIN + 6), facts, PALE_INK, small, anchor="rt")
    return sheet


def _caption(
    sheet: Image.Image, corner: tuple[int, int], width: int, words: tuple[str, str], shot: Shot
) -> None:
    """Write the moment and what is done below a picture, and a scale bar: each picture has its own scale."""
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(TEXT_SIZE)
    left, middle = corner[0], corner[1] + CAPTION // 2
    moment, doing = words
    pen.text((left, middle), moment, INK, font, anchor="lm")
    fitting = [bar for bar in BAR_LENGTHS if bar / shot.metres_per_pixel <= LONGEST_BAR * width]
    bar = fitting[-1] if fitting else BAR_LENGTHS[0]
    right, length = left + width - 1, bar / shot.metres_per_pixel
    pen.line([(right - length, middle), (right, middle)], PALE_INK, 2)
    for x in (right - length, right):
        pen.line([(x, middle - 4), (x, middle + 4)], PALE_INK, 1)
    label = f"{100 * bar:g} cm"
    pen.text((right - length - WORD_GAP, middle), label, PALE_INK, font, anchor="rm")
    beside = left + pen.textlength(moment, font) + 2 * WORD_GAP
    room = right - length - 3 * WORD_GAP - pen.textlength(label, font) - beside
    pen.text((beside, middle), _shortened(doing, room, pen, font), PALE_INK, font, anchor="lm")


def _shortened(text: str, room: float, pen: ImageDraw.ImageDraw, font: Font) -> str:
    """Return as many letters as fit into `room` pixels."""
    if pen.textlength(text, font) <= room:
        return text
    fitting = [end for end in range(1, len(text)) if pen.textlength(text[:end] + "...", font) <= room]
    return text[: fitting[-1]] + "..." if fitting else ""
