"""Finished figures under their weight: a balloon falls in air, and a dog stands on its feet."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE, OUTSIDE_DENSITY
from balloon_usd.balloon.rubber import LATEX_DENSITY
from balloon_usd.operations.moves import Fall
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.falling import DRAG, FallingFigure
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.simulation import simulate_many

DOG = Path(__file__).parents[2] / "recipes/dog.yaml"
GRAVITY = 9.81
BARE = """
format: 1
name: bare
units: cm
balloons: {b: {size: 260, tail: 4}}
steps: [wait: 1]
physics: {gravity: 9.81, hold: 2}
"""


def test_a_balloon_falls_as_its_weight_its_air_and_its_width_say(verify):
    made = plan(Recipe.parse(BARE))
    simulation = simulate_many([made], device="cpu")
    frames = [frame.copy() for (frame,) in simulation.frames()]
    lying, fps = frames[-50].points[0].astype(float), made.recipe.fps
    volume, pressure = float(frames[-50].volume.sum()), float(frames[-50].pressure[0])
    rubber = LATEX_DENSITY * float(simulation.model.scene.rubber_volume.numpy().sum())
    air = OUTSIDE_DENSITY * volume
    gas = air * (ATMOSPHERE + pressure) / ATMOSPHERE
    begin = GRAVITY * (rubber + gas - air) / (rubber + gas + 0.5 * air)
    end = math.sqrt(2.0 * GRAVITY * (rubber + gas - air) / (OUTSIDE_DENSITY * DRAG * shadow(lying)))
    (let_go,) = [move.start for move in made.choreography.moves if isinstance(move, Fall)]
    times = np.arange(len(frames)) / fps - let_go
    # A body with drag by the square of its speed falls by end2 / begin times ln cosh(begin t / end).
    law = end**2 / begin * np.log(np.cosh(begin * np.maximum(times, 0.0) / end))
    ways = np.array([lying[:, 2].mean() - frame.points[0][:, 2].mean() for frame in frames])
    for seconds in (0.1, 0.5, 2.0):
        frame = int(np.argmin(np.abs(times - seconds)))
        verify("V36", f"way of a 260 that fell for {seconds:g} s, m", ways[frame], law[frame], 0.05)


def shadow(points):
    """Area of a straight tube seen from above, m2."""
    slices = np.linspace(points[:, 0].min(), points[:, 0].max(), 200)
    at = np.digitize(points[:, 0], slices)
    widths = [np.ptp(points[at == k, 1]) for k in range(1, 200) if (at == k).sum() > 3]
    middles = [slices[k - 1 : k + 1].mean() for k in range(1, 200) if (at == k).sum() > 3]
    return float(np.trapezoid(widths, middles))


@pytest.mark.long
def test_a_dog_stands_for_five_seconds_on_the_ground_that_carries_its_weight(verify):
    text = DOG.read_text(encoding="utf-8") + "pose: stand\n"
    simulation = simulate_many([plan(Recipe.parse(text))], device="cpu")
    *_, (last,) = simulation.frames()
    sculpture = simulation.model.performers[0].sculpture
    points = np.concatenate(last.points).astype(float)
    figure = rigid_figure(sculpture, points)
    standing = FallingFigure(figure, GRAVITY, 0.8, ground=True)
    for _ in range(50):
        standing.sleeps = False
        standing.advance(0.1)
    after = figure.points @ standing.turn.T + standing.centre
    moved = np.linalg.norm(after - points, axis=1).max()
    verify("V37", "push of the ground on a dog, N", standing.push, standing.weight, 0.01)
    verify("V37", "way of its vertices in 5 s, m", moved, 0.0, 5e-4)
    legs = [k for k, bubble in enumerate(simulation.plans[0].bubbles) if bubble.name.endswith("leg")]
    mesh = simulation.meshes[0][0]
    feet = [after[mesh.quads[mesh.quad_bubble == k].ravel(), 2].min() for k in legs]
    # Three carry a rigid figure; the fourth is as near to the ground as hands have levelled them.
    assert len(feet) == 4
    assert sorted(feet)[2] < 0.0
    verify("V37", "height of its fourth foot, m", max(feet), 0.0, 2e-4)
