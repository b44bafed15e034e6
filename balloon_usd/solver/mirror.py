"""Host copies of device arrays that are fetched together, once a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene


class Mirror:
    """Some arrays of a scene as the host last saw them."""

    def __init__(self, scene: Scene, names: Sequence[str]) -> None:
        """Choose the arrays by the names that kernels give them."""
        self._device = wp.get_device(scene.device)
        self._sources = {name: scene.arrays[name] for name in names}
        self._copies = dict(self._sources)
        if self._device.is_cuda:
            self._copies = {
                name: wp.empty(source.shape, dtype=source.dtype, device="cpu", pinned=True)
                for name, source in self._sources.items()
            }

    def copy(self) -> None:
        """Start copying all arrays; may be recorded in a graph."""
        if self._device.is_cuda:
            for name, source in self._sources.items():
                wp.copy(self._copies[name], source)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Wait for the copies and return them; they change with the next copy, and on the CPU at any time."""
        if self._device.is_cuda:
            wp.synchronize_stream(self._device)
        return {name: copy.numpy() for name, copy in self._copies.items()}
