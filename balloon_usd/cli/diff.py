"""`balloon-usd diff`: what two stages have not in common."""

from __future__ import annotations

import json
from pathlib import Path

import click

from balloon_usd.cli.device import device_option, start_device
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.output import require_readable_name
from balloon_usd.cli.tolerance import tolerance_options, tolerances_of

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
    for path in (first, second):
        require_readable_name(path)
    tolerances = tolerances_of(named, absolute, relative, rms)
    from balloon_usd.diff import DiffError, compare_files  # noqa: PLC0415
    from balloon_usd.diff.report import diff_json, diff_text  # noqa: PLC0415

    try:
        if png is not None or html is not None:
            from balloon_usd.diff.drawing import draw_comparison, require_places  # noqa: PLC0415

            require_places(png, html)
        comparison = compare_files(first, second, tolerances=tolerances, variants=variants)
        if png is not None or html is not None:
            draw_comparison(comparison, png=png, html=html, device=start_device(device))
    except DiffError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error
    click.echo(json.dumps(diff_json(comparison), allow_nan=False) if as_json else diff_text(comparison))
    if not comparison.same:
        raise click.exceptions.Exit(DIFFERENT)
