"""Launching kernels by the names of their arguments."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.capture_lock import capture_lock_released
from balloon_usd.solver.kernels.device.barrier import team_barrier
from balloon_usd.solver.team import Team, yield_processor

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

    On a CPU a team of threads may do so together: what is not shared out is up to the first of them.
    """

    def __init__(self, scene: Scene, values: dict[str, Any], threads: int = 1) -> None:
        """Prepare for a scene; `threads`: of a CPU, at most."""
        self.scene = scene
        self.thread = 0
        """Thread of the team whose graph is recorded."""
        self.threads = 1
        """How many it has."""
        shared = 1 if wp.get_device(scene.device).is_cuda else threads
        self._team = Team(shared, scene.barrier_counts, scene.barrier_rounds)
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
        if self.thread == 0:
            self._launch(kernel, dim, lanes, changing)

    def _launch(self, kernel: Any, dim: int | tuple[int, ...], lanes: int, changing: dict[str, Any]) -> None:
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
        if self.thread == 0:
            self._launch_tiled(kernel, blocks, lanes, changing)

    def _launch_tiled(self, kernel: Any, blocks: int, lanes: int, changing: dict[str, Any]) -> None:
        wp.launch_tiled(
            kernel,
            dim=[blocks],
            inputs=self._inputs(kernel, changing),
            block_dim=lanes,
            device=self.scene.device,
        )

    def share_out(self, kernel: Any, count: int, *, lanes: int, tiled: bool = True, **changing: Any) -> None:
        """Launch a kernel as `launch_tiled` does, or as `launch`; each thread of a team takes a stretch of so
        many blocks, or threads, which the kernel counts from its argument `share_begin` on.

        It sees what was done before, and what it did is seen by all that comes after.
        """
        self.meet()
        first, end = (count * k // self.threads for k in (self.thread, self.thread + 1))
        if end > first:
            launch = self._launch_tiled if tiled else self._launch
            launch(kernel, end - first, lanes, changing | {"share_begin": first})
        self.meet()

    def launch_each(self, kernel: Any, blocks: int, *, lanes: int, **changing: Any) -> None:
        """Launch a kernel as `launch_tiled` does by every thread of a team, which meet within it."""
        self.meet()
        self._launch_tiled(kernel, blocks, lanes, changing)

    def meet(self) -> None:
        """Synchronise the threads of a team."""
        if self.threads > 1:
            told = {"threads": self.threads, "yield_processor": wp.uint64(yield_processor())}
            self._launch(team_barrier, 1, LAUNCH_BLOCK, told)

    def zero(self, *arrays: wp.array[Any]) -> None:
        """Let all elements of arrays be 0."""
        if self.thread == 0:
            for array in arrays:
                array.zero_()

    def fill(self, array: wp.array[Any], value: Any) -> None:
        """Let all elements of an array be equal."""
        if self.thread == 0:
            array.fill_(value)

    def copy(self, target: wp.array[Any], source: wp.array[Any]) -> None:
        """Copy an array."""
        if self.thread == 0:
            wp.copy(target, source)

    def when(self, condition: wp.array[int], record: Callable[[], None]) -> None:
        """Do what is recorded if the condition is not 0."""
        self.meet()
        wp.capture_if(condition, lambda: self._record_branch(record))
        # Nobody writes the condition until all have read it: here and within the branch.
        self.meet()

    def loop(self, condition: wp.array[int], record: Callable[[], None]) -> None:
        """Do what is recorded again and again while the condition is not 0."""
        self.meet()
        wp.capture_while(condition, lambda: self._record_branch(record))
        self.meet()

    def _record_branch(self, record: Callable[[], None]) -> None:
        self.meet()
        record()
        self.meet()

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
        graph = self._captured(key, record)
        with capture_lock_released():
            wp.capture_launch(graph)

    def replay_together(self, key: Hashable, record: Callable[[], None]) -> None:
        """Launch the graph of a key by a team of threads, where there is one; capture it the first time."""
        self.threads = self._team.threads
        try:
            graphs = [self._captured_for(thread, key, record) for thread in range(self.threads)]
        finally:
            self.thread, self.threads = 0, 1
        with capture_lock_released():
            self._team.replay(graphs)

    def _captured_for(self, thread: int, key: Hashable, record: Callable[[], None]) -> Any:
        self.thread = thread
        return self._captured((key, thread, self.threads), record)

    def _captured(self, key: Hashable, record: Callable[[], None]) -> Any:
        if key not in self._graphs:
            device = self.scene.device
            # Modules load as they are captured: others may belong to another model.
            wp.capture_begin(device=device)
            try:
                record()
            finally:
                graph = wp.capture_end(device=device)
            self._graphs[key] = graph
        return self._graphs[key]

    def _inputs(self, kernel: Any, changing: dict[str, Any]) -> list[Any]:
        values, arrays = self.values | changing, self.scene.arrays
        return [
            values[a.label] if a.label in values else arrays.argument(a.label, a.type)
            for a in kernel.adj.args
        ]
