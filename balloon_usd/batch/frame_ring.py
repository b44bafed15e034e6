"""Shared memory in which a simulator leaves frames for the writers, used over and over as a ring of slots."""

from __future__ import annotations

import mmap
import os
import secrets
import sys
import tempfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.sight import Extent, Sight

SLOT_BYTES = 2 * 2**20
"""Frames that travel together: more would make the first ones late [B]."""
MOST_FRAMES = 64
"""Frames in a slot at most."""
SLOTS = 6
"""Slots of a ring: writers may be so far behind the simulator before that waits."""


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


class SharedMemory:
    """Memory without a name in any file system, so that nothing is left of it however its processes end."""

    def __init__(self, size: int, handle: int | str | None = None) -> None:
        """Make memory of a size [B], or map that of a handle."""
        self.handle: int | str
        """File descriptor to send to another process; on Windows the name of the mapping."""
        if sys.platform == "win32":
            self.handle = f"balloon_usd_{secrets.token_hex(16)}" if handle is None else handle
            self._map = mmap.mmap(-1, size, tagname=self.handle)
        else:
            descriptor = handle if isinstance(handle, int) else _anonymous_file(size)
            self.handle = descriptor
            self._map = mmap.mmap(descriptor, size)

    def bytes(self) -> NDArray[np.uint8]:
        """Return all of it."""
        return np.frombuffer(self._map, dtype=np.uint8)

    def close(self) -> None:
        """Close the descriptor; the memory goes with the last array that shows it."""
        if isinstance(self.handle, int):
            os.close(self.handle)


def _anonymous_file(size: int) -> int:
    """Return the descriptor of a file in memory, or of one in a temporary folder that has no name there."""
    if sys.platform == "linux":
        descriptor = os.memfd_create("balloon_usd frames")
    else:
        with tempfile.TemporaryFile() as file:
            descriptor = os.dup(file.fileno())
    os.truncate(descriptor, size)
    return descriptor


class FrameRing:
    """Frames of a batch in shared memory."""

    def __init__(self, extent: Extent, shape: RingShape, memory: SharedMemory) -> None:
        """Show the frames of so much that lie in a memory."""
        self.shape = shape
        self._extent = extent
        self._bytes = memory.bytes()

    def sight(self, slot: int, number: int) -> Sight:
        """Return the arrays of a frame, counted from 0 in its slot."""
        free = (slot * self.shape.frames + number) * self.shape.frame_bytes

        def make(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
            nonlocal free
            array: NDArray[Any] = np.ndarray(shape, kind, self._bytes, free)
            free += array.nbytes
            return array

        return self._extent.sight(make)


def frame_bytes(extent: Extent) -> int:
    """Return the size of a frame of so much [B]."""
    size = 0

    def make(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
        nonlocal size
        array: NDArray[Any] = np.empty(shape, kind)
        size += array.nbytes
        return array

    extent.sight(make)
    return size
