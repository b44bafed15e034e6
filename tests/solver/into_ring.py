"""A recipe in which a bubble is brought to where others hold it: run, and watched from then on."""

from __future__ import annotations

import numpy as np

from balloon_usd.operations.moves import PassThrough, Tuck
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.passed import PassedBubbles
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

EVERY = 6
"""Frames from one count of crossings to the next."""


class IntoRing:
    """Where the middles of the rings of its first balloon are, the gas, and the crossings."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        self.move, *_ = (m for m in self.plan.choreography.moves if isinstance(m, (PassThrough, Tuck)))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        self.mesh = meshes[0]
        passed = PassedBubbles(self.plan, meshes)
        counter = CrossingCounter(walls_of(self.plan, meshes), 100)
        self.crossings, self.gas, self.middles, self.times = [], [], [], []
        for (frame,) in simulation.frames():
            passed.add(frame)
            time = (frame.time_code - 1) / self.plan.recipe.fps
            if time >= self.move.start:
                points = frame.points[0].astype(float)
                self.rings = points[self.mesh.ring_start[:, None] + np.arange(self.mesh.around)]
                self.middles.append(self.rings.mean(axis=1))
                self.times.append(time)
                self.gas.append(simulation.model.scene.amount.numpy().copy())
                if frame.time_code % EVERY == 0:
                    self.crossings.append(counter.count(frame.points).count)
        self.stuck, self.slipped, self.result = passed.stuck(), passed.slipped(), passed.result()

    def place(self, ring, at=-1):
        """Where the middle of a ring of the plan is in a frame, (3,), m."""
        return self.middles[at][self.mesh.ring_at(self.plan.table.rings[ring].along)]

    def middle(self, name, at=-1):
        """Where the ring of the middle of a bubble is in a frame, (3,), m."""
        guides = self.plan.table.guides(name)
        return self.place(guides[len(guides) // 2], at)
