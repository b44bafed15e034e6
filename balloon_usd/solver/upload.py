"""What is sent to a device without waiting for it: from memory that it reads by itself.

An array of the host's own would wait until all is done that the device was told before.
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
"""Bytes, by a multiple of which every array begins."""


class Parcel:
    """Small arrays of a scene that lie together on the device and, for filling, on the host: each copy by
    itself takes as long as many.
    """

    def __init__(self, scene: Scene, names: Iterable[str]) -> None:
        """Move arrays of a scene together, with what they hold."""
        device = wp.get_device(scene.device)
        before = {name: scene.arrays[name] for name in names}
        sizes = [-(-a.size * wp.types.type_size_in_bytes(a.dtype) // ALIGNMENT) for a in before.values()]
        starts = ALIGNMENT * np.cumsum([0, *sizes])
        total = int(starts[-1])
        self._away = wp.zeros(total, dtype=wp.uint8, device=device)
        self._here = wp.zeros(total, dtype=wp.uint8, device="cpu", pinned=device.is_cuda)
        self._views: dict[str, NDArray[Any]] = {}
        room = self._here.numpy()
        for (name, array), start in zip(before.items(), starts[:-1].tolist(), strict=True):
            held = array.numpy()
            view = np.ndarray(held.shape, held.dtype, buffer=room, offset=start)
            view[...] = held
            self._views[name] = view
            scene.arrays[name] = wp.array(
                ptr=self._away.ptr + start, shape=array.shape, dtype=array.dtype, device=device
            )
        self._sent = wp.Event(device) if device.is_cuda else None
        self.send({})

    def send(self, values: Mapping[str, NDArray[Any]]) -> None:
        """Send all, after these arrays have changed; where the device is a GPU, without waiting."""
        if self._sent is not None:
            wp.synchronize_event(self._sent)
        for name, new in values.items():
            self._views[name][...] = new
        wp.copy(self._away, self._here)
        if self._sent is not None:
            wp.get_stream(self._sent.device).record_event(self._sent)


class Letter:
    """An array of a scene that only the host changes, or part of it, now and then."""

    def __init__(self, scene: Scene, name: str) -> None:
        """Take note of what it holds."""
        self._away = scene.arrays[name]
        device = wp.get_device(scene.device)
        self._here: Any = wp.array(
            self._away.numpy(), dtype=self._away.dtype, device="cpu", pinned=device.is_cuda
        )
        self._values: NDArray[Any] = self._here.numpy()
        self._row = self._here.size // len(self._values)
        self._sent = wp.Event(device) if device.is_cuda else None

    def open(self) -> NDArray[Any]:
        """Return what was written last, to be changed and sent, once the device has read what was sent."""
        if self._sent is not None:
            wp.synchronize_event(self._sent)
        return self._values

    def send(self, begin: int = 0, end: int | None = None) -> None:
        """Send some rows, or all."""
        end = len(self._values) if end is None else end
        if end > begin:
            first, count = begin * self._row, (end - begin) * self._row
            wp.copy(self._away, self._here, first, first, count)
        if self._sent is not None:
            wp.get_stream(self._sent.device).record_event(self._sent)
