"""The task of pinch and turn, by Newton's solver XPBD (position-based springs, spheres for self-contact)."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.newton_wall import NewtonWall, wall_of_springs
from balloon_usd.bench.pinch_task import PinchRun
from balloon_usd.bench.pinch_wall import walls_of_pinch

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import PinchTask

SUBSTEPS = 256
"""Substeps in a frame: with fewer the gas, an outer force to this solver, shakes the wall apart."""
ITERATIONS = 1
"""Relaxations in a substep: small steps need no more (Macklin et al. 2019)."""
CONTACT = 0.75e-3
"""Radius of the spheres that stand for the wall in self-contact, m."""


def run_newton(task: PinchTask) -> PinchRun:
    """Do the task on the CPU."""
    with wp.ScopedDevice("cpu"):
        walls = walls_of_pinch(task)
        model = wall_of_springs(walls, CONTACT)
        solver = import_module("newton.solvers").SolverXPBD(model, iterations=ITERATIONS)
        tube = NewtonWall(walls, model, solver, SUBSTEPS)
        seconds = clock_frames(tube.advance, task.frames)
    return PinchRun(walls.points, tube.points(), SUBSTEPS, *seconds)
