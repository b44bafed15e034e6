"""Host copies of device arrays that are fetched together, once a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene

SIDES = 3
"""Copies on the host: one is looked at beside the one before it, while another is filled."""


class Mirror:
    """Some arrays of a scene as the host last saw them."""

    def __init__(self, scene: Scene, names: Sequence[str]) -> None:
        """Choose the arrays by the names that kernels give them."""
        self._device = wp.get_device(scene.device)
        self._sources = {name: scene.arrays[name] for name in names}
        self._sides = [self._empty() for _ in range(SIDES)]
        self._views = [{name: copy.numpy() for name, copy in side.items()} for side in self._sides]
        self.side = 0
        """The copy that was filled last, or is being filled."""
        self._copied = wp.Event(self._device) if self._device.is_cuda else None

    def _empty(self) -> dict[str, Any]:
        pinned = self._device.is_cuda
        return {
            name: wp.empty(source.shape, dtype=source.dtype, device="cpu", pinned=pinned)
            for name, source in self._sources.items()
        }

    def turn(self) -> None:
        """Keep what was fetched in the last two turns: another side is filled now."""
        self.side = (self.side + 1) % SIDES

    def copy(self) -> None:
        """Start copying all arrays; may be recorded in a graph for each side."""
        for name, source in self._sources.items():
            wp.copy(self._sides[self.side][name], source)

    def begun(self) -> None:
        """Take note that copying has begun: it ends when all that the device was told before is done."""
        if self._copied is not None:
            wp.get_stream(self._device).record_event(self._copied)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Wait for the copies and return them; after three turns they change."""
        self.wait()
        return self._views[self.side]

    def wait(self) -> None:
        """Wait until nothing is being copied any more, whatever the device was told since."""
        if self._copied is not None:
            wp.synchronize_event(self._copied)
