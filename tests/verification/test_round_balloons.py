"""V41: round balloons, whose walls bear their gas and which are as wide as they are asked to be."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.round_body import round_body
from tests.verification.blown_up import blown_up
from tests.verification.made_whole import made_whole

WIDTHS = (6, 9, 13)
LET_DOWN = ("7, overblown: 13", "9, overblown: 11", "13, overblown: 16")
TIED = """
format: 1
name: man
units: cm
tempo: brisk
balloons:
  body: {size: 260, length: 13, tail: 7}
  skull: {size: R5, inflated: 9}
steps:
  - bubbles: {neck: 4, left_arm: 9, right_arm: 9}
    balloon: body
  - lock: [left_arm, right_arm]
  - {rest: head, balloon: skull}
  - tie: {end: head.start, to: neck.start}
"""


@pytest.fixture(scope="module")
def blown():
    """Plans, meshes and last frames of one balloon, blown up to several widths."""
    return blown_up("R5", WIDTHS)


def rings(mesh, points):
    """Corners of every ring, (R, n, 3), m."""
    return points[mesh.ring_start[:, None] + np.arange(mesh.around)].astype(float)


def apothem(mesh, points):
    """Radius of the circle in every ring, (R,), m."""
    corners = rings(mesh, points)
    girth = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum(axis=1)
    return girth / (2.0 * mesh.around * np.tan(np.pi / mesh.around))


def test_it_is_as_wide_and_as_high_as_the_plan_says(verify, blown):
    for made, mesh, frame in blown:
        bubble, points = made.bubbles[0], frame.points[0]
        width = 2.0 * apothem(mesh, points)[mesh.ring_along > 0.0].max()
        asked = 2.0 * made.strips["one"].inflated_radius
        verify(
            "V41a", f"round balloon of {100.0 * asked:.0f} cm, width, cm", 100.0 * width, 100.0 * asked, 0.03
        )
        high = np.ptp(points[mesh.along >= 0.0, 0])
        verify("V41b", "its height, cm", 100.0 * high, 100.0 * bubble.length, 0.04)


def test_it_has_the_pressure_of_the_plan(verify, blown):
    for made, _, frame in blown:
        pressure, planned = float(frame.pressure[0]), made.bubbles[0].pressure
        verify("V41c", "its pressure, kPa", 1e-3 * pressure, 1e-3 * planned, 0.06)


def test_one_that_was_blown_up_farther_and_let_down_is_as_wide_and_as_soft_as_the_plan_says(verify):
    for made, mesh, frame in blown_up("R5", LET_DOWN):
        width = 2.0 * apothem(mesh, frame.points[0])[mesh.ring_along > 0.0].max()
        asked = 2.0 * made.strips["one"].inflated_radius
        verify("V41e", "one that is let down, width, cm", 100.0 * width, 100.0 * asked, 0.03)
        pressure, planned = float(frame.pressure[0]), made.bubbles[0].pressure
        verify("V41f", "its pressure, kPa", 1e-3 * pressure, 1e-3 * planned, 0.06)


def pull_and_push(made, mesh, frame, row):
    """Pull of the wall along its meridian through a row of faces, and push of the gas on that cut, N."""
    strip = made.strips["one"]
    unstressed = round_body(mesh, strip.rubber, strip.size, (), (), 1.0).rest
    sides = [np.stack([rings(mesh, x)[row], rings(mesh, x)[row + 1]]) for x in (frame.points[0], unstressed)]
    hoop = [np.linalg.norm(np.roll(x, -1, axis=1) - x, axis=2).mean(axis=0) for x in sides]
    meridian = [x[1] - x[0] + np.roll(x[1] - x[0], -1, axis=0) for x in sides]
    along = [0.5 * np.linalg.norm(x, axis=1) for x in meridian]
    _, stress = strip.rubber.nominal_stress(hoop[0] / hoop[1], along[0] / along[1])
    slope = 0.5 * meridian[0][:, 0] / along[0]
    pull = float((stress * hoop[1] * slope).sum()) * strip.size.thickness
    radius = apothem(mesh, frame.points[0])[row : row + 2].mean()
    return pull, float(frame.pressure[0]) * np.pi * radius**2


def test_its_wall_pulls_at_its_widest_ring_as_its_gas_pushes(verify, blown):
    for made, mesh, frame in blown:
        radius = np.where(mesh.ring_along > 0.0, apothem(mesh, frame.points[0]), 0.0)
        widest = int(np.argmax(radius))
        pull, push = np.mean([pull_and_push(made, mesh, frame, row) for row in (widest - 1, widest)], axis=0)
        verify("V41d", "pull of the wall at its widest ring, N", pull, push, 0.03)


def test_it_is_tied_to_a_figure_and_no_wall_goes_through_another():
    made = plan(Recipe.parse(TIED))
    meshes, frame, frames, most = made_whole(made)
    assert frames == made.frame_count
    assert most == 0
    ends = [next(r for r in made.table.rings if r.name == name) for name in ("body.knot", "skull.knot")]
    places = [
        rings(mesh, frame.points[k])[mesh.ring_at(end.along)].mean(axis=0)
        for k, (mesh, end) in enumerate(zip(meshes, ends, strict=True))
    ]
    apart = np.linalg.norm(places[0] - places[1])
    assert apart < 3.0 * made.strips["skull"].size.neck
