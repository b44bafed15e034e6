"""A figure that is made from the first frame to the last, and the walls that go through each other meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.solver.simulation import simulate_many

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

EACH = 8
"""Frames from one count to the next."""


class MadeWhole(NamedTuple):
    """What has come of a plan."""

    meshes: tuple[BalloonMesh, ...]
    last: Frame
    frames: int
    """How many there were."""
    crossings: int
    """Most edges that went through a wall in a frame: in each eighth, and in the last."""


def made_whole(plan: Plan) -> MadeWhole:
    """Return what comes of a plan at `draft`."""
    simulation = simulate_many([plan], device="cpu")
    (meshes,) = simulation.meshes
    counter, most, frames = CrossingCounter(walls_of(plan, meshes), 100), 0, 0
    for (frame,) in simulation.frames():
        frames += 1
        if frame.time_code % EACH == 0 or frame.time_code == plan.frame_count:
            most = max(most, counter.count(frame.points).count)
    return MadeWhole(meshes, frame, frames, most)
