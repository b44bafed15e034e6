"""Progress: what the hands do, how far, how fast, how long still. A bar for people, lines for programs."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

import click
from rich.markup import escape
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from balloon_usd.cli.console import Terminal

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.batch.watch import Count

DOING_WIDTH = 40
"""Characters for what the hands do, so that the bar stands still."""


class FrameRate(ProgressColumn):
    """Frames of all sculptures per second."""

    def render(self, task: Any) -> Text:
        """Show the recent speed, or that of the whole task when it is done."""
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:.0f} frames/s", no_wrap=True)


class Shown(Protocol):
    """Progress on the error stream."""

    def advance(self, doing: str, frames: int, count: Count) -> None:
        """Say what is done now, count frames, and tell how many recipes are where."""


class _Bar:
    """A running bar."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._progress = progress
        self._task = progress.add_task("getting ready".ljust(DOING_WIDTH), total=total)

    def advance(self, doing: str, frames: int, count: Count) -> None:
        told = counts(count) or doing
        shown = told if len(told) <= DOING_WIDTH else told[: DOING_WIDTH - 3] + "..."
        self._progress.update(self._task, description=escape(shown.ljust(DOING_WIDTH)), advance=frames)


class _Lines:
    """A line for each step of all sculptures: progress DONE/TOTAL DOING."""

    def __init__(self, total: int) -> None:
        self._done, self._total = 0, total
        self._tell("getting ready")

    def advance(self, doing: str, frames: int, count: Count) -> None:
        self._done += frames
        self._tell(f"{counts(count)}: {doing}" if count.all > 1 else doing)

    def _tell(self, doing: str) -> None:
        click.echo(f"progress {self._done}/{self._total} {doing}", err=True)


def counts(count: Count) -> str:
    """Say how many recipes are done, at work and failed; nothing of one alone."""
    if count.all == 1:
        return ""
    failed = f", {count.failed} failed" if count.failed else ""
    return f"{count.done} of {count.all} done, {count.running} running{failed}"


@contextmanager
def show_progress(total: int, *, lines: bool) -> Iterator[Shown]:
    """Show how many of `total` frames are done; away from a terminal only the end of a bar is printed."""
    if lines:
        yield _Lines(total)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        FrameRate(),
        TimeRemainingColumn(compact=True),
    )
    with Progress(*columns, console=Terminal(stderr=True)) as progress:
        yield _Bar(progress, total)
