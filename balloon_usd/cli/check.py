"""`balloon-usd check`: everything that is wrong with stages."""

from __future__ import annotations

import json
from enum import IntEnum

import click

EXIT_CODES = """\b
Exit codes, the worst of all stages:
  0    fine
  1    faults were found
  2    a stage cannot be read
  130  interrupted
"""


class Result(IntEnum):
    """Exit codes of this command."""

    FINE = 0
    FAULTS = 1
    UNREADABLE = 2


@click.command(epilog=EXIT_CODES)
@click.argument("stages", nargs=-1, required=True, metavar="STAGE...")
@click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON document with all faults instead of text."
)
@click.option(
    "--no-nvidia", is_flag=True, help="Do not ask NVIDIA's validator, which takes most time and memory."
)
def check(stages: tuple[str, ...], as_json: bool, no_nvidia: bool) -> None:
    """Look for everything that is wrong with stages, and say what to do about it.

    STAGE is a USD file, or a folder NAME as `run` writes it. Every variant is looked at, by 28 of the 32
    properties of a stage, by the validators of usd-core, and by NVIDIA's where `pip install
    'balloon-usd[check]'` has brought it. Nothing is written.
    """
    from balloon_usd.check import check_file, document_of, text_of  # noqa: PLC0415

    reports = []
    for stage in stages:
        report = check_file(stage, nvidia=not no_nvidia)
        reports.append(report)
        if not as_json:
            click.echo(text_of(report), err=bool(report.unreadable))
    if as_json:
        click.echo(json.dumps(document_of(reports), indent=1, allow_nan=False))
    worst = Result.FINE
    for report in reports:
        found = Result.FAULTS if report.faults else Result.FINE
        worst = max(worst, Result.UNREADABLE if report.unreadable else found)
    click.get_current_context().exit(int(worst))
