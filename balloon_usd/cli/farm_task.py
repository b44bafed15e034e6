"""`balloon-usd farm-task`: one chunk of a job of a render farm; job templates call it."""

from __future__ import annotations

import signal
import sys
from contextlib import contextmanager, redirect_stderr
from pathlib import Path
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.run import run

if TYPE_CHECKING:
    from collections.abc import Iterator


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
    with _ended_as_by_hand(), redirect_stderr(TaskLog(sys.stdout)), run.make_context("run", words) as context:
        run.invoke(context)


@contextmanager
def _ended_as_by_hand() -> Iterator[None]:
    """Clear up when the farm ends the task, as after Ctrl-C."""
    ends = [getattr(signal, name) for name in ("SIGTERM", "SIGBREAK") if hasattr(signal, name)]
    before = {end: signal.signal(end, signal.default_int_handler) for end in ends}
    try:
        yield
    finally:
        for end, handler in before.items():
            signal.signal(end, handler)
