"""Putting a report where it was asked for, whole or not at all."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.files.failed_name import failed_name
from balloon_usd.files.whole_file import write_whole
from balloon_usd.report.document import report_data, report_text
from balloon_usd.report.error import ReportError
from balloon_usd.report.figure import draw_figure

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    from balloon_usd.report.history import History


def report_files(folder: str | PathLike[str], name: str) -> tuple[Path, Path]:
    """Return where the numbers and the figure of a sculpture go: NAME.report.json and NAME.report.png."""
    return Path(folder, f"{name}.report.json"), Path(folder, f"{name}.report.png")


def write_report(
    history: History,
    folder: str | PathLike[str],
    *,
    detail: str,
    provenance: Mapping[str, str],
    quality: Mapping[str, Any] | None = None,
    failed: str = "",
) -> tuple[Path, Path]:
    """Write the numbers and the figure of a run and return their files; see `report_data`.

    Both files are written beside their final names before either gets it. After a failure
    they are called NAME.failed.

    Raises:
        ReportError: nothing was seen, the disk is full, or the folder cannot be written.
    """
    if not history.time_codes:
        raise ReportError(f"{history.plan.recipe.name}: there is nothing to report, no frame was seen")
    picture = BytesIO()
    draw_figure(history, detail=detail, failed=failed).save(picture, format="PNG")
    data = report_data(history, detail=detail, provenance=provenance, quality=quality, failed=failed)
    text = report_text(data)
    name = history.plan.recipe.name
    numbers, figure = report_files(folder, failed_name(name) if failed else name)
    try:
        write_whole({numbers: text.encode("utf-8"), figure: picture.getvalue()})
    except OSError as error:
        raise ReportError(f"{error.filename} cannot be written: {error.strerror or error}") from error
    return numbers, figure
