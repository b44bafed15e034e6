"""The crowd of tubes, by Blender's cloth: one gas for all of them, for it knows no other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.bench.blender_wall import STEPS, BlenderWall
from balloon_usd.bench.crowd_task import CrowdRun, walls_of_crowd
from balloon_usd.bench.frame_clock import clock_frames

if TYPE_CHECKING:
    from balloon_usd.bench.crowd_task import CrowdTask
    from balloon_usd.bench.pinch_task import Floats


def run_blender(task: CrowdTask) -> CrowdRun:
    """Let the tubes be turned."""
    tubes = BlenderWall(walls_of_crowd(task))
    shapes: list[Floats] = []
    seconds = clock_frames(tubes.advance, task.frames, lambda: shapes.append(tubes.points()))
    return CrowdRun(tuple(shapes), STEPS, *seconds)
