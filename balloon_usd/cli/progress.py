"""The progress bar: what the hands do, how far, how fast."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, ProgressColumn, TaskProgressColumn, TextColumn
from rich.text import Text

if TYPE_CHECKING:
    from collections.abc import Iterator

DOING_WIDTH = 44
"""Characters for what the hands do, so that the bar stands still."""


class FrameRate(ProgressColumn):
    """Frames of all sculptures per second."""

    def render(self, task: Any) -> Text:
        """Show the recent speed, or that of the whole task when it is done."""
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:.0f} frames/s")


class Doing:
    """A running bar."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._progress = progress
        self._task = progress.add_task("getting ready".ljust(DOING_WIDTH), total=total)

    def advance(self, doing: str, frames: int) -> None:
        """Say what is done now, and count frames."""
        shown = doing if len(doing) <= DOING_WIDTH else doing[: DOING_WIDTH - 3] + "..."
        self._progress.update(self._task, description=escape(shown.ljust(DOING_WIDTH)), advance=frames)


@contextmanager
def progress_bar(total: int) -> Iterator[Doing]:
    """Show a bar for `total` frames on the error stream; away from a terminal only its end is printed."""
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), FrameRate())
    with Progress(*columns, console=Console(stderr=True)) as progress:
        yield Doing(progress, total)
