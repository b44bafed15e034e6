"""Frames that a simulator leaves for writers in shared memory, used over and over as a ring of slots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.batch.shared_memory import SharedMemory
    from balloon_usd.solver.frame_arrays import Extent, FrameArrays, Place

SLOT_BYTES = 16 * 2**20
"""Frames that travel together [B]: four of 128 draft dogs. One at a time, the scheduler of four simulators
and 24 writers would pass on 13,000 messages a second."""
MOST_FRAMES = 64
"""Frames in a slot at most."""
SLOTS = 6
"""Slots of a ring: writers may be so far behind the simulator before that waits. They are used last in, first
out, so those that are never needed take no memory."""


@dataclass(frozen=True)
class RingShape:
    """Sizes of a ring."""

    frames: int
    """Frames in a slot."""
    frame_bytes: int
    slots: int = SLOTS

    @classmethod
    def of(cls, extent: Extent) -> RingShape:
        """Choose how many frames of so much travel together."""
        size = frame_bytes(extent)
        return cls(min(MOST_FRAMES, max(1, SLOT_BYTES // max(size, 1))), size)

    @property
    def size(self) -> int:
        """Of the whole ring [B]."""
        return max(1, self.slots * self.frames * self.frame_bytes)


@dataclass(frozen=True)
class FrameLayout:
    """How the frames of a batch lie in its ring."""

    shape: RingShape
    extent: Extent
    places: tuple[Place, ...]
    """Where every sculpture lies in a frame."""


class FrameRing:
    """Frames of a batch in shared memory."""

    def __init__(self, layout: FrameLayout, memory: SharedMemory) -> None:
        """Show the frames that lie in a memory."""
        self.layout = layout
        self._bytes: NDArray[np.uint8] = np.frombuffer(memory.buffer, dtype=np.uint8)

    def frame_arrays(self, slot: int, number: int) -> FrameArrays:
        """Return the arrays of a frame, counted from 0 in its slot."""
        free = (slot * self.layout.shape.frames + number) * self.layout.shape.frame_bytes

        def make(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
            nonlocal free
            array: NDArray[Any] = np.ndarray(shape, kind, self._bytes, free)
            free += array.nbytes
            return array

        return self.layout.extent.frame_arrays(make)


def frame_bytes(extent: Extent) -> int:
    """Return the size of a frame of so much [B]."""
    size = 0

    def make(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
        nonlocal size
        array: NDArray[Any] = np.empty(shape, kind)
        size += array.nbytes
        return array

    extent.frame_arrays(make)
    return size
