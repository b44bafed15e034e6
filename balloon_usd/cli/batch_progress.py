"""What `run` tells of a batch on the error stream: problems, progress, what was skipped."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.output import require_writable
from balloon_usd.cli.progress import show_progress

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Self

    from balloon_usd.batch.facts import Facts
    from balloon_usd.batch.order import Order
    from balloon_usd.batch.record import Record
    from balloon_usd.batch.watch import Count
    from balloon_usd.cli.progress import Shown


class BatchProgress:
    """Tells people, or programs in lines, how far a batch is; a `balloon_usd.batch.Watch`."""

    def __init__(self, order: Order, *, lines: bool) -> None:
        self._order, self._lines = order, lines
        self._stack = ExitStack()
        self._shown: Shown | None = None
        self.device = ""
        """Where it was computed, once that is known."""

    def __enter__(self) -> Self:
        """Show nothing yet."""
        return self

    def __exit__(self, *trouble: object) -> None:
        """Take the bar away, or leave its last state."""
        self._stack.close()

    def surveyed(self, accepted: Sequence[Facts], refused: Sequence[Record]) -> None:
        """Tell all problems, notices and cautions of all recipes, and try the output folder.

        Raises:
            Failure: the output folder cannot be written.
        """
        for record in refused:
            click.echo(record.error, err=True)
        if accepted:
            require_writable(self._order.folder)
        for facts in accepted:
            for line in (*facts.notices, *facts.cautions):
                click.echo(line, err=True)

    def begun(self, device: str, frames: int) -> None:
        """Begin to show progress."""
        self.device = device
        self._shown = self._stack.enter_context(show_progress(frames, lines=self._lines))

    def advanced(self, doing: str, frames: int, count: Count) -> None:
        """Show how far all are."""
        if self._shown is not None:
            self._shown.advance(doing, frames, count)

    def ended(self, record: Record) -> None:
        """Tell what was skipped, as nothing else shows it."""
        from balloon_usd.batch.record import Status  # noqa: PLC0415

        if record.status is Status.SKIPPED:
            click.echo(f"{record.recipe}: already there and whole, skipped (--force makes it anew)", err=True)

    def said(self, text: str) -> None:
        """Tell it."""
        click.echo(text, err=True)
