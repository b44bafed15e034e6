"""V07b: the front between the bulged tube and the flat tail."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

SIZE, STATE = size_named("260"), maxwell_state(rubber_named())
TUBE = """
format: 1
name: tube
units: cm
balloons:
  main: {size: 260, length: 20, tail: 9, color: red}
steps:
  - bubbles: {first: 7}
  - rest: tail
physics: {softening: false}
"""
AROUND_FRONT = (0.05, 0.17)
"""Part of the flat tube in which the front stands, clear of the knot and the tip, m."""


@pytest.fixture(scope="module")
def profile():
    """Place along the tube and radius of every ring near the front of a tube blown up to a tail, m."""
    simulation = simulate_many([plan(Recipe.parse(TUBE))], detail="preview", device="cpu")
    frame = None
    for frames in simulation.frames():
        if frames[0].doing.startswith("pinch"):
            break
        frame = frames[0]
    mesh = simulation.meshes[0][0]
    rings = frame.points[0][mesh.ring_start[:, None] + np.arange(mesh.around)].astype(float)
    girth = np.linalg.norm(rings - np.roll(rings, 1, axis=1), axis=2).sum(axis=1)
    steps = np.linalg.norm(np.diff(rings.mean(axis=1), axis=0), axis=1)
    near = (mesh.ring_along > AROUND_FRONT[0]) & (mesh.ring_along < AROUND_FRONT[1])
    place = np.concatenate([[0.0], np.cumsum(steps)])
    return place[near], (girth / (2.0 * mesh.around * np.tan(np.pi / mesh.around)))[near]


def test_the_front_is_as_wide_as_theory_says(verify, profile):
    place, radius = profile
    share = (radius / SIZE.radius - STATE.thin.a) / (STATE.bulged.a - STATE.thin.a)
    bulged, thin = (np.interp(-part, -share, place) for part in (0.9, 0.1))
    verify("V07b", "front, width from 90 % to 10 % of its height, mm", (thin - bulged) * 1e3, 34.96, 5e-2)


def test_the_front_is_as_steep_as_theory_says(verify, profile):
    place, radius = profile
    slope, middle = -np.diff(radius) / np.diff(place), 0.5 * (place[1:] + place[:-1])
    top = int(slope.argmax())
    # The steepest place lies between rings: the top of a parabola through the three steepest cells.
    curve = np.polynomial.Polynomial.fit(middle[top - 1 : top + 2], slope[top - 1 : top + 2], 2)
    verify("V07b", "front, steepest slope of the radius", curve(curve.deriv().roots()[0]), 1.108, 5e-2)
