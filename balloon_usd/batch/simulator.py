"""The simulator process: plans in, frames into shared memory."""

from __future__ import annotations

import pickle
import time
import traceback
from contextlib import closing
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.batch.channel import receive_ring
from balloon_usd.batch.frame_ring import FrameLayout, FrameRing, RingShape
from balloon_usd.batch.messages import (
    Drop,
    Frames,
    Free,
    LaidOut,
    Ring,
    Simulate,
    Simulated,
    Started,
)
from balloon_usd.batch.reading import RecipeChanged, planned
from balloon_usd.language.problem import RecipeError
from balloon_usd.solver import simulation as solver
from balloon_usd.solver.errors import DeviceUnavailable
from balloon_usd.solver.status import Status

if TYPE_CHECKING:
    from collections.abc import Sequence
    from multiprocessing.connection import Connection

    from numpy.typing import NDArray

    from balloon_usd.batch.messages import Part, Start
    from balloon_usd.solver.frame_arrays import FrameArrays
    from balloon_usd.solver.simulation import Simulation
    from balloon_usd.solver.snapshot import Change, Snapshot

LONGEST_WAIT = 0.2
"""Frames travel after this time even if their slot has room for more (s)."""
OF_DEVICE = ("Failed to allocate", "CUDA error", "Warp CUDA error", "out of memory")
"""What Warp says when a device has no memory for a batch, or is gone."""


class _Dropped(Exception):  # noqa: N818
    """Ends a simulation that nobody wants any more."""


class Simulator:
    """Simulates batches, one after the other."""

    def __init__(self, connection: Connection[Any, Any], start: Start) -> None:
        """Start Warp on a device and load the model that most recipes have."""
        self._connection = connection
        self._order = start.order
        self._device = ""
        connection.send(self._started(start.device))

    def _started(self, name: str) -> Started:
        import warp as wp  # noqa: PLC0415

        from balloon_usd.solver.device import device_named, start_warp  # noqa: PLC0415

        try:
            start_warp()
            # Of all devices, this one takes the first; the scheduler starts others for the rest.
            self._device = device_named("cuda" if name == "all" else name)
            # What names no device means this one.
            wp.set_device(self._device)
            solver.model_named("latex")
        except DeviceUnavailable as error:
            return Started(problem=str(error))
        except OSError as error:
            return Started(problem=_no_cache(error))
        device = wp.get_device(self._device)
        cuda = tuple(other.alias for other in wp.get_cuda_devices())
        if not device.is_cuda:
            return Started(self._device, cuda)
        return Started(self._device, cuda, device.sm_count, device.free_memory)

    def run(self) -> None:
        """Simulate until the connection ends; raises `EOFError` then."""
        while True:
            message = self._connection.recv()
            if isinstance(message, Simulate):
                self._connection.send(self._simulated(message))
            elif isinstance(message, Ring):
                # Of a batch that was over before its first frame: the handle has to be taken.
                receive_ring(self._connection, message).close()

    def close(self) -> None:
        """Leave nothing: there is nothing."""

    def _simulated(self, task: Simulate) -> Simulated:
        """Simulate a batch and say how that ended."""
        try:
            _Run(self._connection, task).frames(self._simulation(task.parts, task.threads))
        except _Dropped:
            pass
        except (EOFError, BrokenPipeError, ConnectionResetError):
            raise
        except Exception as error:  # whatever it is, other batches go on
            return _problem(task.batch, error)
        return Simulated(task.batch)

    def _simulation(self, parts: Sequence[Part], threads: int) -> Simulation:
        plans = [planned(part.file, part.origin, part.plan) for part in parts]
        return solver.simulate_many(plans, detail=self._order.detail, device=self._device, threads=threads)


class _Run:
    """One batch on its way into shared memory."""

    def __init__(self, connection: Connection[Any, Any], task: Simulate) -> None:
        self._connection = connection
        self._batch = task.batch
        self._last = np.array([part.last for part in task.parts])
        self._wanted = np.ones(len(task.parts), dtype=np.bool_)
        self._place = {part.job: place for place, part in enumerate(task.parts)}
        self._status = [Status("")] * len(task.parts)
        self._ring: FrameRing | None = None
        self._free: list[int] = []
        self._slot: _Slot | None = None

    def frames(self, simulation: Simulation) -> None:
        """Pass frames on until every sculpture has its last one, or has failed."""
        shape = RingShape.of(simulation.extent)
        layout = FrameLayout(shape, simulation.extent, tuple(simulation.places))
        self._connection.send(LaidOut(self._batch, shape.size, pickle.dumps(layout)))
        with closing(simulation.snapshots(self._memory)) as snapshots:
            for snapshot in snapshots:
                self._attend()
                self._take(snapshot)
                if not self._wanted.any():
                    break
        self._flush()

    def _memory(self) -> FrameArrays:
        """Return where the next frame goes; wait for a slot if none is free."""
        while self._ring is None or (self._slot is None and not self._free):
            self._hear(self._connection.recv())
        if self._slot is None:
            self._slot = _Slot(self._free.pop())
        return self._ring.frame_arrays(self._slot.number, self._slot.count)

    def _take(self, snapshot: Snapshot) -> None:
        """Take note of the frame that was written last."""
        slot, code = self._slot, snapshot.time_code
        assert slot is not None, "a frame was written into a slot"
        slot.first = slot.first or code
        for change in snapshot.changes:
            self._note(slot, code, change)
        self._wanted &= snapshot.made & (code < self._last)
        slot.count += 1
        slot.doing = self._told(snapshot.made) or slot.doing
        # The first frame is not kept waiting: somebody may look out for it.
        full = self._ring is None or slot.count == self._ring.layout.shape.frames
        if full or slot.age > LONGEST_WAIT or code == 1:
            self._flush()

    def _note(self, slot: _Slot, code: int, change: Change) -> None:
        place = change.plan
        if change.failed is not None and self._wanted[place]:
            slot.failed[place] = (code, str(change.failed))
        status = Status(change.doing, change.undone)
        if status != self._status[place]:
            self._status[place] = status
            slot.statuses.setdefault(code, {})[place] = status

    def _told(self, made: NDArray[np.bool_]) -> str:
        """Say what the hands do, of the first sculpture that moves when there are several."""
        if not made.any():
            return ""
        doing, running = self._status[int(np.argmax(made))].doing, int(made.sum())
        return doing if len(made) == 1 else f"{running} sculptures, {doing}"

    def _attend(self) -> None:
        """Hear what has been said meanwhile; raises `EOFError` when the scheduler is gone."""
        while self._connection.poll():
            self._hear(self._connection.recv())

    def _hear(self, message: object) -> None:
        if isinstance(message, Free):
            if message.batch == self._batch:
                self._free.append(message.slot)
        elif isinstance(message, Ring):
            memory = receive_ring(self._connection, message)
            if message.batch == self._batch:
                layout: FrameLayout = pickle.loads(message.layout)  # noqa: S301  # from ourselves
                self._ring = FrameRing(layout, memory)
                self._free = list(range(layout.shape.slots))
            memory.close()
        elif isinstance(message, Drop):
            if message.batch == self._batch:
                self._drop(message.jobs)
        else:
            raise TypeError(f"a simulator at work was told {type(message).__name__}")

    def _drop(self, jobs: Sequence[int]) -> None:
        for job in jobs or self._place:
            self._wanted[self._place[job]] = False
        if not self._wanted.any():
            raise _Dropped

    def _flush(self) -> None:
        """Let the frames travel that are in the open slot."""
        slot, self._slot = self._slot, None
        if slot is not None and slot.count:
            told = (slot.first, slot.count, slot.doing, slot.statuses, slot.failed)
            self._connection.send(Frames(self._batch, slot.number, *told))


class _Slot:
    """A slot of the ring that is being filled."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.first = 0
        """Time code of its first frame."""
        self.count = 0
        self.doing = ""
        self.statuses: dict[int, dict[int, Status]] = {}
        self.failed: dict[int, tuple[int, str]] = {}
        self._opened = time.monotonic()

    @property
    def age(self) -> float:
        """Time since it was opened (s)."""
        return time.monotonic() - self._opened


def _problem(batch: int, error: Exception) -> Simulated:
    """Say what ended a batch before its time, and whom it is to be blamed on."""
    if isinstance(error, OSError) and _in_cache(error):
        return Simulated(batch, _no_cache(error), of_all=True)
    # Warp tells of its devices by no kind of error of their own.
    of_device = isinstance(error, RuntimeError) and any(sign in str(error) for sign in OF_DEVICE)
    if of_device or isinstance(error, MemoryError):
        text = (str(error).strip() or "out of memory").splitlines()[0]
        return Simulated(batch, text, of_device=True)
    if isinstance(error, RecipeChanged | RecipeError):
        return Simulated(batch, str(error), of_recipe=True)
    return Simulated(batch, "".join(traceback.format_exception(error)))


def _in_cache(error: OSError) -> bool:
    """Whether an error is about the folder of compiled kernels."""
    import warp as wp  # noqa: PLC0415

    cache = wp.config.kernel_cache_dir
    return cache is not None and str(error.filename or "").startswith(str(cache))


def _no_cache(error: OSError) -> str:
    """Say that compiled kernels cannot be kept."""
    place = f"{error.filename}: " if error.filename else ""
    text = f"{place}compiled kernels cannot be kept here ({error.strerror or error})"
    return f"{text}, set WARP_CACHE_PATH to a folder that can be written"
