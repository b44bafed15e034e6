"""The task of pinch and turn, by Blender's cloth (springs, implicit steps, repulsion for self-contact)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.bench.blender_wall import STEPS, BlenderWall
from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.pinch_task import PinchRun
from balloon_usd.bench.pinch_wall import walls_of_pinch

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import PinchTask


def run_blender(task: PinchTask) -> PinchRun:
    """Do the task."""
    tube = BlenderWall(walls_of_pinch(task))
    start = tube.points()
    seconds = clock_frames(tube.advance, task.frames)
    return PinchRun(start, tube.points(), STEPS, *seconds)
