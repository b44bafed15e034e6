"""Writers that pull frames, fed by one simulation that pushes them: a thread for each stage."""

from __future__ import annotations

import queue
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from balloon_usd.stage import StageError, write_stage

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from balloon_usd.cli.form import Form
    from balloon_usd.stage import StageDescription, StageFrame, WrittenStage

FRAMES_WAITING = 2
"""Frames that may wait for the disk: memory stays flat however slow it is."""
PATIENCE = 0.1
"""Time after which a writer that takes nothing is looked after (s)."""


class _Stopped(Exception):  # noqa: N818
    """Ends the frames of a writer whose stage is no longer wanted."""


class StageWriter:
    """One stage in the making. It keeps the frames that it is given: they must not change afterwards."""

    def __init__(
        self,
        threads: ThreadPoolExecutor,
        description: StageDescription,
        folder: Path,
        detail: str,
        form: Form,
    ) -> None:
        """Start writing; needs a thread of its own among `threads`."""
        self.name = description.name
        self._frames: queue.Queue[StageFrame | _Stopped | None] = queue.Queue(FRAMES_WAITING)
        self._writing: Future[WrittenStage] = threads.submit(
            write_stage,
            description,
            self._arriving(),
            folder,
            detail=detail,
            flat=form.flat,
            usdz=form.usdz,
            look=form.look,
            shot=form.shot,
        )

    def _arriving(self) -> Iterator[StageFrame]:
        while (frame := self._frames.get()) is not None:
            if isinstance(frame, _Stopped):
                raise frame
            yield frame

    def put(self, frame: StageFrame) -> None:
        """Hand over the next frame.

        Raises:
            StageError: the stage cannot be written.
        """
        self._hand_over(frame)

    def finish(self) -> WrittenStage:
        """Give the stage its final name; no frame comes after this.

        Raises:
            StageError: the stage cannot be written.
        """
        self._hand_over(None)
        return self._writing.result()

    def stop(self) -> None:
        """Give up the stage and remove what was written of it; does nothing to a finished one."""
        while not self._writing.done():
            try:
                self._frames.put(_Stopped(), timeout=PATIENCE)
            except queue.Full:
                continue
            self._writing.exception()

    def _hand_over(self, item: StageFrame | None) -> None:
        while True:
            if self._writing.done():
                self._writing.result()
                raise StageError(f'"{self.name}" took no more frames')
            try:
                self._frames.put(item, timeout=PATIENCE)
            except queue.Full:
                continue
            return


@contextmanager
def stage_writers(
    descriptions: Sequence[StageDescription], folder: Path, detail: str, form: Form
) -> Iterator[list[StageWriter]]:
    """Write stages side by side; those that are not finished at the end of the block leave nothing."""
    with ThreadPoolExecutor(max_workers=len(descriptions)) as threads:
        writers: list[StageWriter] = []
        try:
            for description in descriptions:
                writers.append(StageWriter(threads, description, folder, detail, form))  # noqa: PERF401
            yield writers
        finally:
            for writer in writers:
                writer.stop()
