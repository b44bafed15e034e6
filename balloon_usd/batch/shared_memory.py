"""Memory that processes share without a name in any file system."""

from __future__ import annotations

import mmap
import os
import secrets
import sys
import tempfile


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

    @property
    def buffer(self) -> mmap.mmap:
        """All of it, as bytes."""
        return self._map

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
