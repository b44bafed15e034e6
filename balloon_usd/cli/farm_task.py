"""`balloon-usd farm-task`: one chunk of a job of a render farm; job templates call it."""

from __future__ import annotations

import sys
from contextlib import redirect_stderr
from pathlib import Path

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.run import run


@click.command(hidden=True, epilog=EXIT_CODES_HELP)
@click.argument("chunks", type=click.Path(path_type=Path))
@click.argument("number", type=int)
@click.argument("folder", type=click.Path(path_type=Path))
@click.argument("options", nargs=-1, type=click.UNPROCESSED, metavar="[-- OPTION OF RUN]...")
def farm_task(chunks: Path, number: int, folder: Path, options: tuple[str, ...]) -> None:
    """Run one chunk of the recipes in FOLDER: line NUMBER of the file CHUNKS, a JSON list of paths.

    Progress is told as a farm reads it: openjd_progress and openjd_status.
    """
    from balloon_usd.farm import TaskLog, chunk_of_line  # noqa: PLC0415

    try:
        recipes = chunk_of_line(chunks.read_text(encoding="utf-8"), number)
    except OSError as error:
        raise Failure(f"{chunks}: cannot be read ({error.strerror or error})", ExitCode.BAD_INPUT) from error
    except ValueError as error:
        raise Failure(f"{chunks}: {error}", ExitCode.BAD_INPUT) from error
    words = [*options, "--progress", "lines", "--", *(str(folder / recipe) for recipe in recipes)]
    with redirect_stderr(TaskLog(sys.stdout)), run.make_context("run", words) as context:
        run.invoke(context)
