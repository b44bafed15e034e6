"""V42: hearts, as wide as they are asked to be, alike to both sides, their wall in balance with their gas."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.latex.membrane_data import membrane_data
from balloon_usd.solver.latex.round_body import round_body
from tests.verification.blown_up import blown_up

WIDTHS = (8, 12, 15)


@pytest.fixture(scope="module")
def blown():
    """Plans, meshes and last frames of one heart, blown up to several widths."""
    return blown_up("H6", WIDTHS)


def body_of(mesh, frame):
    """Points of its body, without knot and lip, (V, 3), m; a polygon is drawn about its wall."""
    points = frame.points[0][mesh.along >= 0.0].astype(float)
    return points * [1.0, np.cos(np.pi / mesh.around), np.cos(np.pi / mesh.around)]


def cleft_of(mesh, frame):
    """Depth of its cleft on the left and on the right, in its width, (2,)."""
    points = body_of(mesh, frame)
    along = mesh.along[mesh.along >= 0.0]
    bottom = points[along > 0.5 * (mesh.ring_along[-1] + along.max())].mean(axis=0)
    tops = [points[side * points[:, 1] > 0.0, 0].max() for side in (-1.0, 1.0)]
    return (np.array(tops) - bottom[0]) / np.ptp(points[:, 1])


def work_of_wall_and_gas(made, mesh, frame):
    """Work of the wall and of the gas while all grows alike, J: Clapeyron's theorem, 3 p V of the gas."""
    strip = made.strips["one"]
    body = round_body(mesh, strip.rubber, strip.size, (), (), 1.0)
    data = membrane_data(body, 1e-4, 1e5, scale_mass=False)
    corners = frame.points[0].astype(float)[mesh.quads]
    hoop = 0.5 * (corners[:, 1] - corners[:, 0] + corners[:, 2] - corners[:, 3])
    axial = 0.5 * (corners[:, 3] - corners[:, 0] + corners[:, 2] - corners[:, 1])
    gradient = np.stack([hoop, axial], axis=2) @ data.rest_inverse
    a, b = np.linalg.svd(gradient, compute_uv=False).T
    stress = strip.rubber.nominal_stress(a, b)
    chamber = (mesh.along[mesh.quads] >= -1e-6).all(axis=1)
    wall = (data.rubber_volume * (stress[0] * a + stress[1] * b))[chamber].sum()
    return float(wall), 3.0 * float(frame.pressure[0]) * float(frame.volume[0])


def test_it_is_as_wide_and_as_high_as_the_plan_says(verify, blown):
    for made, mesh, frame in blown:
        bubble, points = made.bubbles[0], body_of(mesh, frame)
        asked = 2.0 * made.strips["one"].inflated_radius
        wide, high = np.ptp(points[:, 1]), np.ptp(points[:, 0])
        verify("V42a", f"heart of {100.0 * asked:.0f} cm, width, cm", 100.0 * wide, 100.0 * asked, 0.03)
        verify("V42b", "its height, cm", 100.0 * high, 100.0 * bubble.length, 0.04)


def test_it_has_the_pressure_of_the_plan(verify, blown):
    for made, _, frame in blown:
        pressure, planned = float(frame.pressure[0]), made.bubbles[0].pressure
        verify("V42c", "its pressure, kPa", 1e-3 * pressure, 1e-3 * planned, 0.06)


def test_its_wall_bears_its_gas(verify, blown):
    for made, mesh, frame in blown:
        wall, gas = work_of_wall_and_gas(made, mesh, frame)
        verify("V42d", "work of its wall while all grows alike, J", wall, gas, 0.025)


def test_its_lobes_are_alike_and_a_full_one_has_a_deep_cleft(verify, blown):
    for _, mesh, frame in blown:
        left, right = cleft_of(mesh, frame)
        verify("V42e", "its cleft on the left, off that on the right, in its width", left - right, 0.0, 0.01)
    assert cleft_of(*blown[-1][1:]).min() > 0.18


def test_its_middle_lies_on_its_axis(blown):
    for _, mesh, frame in blown:
        middle = body_of(mesh, frame).mean(axis=0)
        assert np.abs(middle[1:]).max() < 1e-3
