"""`balloon-usd diff`: what two stages have not in common."""

from __future__ import annotations

import contextlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from balloon_usd.cli.child_memory import start_drawing
from balloon_usd.cli.device import device_option
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.output import require_readable_name
from balloon_usd.cli.tolerance import tolerance_options, tolerances_of

if TYPE_CHECKING:
    from balloon_usd.cli.child_process import ChildProcess

DIFFERENT = 1
EXIT_CODES = """\b
Exit codes:
  0    the same
  1    different
  2    cannot compare: a stage is missing or not whole, or an option is wrong,
       or the picture or page cannot be written
  130  interrupted
"""


@click.command(epilog=EXIT_CODES)
@click.argument("first", metavar="A", type=click.Path(path_type=Path))
@click.argument("second", metavar="B", type=click.Path(path_type=Path))
@tolerance_options
@click.option("--variants", is_flag=True, help="Compare what is in every selection of variants, too.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, with the measures of every time code.")
@click.option(
    "--png",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Draw both stages side by side, with the distance in colour.",
)
@click.option(
    "--html",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write one page with the differences and the pictures.",
)
@device_option
def diff(
    first: Path,
    second: Path,
    named: tuple[str, ...],
    absolute: float | None,
    relative: float | None,
    rms: float | None,
    variants: bool,
    as_json: bool,
    png: Path | None,
    html: Path | None,
    device: str,
) -> None:
    """Say what differs between two USD stages, whoever made them.

    A and B are USD files, or folders NAME as `run` writes them. Structure and metadata must be the same, and
    floats within the tolerance. Of a surface that moved it is told how far, and where and when most.
    """
    from balloon_usd.cli.child_process import ChildProcess, remove_unfinished  # noqa: PLC0415

    asked = Asked(named, absolute, relative, rms, variants)
    pages = [page for page in (png, html) if page is not None]
    with contextlib.ExitStack() as stack:
        for page in pages:
            stack.callback(remove_unfinished, page.parent, page.name)
        child = stack.enter_context(ChildProcess())
        text, same = _told(child, first, second, asked, as_json, png, html, device)
    click.echo(text)
    if not same:
        raise click.exceptions.Exit(DIFFERENT)


def _told(child: ChildProcess, first: Path, second: Path, asked: Asked, *options: Any) -> tuple[str, bool]:
    """Compare in a child process; return what is told, and whether the stages are the same.

    Raises:
        Failure: that is not possible.
    """
    from balloon_usd.cli.child_process import DamagedError  # noqa: PLC0415

    try:
        found = child.call([first, second], _compare, first, second, asked, *options)
    except DamagedError as error:
        why = str(error)
    else:
        child.pass_on()
        return found
    raise Failure(f"{_damaged_one(child, first, second, asked)}: damaged: {why}", ExitCode.BAD_INPUT)


@dataclass(frozen=True)
class Asked:
    """What is asked of a comparison."""

    named: tuple[str, ...]
    absolute: float | None
    relative: float | None
    rms: float | None
    variants: bool


def _compare(
    first: Path, second: Path, asked: Asked, as_json: bool, png: Path | None, html: Path | None, device: str
) -> tuple[str, bool]:
    """Compare and draw, in a child process; return what is told, and whether the stages are the same.

    Raises:
        DamagedError: a value of a stage cannot be read.
        Failure: the stages cannot be compared, or the picture or page cannot be written.
    """
    from balloon_usd.cli.child_process import DamagedError  # noqa: PLC0415

    for path in (first, second):
        require_readable_name(path)
    tolerances = tolerances_of(asked.named, asked.absolute, asked.relative, asked.rms)
    from balloon_usd.diff import DamagedStageError, DiffError, compare_files  # noqa: PLC0415
    from balloon_usd.diff.report import diff_json, diff_text  # noqa: PLC0415

    try:
        if png is not None or html is not None:
            from balloon_usd.diff.drawing import draw_comparison, require_places  # noqa: PLC0415

            require_places(png, html)
        comparison = compare_files(first, second, tolerances=tolerances, variants=asked.variants)
        if png is not None or html is not None:
            draw_comparison(comparison, png=png, html=html, device=start_drawing(device))
    except DamagedStageError as error:
        raise DamagedError(str(error)) from error
    except DiffError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error
    told = json.dumps(diff_json(comparison), allow_nan=False) if as_json else diff_text(comparison)
    return told, comparison.same


def _damaged_one(child: ChildProcess, first: Path, second: Path, asked: Asked) -> str:
    """Return which of two stages is damaged: the one that cannot be compared with itself, either."""
    from balloon_usd.cli.child_process import DamagedError  # noqa: PLC0415

    for path in (first, second):
        try:
            child.call([path], _compare, path, path, asked, False, None, None, "cpu")
        except (DamagedError, Failure):
            return str(path)
    return f"{first} or {second}"
