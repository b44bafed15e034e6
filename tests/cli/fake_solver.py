"""A simulation without physics: the flat balloons, drifting upwards."""

from __future__ import annotations

import time

import numpy as np

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame

FRAMES = 6


class FakeSimulation:
    """What `simulate_many` returns; `trouble` by recipe name happens at frame 3."""

    def __init__(self, plans, detail, trouble):
        self.plans = tuple(plans)
        self.meshes = [
            tuple(mesh_of(strip, detail_named(detail)) for strip in plan.strips.values()) for plan in plans
        ]
        self.frame_counts = tuple(FRAMES for _ in plans)
        self.trouble = trouble
        self.substeps = 100
        self.given = 0

    def frames(self):
        for code in range(1, FRAMES + 1):
            self.given = code
            yield [self._frame(world, code) for world in range(len(self.plans))]

    def _frame(self, world, code):
        plan, meshes = self.plans[world], self.meshes[world]
        trouble = self.trouble.get(plan.recipe.name)
        if code == 3 and isinstance(trouble, BaseException):
            if isinstance(trouble, SimulationFailed):
                return trouble
            raise trouble
        if code > 3 and isinstance(trouble, SimulationFailed):
            return None
        if code == 3 and trouble == "sleep":
            print("asleep", flush=True)
            time.sleep(60)
        lift = np.float32([0, 0, 0.01 * code])
        bubbles = np.full(len(plan.bubbles), 1e-4, dtype=np.float32)
        return Frame(
            code,
            tuple(mesh.points + lift for mesh in meshes),
            tuple(np.ones(len(mesh.points), dtype=np.float32) for mesh in meshes),
            bubbles * 1e7,
            bubbles,
            "pinch: nose",
            undone=("nose.end", "middle.end") if trouble == "undone" else (),
        )


class FakeSolver:
    """Stands in for `simulate_many` and remembers its calls."""

    def __init__(self, trouble=None):
        self.trouble = trouble or {}
        self.calls = []

    def __call__(self, plans, detail="draft", device="cpu"):
        simulation = FakeSimulation(plans, detail, self.trouble)
        self.calls.append(simulation)
        return simulation
