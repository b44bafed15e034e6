"""The writer process: frames from shared memory into stages and reports, stages into contact sheets."""

from __future__ import annotations

import pickle
import traceback
from collections import deque
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.channel import receive_ring
from balloon_usd.batch.facts import Refusal, survey
from balloon_usd.batch.frame_ring import SLOTS, FrameRing
from balloon_usd.batch.leftovers import remove_leftovers
from balloon_usd.batch.messages import (
    Begin,
    Copied,
    Draw,
    Drop,
    Frames,
    Made,
    NotMade,
    Ring,
    Started,
    Survey,
    Surveyed,
    Trouble,
    Verified,
    Verify,
)
from balloon_usd.batch.reading import RecipeChanged, planned
from balloon_usd.batch.sculpture import NoFrames, Sculpture
from balloon_usd.batch.sheet import draw
from balloon_usd.files.hashes import are_whole
from balloon_usd.language.problem import RecipeError
from balloon_usd.report import ReportError
from balloon_usd.stage import StageError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from balloon_usd.batch.facts import Facts
    from balloon_usd.batch.messages import Part, Start
    from balloon_usd.solver.frame import Frame

MOST_HEARD = SLOTS
"""Messages that are heard before the next sculpture is finished, at most: as many as there may be frames."""
EXPECTED = (StageError, ReportError)
"""What may go wrong with a sculpture without a mistake in this program."""
OF_RECIPE = (RecipeChanged, RecipeError)
"""The same, with messages that begin with the file of the recipe."""


class Writer:
    """Writes sculptures side by side, and answers questions about recipes and files."""

    def __init__(self, connection: Connection[Any, Any], start: Start) -> None:
        """Get ready; what it takes is imported by now."""
        self._connection = connection
        self._order = start.order
        self._batches: dict[int, _Batch] = {}
        self._complete: deque[Sculpture] = deque()
        """Sculptures that have all their frames, or have failed, and no final names yet."""
        self._heard = 0
        """Messages since one was finished."""
        connection.send(Started())

    def run(self) -> None:
        """Write until the connection ends; raises `EOFError` then."""
        while True:
            if self._complete and not self._frames_first():
                self._finish(self._complete[0])
                continue
            message = self._connection.recv()
            if isinstance(message, Survey):
                self._survey(message)
            elif isinstance(message, Verify):
                self._verify(message)
            elif isinstance(message, Begin):
                self._begin(message)
            elif isinstance(message, Ring):
                self._open_ring(message)
            elif isinstance(message, Frames):
                self._take(message)
            elif isinstance(message, Drop):
                self._drop(message)
            elif isinstance(message, Draw):
                self._connection.send(draw(message, self._order))
            else:
                raise TypeError(f"a writer was told {type(message).__name__}")

    def _frames_first(self) -> bool:
        """Whether the next sculpture is finished later: simulators wait when frames are taken late."""
        growing = sum(len(batch.sculptures) for batch in self._batches.values())
        few = len(self._complete) <= growing and self._heard < MOST_HEARD
        self._heard = self._heard + 1 if few and self._connection.poll() else 0
        return self._heard > 0

    def close(self) -> None:
        """Remove what is half-written."""
        for sculpture in self._complete:
            sculpture.stop()
        for batch in self._batches.values():
            for sculpture in batch.sculptures.values():
                sculpture.stop()

    def _survey(self, asked: Survey) -> None:
        found = tuple((job, self._survey_one(file)) for job, file in asked.files)
        self._connection.send(Surveyed(found))

    def _survey_one(self, file: str) -> Facts | Refusal:
        try:
            return survey(file, self._order)
        except Exception:  # no recipe takes another one along
            return Refusal((f"{file}: {traceback.format_exc()}",))

    def _verify(self, asked: Verify) -> None:
        whole = []
        for job, name, files in asked.sculptures:
            remove_leftovers(self._order.folder, name)
            whole.append((job, are_whole(self._order.folder, files)))
        self._connection.send(Verified(tuple(whole)))

    def _begin(self, begin: Begin) -> None:
        batch = self._batches[begin.batch] = _Batch()
        for part in begin.parts:
            try:
                self._start(part, batch)
            except Exception as error:  # no sculpture takes another one along
                self._connection.send(_not_made(part, error))
                if sculpture := batch.sculptures.get(part.place):
                    sculpture.stop()
                    del batch.sculptures[part.place]
        if not batch.sculptures:
            del self._batches[begin.batch]

    def _start(self, part: Part, batch: _Batch) -> None:
        plan = planned(part.file, part.origin, part.plan)
        remove_leftovers(self._order.folder, plan.recipe.name)
        sculpture = batch.sculptures[part.place] = Sculpture(part, plan, self._order)
        sculpture.start()

    def _open_ring(self, ring: Ring) -> None:
        memory = receive_ring(self._connection, ring)
        if batch := self._batches.get(ring.batch):
            batch.ring = FrameRing(pickle.loads(ring.layout), memory)  # noqa: S301  # from ourselves
        memory.close()

    def _take(self, frames: Frames) -> None:
        """Copy frames out of their slot, let that be used again, and write them."""
        batch = self._batches.get(frames.batch)
        if batch is None or batch.ring is None:
            self._connection.send(Copied(frames.batch, frames.slot))
            return
        taken = {place: batch.copies(sculpture, frames) for place, sculpture in batch.sculptures.items()}
        self._connection.send(Copied(frames.batch, frames.slot))
        for place, found in taken.items():
            self._write(batch, place, found)
        for place, (_, cause) in frames.failed.items():
            if sculpture := batch.sculptures.pop(place, None):
                sculpture.failed = cause
                self._complete.append(sculpture)
        if not batch.sculptures:
            del self._batches[frames.batch]

    def _write(self, batch: _Batch, place: int, frames: list[Any]) -> None:
        sculpture, told = batch.sculptures[place], None
        try:
            for frame in frames:
                sculpture.add(frame)
        except Exception as error:  # no sculpture takes another one along
            told = _not_made(sculpture.part, error)
        if told is not None:
            # The error is gone, and with it what it kept mapped of deleted files: a full disk has room again.
            sculpture.stop()
            self._connection.send(told)
            del batch.sculptures[place]
            return
        if frames and frames[-1].time_code == sculpture.part.last:
            self._complete.append(sculpture)
            del batch.sculptures[place]

    def _finish(self, sculpture: Sculpture) -> None:
        told: Made | NotMade
        try:
            told = sculpture.finish()
        except Exception as error:  # no sculpture takes another one along
            told = _not_made(sculpture.part, error, sculpture.failed)
        if isinstance(told, NotMade):
            sculpture.stop()
        self._connection.send(told)
        # Until now `close` finds it, whatever ends this process.
        self._complete.popleft()

    def _drop(self, drop: Drop) -> None:
        for sculpture in list(self._complete):
            part = sculpture.part
            if part.batch == drop.batch and (not drop.jobs or part.job in drop.jobs):
                sculpture.stop()
                self._complete.remove(sculpture)
        batch = self._batches.get(drop.batch)
        if batch is None:
            return
        for place, sculpture in list(batch.sculptures.items()):
            if not drop.jobs or sculpture.part.job in drop.jobs:
                sculpture.stop()
                del batch.sculptures[place]
        if not batch.sculptures:
            del self._batches[drop.batch]


class _Batch:
    """What a writer has of one batch."""

    def __init__(self) -> None:
        self.sculptures: dict[int, Sculpture] = {}
        """By their places in the batch."""
        self.ring: FrameRing | None = None

    def copies(self, sculpture: Sculpture, frames: Frames) -> list[Frame]:
        """Return copies of those of some frames that show a sculpture."""
        assert self.ring is not None, "frames come after their ring"
        place = sculpture.part.place
        end = min(frames.first + frames.count, sculpture.part.last + 1)
        if failed := frames.failed.get(place):
            end = min(end, failed[0])
        found = []
        for code in range(frames.first, end):
            arrays = self.ring.frame_arrays(frames.slot, code - frames.first)
            status = sculpture.status_at(code, frames.statuses)
            found.append(arrays.frame(self.ring.layout.places[place], code, *status).copy())
        return found


def _not_made(part: Part, error: Exception, failed: str = "") -> NotMade:
    """Return what is told of a sculpture that an error ended; `failed`: why its simulation ended before."""
    trouble, why = Trouble.NOT_WRITTEN, f"{part.file}: {error}"
    if isinstance(error, NoFrames):
        trouble, why = Trouble.FAILED, f"{part.file}: simulation failed {failed}"
    elif isinstance(error, OF_RECIPE):
        why = str(error)
    elif not isinstance(error, EXPECTED):
        trouble = Trouble.UNFORESEEN
        before = f"simulation failed {failed}; then " if failed else ""
        why = f"{part.file}: {before}{''.join(traceback.format_exception(error))}"
    elif failed:
        trouble = Trouble.FAILED
        why = f"{part.file}: simulation failed {failed}; the frames before that are not kept: {error}"
    return NotMade(part.job, part.batch, trouble, why)
