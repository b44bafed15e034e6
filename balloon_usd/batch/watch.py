"""What is told of a batch while it is made."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.batch.facts import Facts
    from balloon_usd.batch.record import Record


@dataclass(frozen=True)
class Count:
    """How many recipes are in which state."""

    all: int
    running: int = 0
    done: int = 0
    failed: int = 0


class Watch(Protocol):
    """Somebody who is told how far a batch is."""

    def surveyed(self, accepted: Sequence[Facts], refused: Sequence[Record]) -> None:
        """Hear which recipes can be made, before anything is written; may raise to stop all."""

    def begun(self, device: str, frames: int) -> None:
        """Hear where it is computed and how many frames there are to simulate."""

    def advanced(self, doing: str, frames: int, count: Count) -> None:
        """Hear how many more frames were simulated, and how many recipes are where."""

    def ended(self, record: Record) -> None:
        """Hear what became of a recipe."""

    def said(self, text: str) -> None:
        """Hear what else happened: a process was killed, a device is out of memory."""


class Silence:
    """Nobody is told anything."""

    def surveyed(self, accepted: Sequence[Facts], refused: Sequence[Record]) -> None:
        """Hear nothing."""

    def begun(self, device: str, frames: int) -> None:
        """Hear nothing."""

    def advanced(self, doing: str, frames: int, count: Count) -> None:
        """Hear nothing."""

    def ended(self, record: Record) -> None:
        """Hear nothing."""

    def said(self, text: str) -> None:
        """Hear nothing."""


class Overheard:
    """Passes on what is told, and keeps what the watch raised."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self.raised: BaseException | None = None

    def surveyed(self, accepted: Sequence[Facts], refused: Sequence[Record]) -> None:
        """Pass on which recipes can be made."""
        with self._kept():
            self._watch.surveyed(accepted, refused)

    def begun(self, device: str, frames: int) -> None:
        """Pass on where it is computed."""
        with self._kept():
            self._watch.begun(device, frames)

    def advanced(self, doing: str, frames: int, count: Count) -> None:
        """Pass on how far it is."""
        with self._kept():
            self._watch.advanced(doing, frames, count)

    def ended(self, record: Record) -> None:
        """Pass on what became of a recipe."""
        with self._kept():
            self._watch.ended(record)

    def said(self, text: str) -> None:
        """Pass on what else happened."""
        with self._kept():
            self._watch.said(text)

    @contextmanager
    def _kept(self) -> Iterator[None]:
        try:
            yield
        except BaseException as error:
            self.raised = error
            raise
