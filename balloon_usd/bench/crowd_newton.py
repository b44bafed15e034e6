"""The crowd of tubes, by Newton's solver VBD with self-contact (Chen et al. 2024 and 2025)."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.bench.crowd_task import CrowdRun, walls_of_crowd
from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.newton_wall import NewtonWall, wall_of_springs

if TYPE_CHECKING:
    from balloon_usd.bench.crowd_task import CrowdTask
    from balloon_usd.bench.pinch_task import Floats

SUBSTEPS = 32
"""Substeps in a frame: with 16 the gas, an outer force to this solver, shakes the wall apart."""
ITERATIONS = 4
"""Sweeps over all vertices in a substep."""
CONTACT = 0.75e-3
"""Distance at which walls begin to press, m; they are looked for twice as far."""


def run_newton(task: CrowdTask) -> CrowdRun:
    """Let the tubes be turned, on the CPU."""
    with wp.ScopedDevice("cpu"):
        walls = walls_of_crowd(task)
        model = wall_of_springs(walls, CONTACT, faces=True)
        solver = import_module("newton.solvers").SolverVBD(
            model,
            iterations=ITERATIONS,
            particle_enable_self_contact=True,
            particle_self_contact_margin=CONTACT,
            particle_self_contact_gap=CONTACT,
        )
        tubes = NewtonWall(walls, model, solver, SUBSTEPS)
        shapes: list[Floats] = []
        seconds = clock_frames(tubes.advance, task.frames, lambda: shapes.append(tubes.points()))
    return CrowdRun(tuple(shapes), SUBSTEPS, *seconds)
