"""Read-back of device arrays to pinned host memory, asynchronous and buffered, once a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene

BUFFERS = 3
"""Host buffers: the latest and the one before it are read while the third is filled."""


class Readback:
    """Host copies of some arrays of a scene."""

    def __init__(self, scene: Scene, names: Sequence[str]) -> None:
        """Choose the arrays by the names that kernels give them."""
        self._device = wp.get_device(scene.device)
        self._sources = {name: scene.arrays[name] for name in names}
        self._buffers = [self._empty() for _ in range(BUFFERS)]
        self._views = [{name: copy.numpy() for name, copy in buffer.items()} for buffer in self._buffers]
        self.buffer = 0
        """Index of the buffer that was filled last, or is being filled."""
        self._copied = wp.Event(self._device) if self._device.is_cuda else None

    def _empty(self) -> dict[str, Any]:
        pinned = self._device.is_cuda
        return {
            name: wp.empty(source.shape, dtype=source.dtype, device="cpu", pinned=pinned)
            for name, source in self._sources.items()
        }

    def next_buffer(self) -> None:
        """Keep the last two buffers: the third is filled now."""
        self.buffer = (self.buffer + 1) % BUFFERS

    def copy(self) -> None:
        """Start copying all arrays; may be captured in a graph for each buffer."""
        for name, source in self._sources.items():
            wp.copy(self._buffers[self.buffer][name], source)

    def record(self) -> None:
        """Record an event behind the copies, for which `wait` waits."""
        if self._copied is not None:
            wp.get_stream(self._device).record_event(self._copied)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Wait for the copies and return them; they are valid for two more read-backs."""
        self.wait()
        return self._views[self.buffer]

    def wait(self) -> None:
        """Wait for the copies, not for work launched since."""
        if self._copied is not None:
            wp.synchronize_event(self._copied)
