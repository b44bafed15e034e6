"""Asynchronous uploads from pinned host memory. A copy from pageable memory would wait for all earlier work
of the device.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene

ALIGNMENT = 16
"""Alignment of every array in the buffer, bytes."""


class BatchedUpload:
    """Batches small host-to-device uploads of a scene into one buffer: per-copy latency dominates."""

    def __init__(self, scene: Scene, names: Iterable[str]) -> None:
        """Move arrays of a scene into one buffer, with their values."""
        device = wp.get_device(scene.device)
        before = {name: scene.arrays[name] for name in names}
        sizes = [-(-a.size * wp.types.type_size_in_bytes(a.dtype) // ALIGNMENT) for a in before.values()]
        starts = ALIGNMENT * np.cumsum([0, *sizes])
        total = int(starts[-1])
        self._device_array = wp.zeros(total, dtype=wp.uint8, device=device)
        self._host_array = wp.zeros(total, dtype=wp.uint8, device="cpu", pinned=device.is_cuda)
        self._views: dict[str, NDArray[Any]] = {}
        staging = self._host_array.numpy()
        for (name, array), start in zip(before.items(), starts[:-1].tolist(), strict=True):
            held = array.numpy()
            view = np.ndarray(held.shape, held.dtype, buffer=staging, offset=start)
            view[...] = held
            self._views[name] = view
            scene.arrays[name] = wp.array(
                ptr=self._device_array.ptr + start, shape=array.shape, dtype=array.dtype, device=device
            )
        self._sent = wp.Event(device) if device.is_cuda else None
        self.send({})

    def send(self, values: Mapping[str, NDArray[Any]]) -> None:
        """Upload all, after these arrays have changed; asynchronously on a GPU."""
        if self._sent is not None:
            wp.synchronize_event(self._sent)
        for name, new in values.items():
            self._views[name][...] = new
        wp.copy(self._device_array, self._host_array)
        if self._sent is not None:
            wp.get_stream(self._sent.device).record_event(self._sent)


class ArrayUpload:
    """Uploads an array of a scene, or rows of it, that only the host changes, in few frames."""

    def __init__(self, scene: Scene, name: str) -> None:
        """Copy its values to pinned memory."""
        self._device_array = scene.arrays[name]
        device = wp.get_device(scene.device)
        self._host_array: Any = wp.array(
            self._device_array.numpy(), dtype=self._device_array.dtype, device="cpu", pinned=device.is_cuda
        )
        self._values: NDArray[Any] = self._host_array.numpy()
        self._row = self._host_array.size // len(self._values)
        self._sent = wp.Event(device) if device.is_cuda else None

    def staged(self) -> NDArray[Any]:
        """Return the host copy, to be changed and sent, once the last upload is complete."""
        if self._sent is not None:
            wp.synchronize_event(self._sent)
        return self._values

    def send(self, begin: int = 0, end: int | None = None) -> None:
        """Upload some rows, or all."""
        end = len(self._values) if end is None else end
        if end > begin:
            first, count = begin * self._row, (end - begin) * self._row
            wp.copy(self._device_array, self._host_array, first, first, count)
        if self._sent is not None:
            wp.get_stream(self._sent.device).record_event(self._sent)
