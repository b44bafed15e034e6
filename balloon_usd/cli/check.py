"""`balloon-usd check`: everything that is wrong with stages."""

from __future__ import annotations

import json
from dataclasses import dataclass
from enum import IntEnum
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from balloon_usd.batch.order import FrameRange
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.frame_range import MOST_FRAMES, moments

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.check import CrossingReport, Report
    from balloon_usd.cli.child_process import ChildProcess

Frames = FrameRange | tuple[int, ...]

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


@dataclass(frozen=True)
class Told:
    """What is told of one stage, as text and as a JSON document."""

    result: Result
    text: str
    document: dict[str, Any]


@click.command(epilog=EXIT_CODES)
@click.argument("stages", nargs=-1, required=True, metavar="STAGE...")
@click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON document with all faults instead of text."
)
@click.option(
    "--no-nvidia", is_flag=True, help="Do not ask NVIDIA's validator, which takes most time and memory."
)
@click.option(
    "--crossings",
    is_flag=True,
    help="Count walls that pierce walls instead, in every frame; any of them is a fault.",
)
@click.option(
    "--frames", type=moments, metavar="A:B|A,B,C", help="Frames to count crossings in. Default: all of them."
)
def check(
    stages: tuple[str, ...], as_json: bool, no_nvidia: bool, crossings: bool, frames: Frames | None
) -> None:
    """Look for everything that is wrong with stages, and say what to do about it.

    STAGE is a USD file, or a folder NAME as `run` writes it. Every variant is looked at, by 28 of the 32
    properties of a stage, by the validators of usd-core, and by NVIDIA's where `pip install
    'balloon-usd[check]'` has brought it. Nothing is written.

    With --crossings only walls that pierce walls are looked for, in any closed meshes, as the stage is when
    it is opened. Where rubber is folded up in the neck of a joint they are counted apart, and are no fault.
    """
    from balloon_usd.cli.child_process import ChildProcess  # noqa: PLC0415

    if frames is not None and not crossings:
        raise Failure("--frames: not used without --crossings", ExitCode.BAD_INPUT)
    look = partial(_count, frames=frames) if crossings else partial(_check, nvidia=not no_nvidia)
    told: list[Told] = []
    with ChildProcess() as child:
        for stage in stages:
            told.append(_look(child, stage, look))
            if not as_json:
                click.echo(told[-1].text, err=told[-1].result is Result.UNREADABLE)
    if as_json:
        entries = [entry for each in told for entry in each.document["stages"]]
        click.echo(json.dumps({**told[0].document, "stages": entries}, indent=1, allow_nan=False))
    click.get_current_context().exit(int(max(each.result for each in told)))


def _look(child: ChildProcess, stage: str, look: Callable[[str], Told]) -> Told:
    """Check a stage in a child process, whatever becomes of that."""
    from balloon_usd.cli.child_process import DamagedError  # noqa: PLC0415

    try:
        told = child.call([stage], look, stage)
    except DamagedError as error:
        why = str(error)
    else:
        if told.result is not Result.UNREADABLE:
            child.pass_on()
        return told
    return child.call([], _damaged, stage, why)


def _check(stage: str, *, nvidia: bool) -> Told:
    from balloon_usd.check import check_file  # noqa: PLC0415

    return _told(check_file(stage, nvidia=nvidia))


def _count(stage: str, *, frames: Frames | None) -> Told:
    """Count the crossings of a stage."""
    from balloon_usd.check import count_crossings  # noqa: PLC0415

    return _told_of_crossings(count_crossings(stage, partial(_chosen, frames) if frames else None))


def _chosen(frames: Frames, times: list[float | None]) -> list[float | None]:
    """Return those of a stage's time codes that were asked for; all of a stage that stands still."""
    known = [time for time in times if time is not None]
    if isinstance(frames, FrameRange):
        first, last = frames.first or 0, frames.last or MOST_FRAMES
        return [time for time in known if first <= time <= last] if known else [None]
    return [float(code) for code in frames if known and known[0] <= code <= known[-1]]


def _told_of_crossings(report: CrossingReport) -> Told:
    from balloon_usd.check import crossings_document, crossings_line  # noqa: PLC0415

    found = Result.FAULTS if report.any else Result.FINE
    result = Result.UNREADABLE if report.unreadable else found
    return Told(result, crossings_line(report), crossings_document(report))


def _damaged(stage: str, why: str) -> Told:
    from balloon_usd.check import Report  # noqa: PLC0415

    return _told(Report(stage, unreadable=f"{stage}: damaged: {why}"))


def _told(report: Report) -> Told:
    from balloon_usd.check import document_of, text_of  # noqa: PLC0415

    found = Result.FAULTS if report.faults else Result.FINE
    result = Result.UNREADABLE if report.unreadable else found
    return Told(result, text_of(report), document_of([report]))
