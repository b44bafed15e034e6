"""Launching kernels by the names of their arguments."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.capture_lock import capture_lock_released

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterator

    from balloon_usd.solver.scene import Scene

LAUNCH_BLOCK = 256
"""Block size on a GPU of kernels without cooperation between threads: Warp's default."""
VOLUME_BLOCK = 64
"""Threads that sum one segment on a GPU."""


class Launcher:
    """Launches kernels on a scene: each argument is a struct of its arrays, or by its name an array, a value,
    or one that changes from launch to launch.
    """

    def __init__(self, scene: Scene, values: dict[str, Any]) -> None:
        self.scene = scene
        self.values = values
        self._graphs: dict[Hashable, Any] = {}
        self._side = wp.Stream(scene.device) if wp.get_device(scene.device).is_cuda else None

    def load(self, *kernels: Any, lanes: int = LAUNCH_BLOCK) -> None:
        """Compile and load kernels that are first launched in the middle of a run, so that no frame waits for
        them.

        `lanes`: block size with which they are launched on a GPU; each size is a separate compilation.
        """
        for kernel in kernels:
            wp.load_module(kernel.module, device=self.scene.device, block_dim=lanes)

    def lanes(self, wanted: int) -> int:
        """Return the block size of a launch that asks for so many lanes: on the CPU one."""
        return wanted if wp.get_device(self.scene.device).is_cuda else 1

    def launch(
        self, kernel: Any, dim: int | tuple[int, ...], *, lanes: int = LAUNCH_BLOCK, **changing: Any
    ) -> None:
        """Launch a kernel over `dim` threads, so many `lanes` in a block on a GPU."""
        wp.launch(
            kernel,
            dim=dim,
            inputs=self._inputs(kernel, changing),
            device=self.scene.device,
            block_dim=lanes,
        )

    def launch_tiled(self, kernel: Any, blocks: int, *, lanes: int = VOLUME_BLOCK, **changing: Any) -> None:
        """Launch a kernel over blocks of threads that work together: so many `lanes` on a GPU, one on the
        CPU.
        """
        wp.launch_tiled(
            kernel,
            dim=[blocks],
            inputs=self._inputs(kernel, changing),
            block_dim=lanes,
            device=self.scene.device,
        )

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Launch on a side stream during the block, concurrently with what follows until `join`; on the CPU
        serially.
        """
        if self._side is None:
            yield
            return
        self._side.wait_stream(wp.get_stream(self.scene.device))
        with wp.ScopedStream(self._side, sync_enter=False):
            yield

    def join(self) -> None:
        """Let the main stream wait for the side stream."""
        if self._side is not None:
            wp.get_stream(self.scene.device).wait_stream(self._side)

    def replay(self, key: Hashable, record: Callable[[], None]) -> None:
        """Launch the graph of a key; capture it the first time."""
        if key not in self._graphs:
            device = self.scene.device
            # Modules load as they are captured: others may belong to another model.
            wp.capture_begin(device=device)
            try:
                record()
            finally:
                graph = wp.capture_end(device=device)
            self._graphs[key] = graph
        with capture_lock_released():
            wp.capture_launch(self._graphs[key])

    def _inputs(self, kernel: Any, changing: dict[str, Any]) -> list[Any]:
        values, arrays = self.values | changing, self.scene.arrays
        return [
            values[a.label] if a.label in values else arrays.argument(a.label, a.type)
            for a in kernel.adj.args
        ]
