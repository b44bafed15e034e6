"""The time that a solver takes for a frame."""

from __future__ import annotations

import statistics
import time
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable


class FrameTime(NamedTuple):
    """Medians over all frames, ms."""

    wall: float
    cpu: float
    """Processor time, of all cores."""


def clock_frames(
    advance: Callable[[int], None], frames: int, look: Callable[[], None] | None = None
) -> FrameTime:
    """Advance by so many frames, from 0; `look`: what is done after each, outside of the time taken."""
    wall, cpu = [], []
    for frame in range(frames):
        clocks = time.perf_counter(), time.process_time()
        advance(frame)
        wall.append(time.perf_counter() - clocks[0])
        cpu.append(time.process_time() - clocks[1])
        if look is not None:
            look()
    return FrameTime(1e3 * statistics.median(wall), 1e3 * statistics.median(cpu))
