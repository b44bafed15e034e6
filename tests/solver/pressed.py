"""A bubble of latex that a hand presses, frame by frame."""

from __future__ import annotations

import numpy as np

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

RECIPE = """\
format: 1
name: dented
units: cm
balloons: {main: {size: 260, length: 20, tail: 6}}
steps:
  - bubbles: {belly: 9}
  - STEP
  - rest: tail
"""
ALONG = np.array([0.0, 0.0, -1.0])


class Pressed:
    """The bubble in every frame from before the finger comes until it has gone."""

    def __init__(self, step, bubbles="{belly: 9}", held=15):
        planned = plan(Recipe.parse(RECIPE.replace("STEP", step).replace("{belly: 9}", bubbles)))
        self.held = held
        """Number of a frame in which the finger has long been all the way in."""
        self.simulation = simulate_many([planned], device="cpu")
        scene = self.simulation.model.scene
        names = [bubble.name for bubble in planned.bubbles]
        self.mine = scene.vertex_segment.numpy() == self.simulation.model.layout.bubbles[names.index("belly")]
        self.shapes, self.pressures, self.volumes, self.forces = [], [], [], []
        self.only_mine = True
        before = None
        for (frame,) in self.simulation.frames():
            points = frame.points[0].astype(np.float64)
            if not frame.doing.startswith(("press", "squeeze")):
                if self.shapes:
                    break
                before = points, float(frame.pressure[0]), float(frame.volume[0])
                continue
            if not self.shapes:
                self._take(*before)
            self._take(points, float(frame.pressure[0]), float(frame.volume[0]))

    def _take(self, points, pressure, volume):
        scene = self.simulation.model.scene
        self.shapes.append(points[self.mine])
        self.pressures.append(pressure)
        self.volumes.append(volume)
        self.only_mine = self.only_mine and not scene.finger_push.numpy()[~self.mine].any()
        push = scene.finger_push.numpy() @ ALONG * scene.mass.numpy() / scene.settings.dt
        self.forces.append((push[push > 0.0].sum(), -push[push < 0.0].sum()))

    def turned(self, frame):
        """Angle by which the bubble has turned, in degrees."""
        first, now = (points - points.mean(axis=0) for points in (self.shapes[0], self.shapes[frame]))
        left, _, right = np.linalg.svd(first.T @ now)
        turn = right.T @ np.diag([1.0, 1.0, np.linalg.det(right.T @ left.T)]) @ left.T
        return float(np.degrees(np.arccos(min(0.5 * (np.trace(turn) - 1.0), 1.0))))
