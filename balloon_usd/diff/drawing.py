"""Put the picture and the page of a comparison where they were asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.diff.error import DiffError, DiffNotWrittenError
from balloon_usd.diff.page import diff_page
from balloon_usd.diff.sheet import draw_sheet
from balloon_usd.openusd import usd_access
from balloon_usd.preview import PictureNotWrittenError, PreviewError
from balloon_usd.preview.png_file import require_place, write_png, write_whole

if TYPE_CHECKING:
    from pathlib import Path

    from balloon_usd.diff.two_files import Comparison


STAGES = frozenset({".usd", ".usda", ".usdc", ".usdz"})
"""Endings of files that are never replaced: a layer of the stages might be among them."""


def require_places(*places: Path | None) -> None:
    """Look before anything is compared whether files may stand there.

    Raises:
        DiffError: a folder is in the way, or there is none to put it in; or it is the place of a stage, or
            the same for both.
    """
    wanted = [place for place in places if place is not None]
    try:
        for place in wanted:
            require_place(place)
    except PreviewError as error:
        raise DiffError(str(error)) from error
    for place in wanted:
        if place.suffix.lower() in STAGES:
            raise DiffError(f"{place} would replace a stage, expected a name that ends in .png or .html")
    if len({place.absolute() for place in wanted}) < len(wanted):
        raise DiffError(f"{wanted[0]} cannot be both picture and page")


@usd_access()
def draw_comparison(
    comparison: Comparison, *, png: Path | None = None, html: Path | None = None, device: str = "auto"
) -> None:
    """Write a picture, a page, or both; stages that show no mesh have a page without picture.

    Raises:
        DiffError: a picture is asked for of stages that show no mesh, or cannot be drawn.
        DiffNotWrittenError: the disk is full, or the folder cannot be written.
    """
    try:
        sheet = draw_sheet(comparison, device=device)
    except DiffError:
        if png is not None:
            raise
        sheet = None
    try:
        if png is not None and sheet is not None:
            write_png(sheet, png)
        if html is not None:
            write_whole(diff_page(comparison, sheet).encode("utf-8", "backslashreplace"), html)
    except PictureNotWrittenError as error:
        raise DiffNotWrittenError(str(error)) from error
