"""V10: a mylar balloon, and a tube of the same cloth that is pinched at both ends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.rubber import Rubber
from tests.verification.setups import Rig, polygon_factor, revolved, tube

THICKNESS = 0.05e-3
STIFFENING, INERTIA = 500.0, 300.0
"""Exponent of the cloth's law: a strain of 1 % multiplies its tension by e^5; and what its masses need for that."""
CLOTH = Rubber("cloth", mu=(1.0e6 / STIFFENING,), alpha=(STIFFENING,), softening=None)
STRAIN = 7.0e-3
"""Strain under the full pressure."""
ARC, FLAT, GAS = 1.31103, 1.19814, 2.74581
"""Meridian from pole to equator, thickness and gas of a mylar balloon, in its radius and its cube."""
NECK = 0.1
"""Radius of a pinched end, in radii of the tube; the cloth in it runs straight inwards."""


def blow_up(rig, chamber, radius, tolerance):
    """Raise the pressure step by step to that which strains the cloth of a tube of this radius (m), and settle."""
    full = CLOTH.mu[0] * math.exp(STIFFENING * STRAIN) * THICKNESS / radius
    for share in (1.0 / 27.0, 1.0 / 9.0, 1.0 / 3.0, 1.0):
        rig.press(chamber, share * full)
        # At once it would be struck, far beyond what its masses stand.
        rig.settle(tolerance if share == 1.0 else 1.0e-3, most=4000)


def rings_of(rig):
    """Place along x and corner radius of every ring, (R,) each, m."""
    around = rig.mesh.mesh_rings[0][1]
    rings = rig.points[: len(rig.mesh.mesh_rings) * around].reshape(-1, around, 3)
    middles = rings.mean(axis=1)
    return middles[:, 0], np.linalg.norm(rings - middles[:, None], axis=2).mean(axis=1)


def polygon(around):
    """Area of a polygon inscribed in a circle, in areas of the circle."""
    return polygon_factor(around) * math.cos(math.pi / around) ** 2


@pytest.fixture(scope="module")
def mylar():
    """Two flat discs sewn together at their rims and blown up."""
    around, cells, size, hole = 40, 20, 0.05, 0.05
    even = np.linspace(0.0, 1.0, cells + 1)
    # Finer at the rim, where it is bent; the caps cover the poles.
    place = size * (hole + (1.0 - hole) * 0.5 * (even + np.sin(0.5 * math.pi * even)))
    mesh = revolved(np.concatenate([place, place[-2::-1]]), around, np.zeros(2 * cells + 1))
    rig = Rig(mesh, CLOTH, THICKNESS, gauge=(0.0,), vented=(0,), inertia=INERTIA)
    # It begins as a slack spheroid: meridians on an ellipse, evenly along it.
    turn = np.linspace(0.0, 0.5 * math.pi, 2001)
    ellipse = np.stack([0.6 * np.cos(turn), np.sin(turn)], axis=1)
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ellipse, axis=0), axis=1))])
    corner = mesh.points[around * cells, 1]
    out = np.linalg.norm(mesh.points, axis=1) / corner
    at = np.interp(out * run[-1], run, turn)
    scale = 0.99 * corner / run[-1]
    side = np.sign(np.arange(len(mesh.points)) // around - cells)
    poles = len(mesh.points) - around * (2 * cells + 1)
    side[-poles:] = np.repeat([-1, 1], poles // 2)
    points = mesh.points * (scale * np.sin(at) / np.maximum(out * corner, 1e-9))[:, None]
    points[:, 0] = side * scale * 0.6 * np.cos(at)
    rig.place(points)
    blow_up(rig, 0, 0.5 * size, 2.0e-6)
    return rig


def test_two_discs_sewn_together_become_a_mylar_balloon(verify, mylar):
    x, radii = rings_of(mylar)
    around, radius = mylar.mesh.mesh_rings[0][1], radii.max()
    flat = np.linalg.norm(mylar.mesh.points, axis=1).max()
    arc = 0.5 * np.hypot(np.diff(x), np.diff(radii)).sum() + radii[0]
    assert arc == pytest.approx(flat, rel=1e-2), "the cloth is not inextensible"
    corners = mylar.points[mylar.mesh.quads]
    cross = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    surface = 0.5 * np.linalg.norm(cross, axis=1).sum()
    gas = mylar.array("volume")[0] / polygon(around)
    verify("V10", "mylar balloon, disc, r", flat / radius, ARC, 1e-2)
    verify("V10", "mylar balloon, meridian from pole to rim, r", arc / radius, ARC, 1e-2)
    verify("V10", "mylar balloon, thickness, r", np.ptp(mylar.points[:, 0]) / radius, FLAT, 1e-2)
    verify("V10", "mylar balloon, gas, r^3", gas / radius**3, GAS, 1e-2)
    verify("V10", "mylar balloon, surface, r^2", surface / radius**2, math.pi**2, 1e-2)


def pinched(length):
    """Length and gas of an inextensible tube of radius 1 that is pinched at both ends: half a mylar balloon at each."""
    straight = length - 2.0 * ARC
    return straight + FLAT, math.pi * straight + GAS


@pytest.fixture(scope="module")
def pinched_tube():
    """A tube of cloth, six radii long, pinched at both ends and blown up."""
    around, cells, radius, long = 28, 28, 0.01, 6.0
    even = np.linspace(0.0, 1.0, cells + 1)
    # Finer at the ends; what lies within the necks is not in the mesh.
    run = (long - 2.0 * NECK * math.cos(math.pi / around)) * (
        0.5 * even + 0.25 * (1.0 - np.cos(math.pi * even))
    )
    mesh = tube(radius, around, radius * run)
    gauge, vented = (0.0, 0.0, 0.0), (0, 1, 2)
    rig = Rig(mesh, CLOTH, THICKNESS, gauge=gauge, vented=vented, neck=NECK * radius, inertia=INERTIA)
    # It begins slack, its ends drawn in to cones with sides of 1.3 radii.
    cone = 1.3 * radius
    inwards = np.minimum(mesh.points[:, 0], radius * run[-1] - mesh.points[:, 0]) / cone
    wide = 0.98 * np.minimum(1.0, NECK + (1.0 - NECK) * inwards)
    rise = math.sqrt(1.0 - ((1.0 - NECK) * radius / cone) ** 2)
    gap = rise * np.minimum(inwards, 1.0) + np.maximum(inwards - 1.0, 0.0)
    side = np.sign(mesh.points[:, 0] - 0.5 * radius * run[-1])
    points = mesh.points * wide[:, None]
    points[:, 0] = 0.98 * cone * side * (gap.max() - gap)
    rig.place(points)
    rig.hands.radius[:] = rig.hands.radius_goal[:] = NECK * radius
    blow_up(rig, 1, radius, 1.0e-5)
    return rig


def test_a_tube_of_cloth_that_is_pinched_has_the_length_and_the_gas_of_theory(verify, pinched_tube):
    assert pinched(6.0) == pytest.approx((4.5761, 13.3579), rel=1e-4)
    around, rest = pinched_tube.mesh.mesh_rings[0][1], pinched_tube.mesh
    x, radii = rings_of(pinched_tube)
    # Cloth gives a little: the tube is measured in its own radius.
    radius = radii.max() * math.cos(math.pi / around)
    meridian = np.hypot(np.diff(x), np.diff(radii)).sum() + radii[0] + radii[-1]
    assert radius == pytest.approx(rest.radius, rel=1e-2), "the cloth is not inextensible"
    assert meridian == pytest.approx(6.0 * rest.radius, rel=1e-2), "the cloth is not inextensible"
    length, gas = pinched(meridian / radius)
    verify("V10", "pinched tube, length, r", abs(x[-1] - x[0]) / radius, length, 1e-2)
    found = pinched_tube.array("volume")[1] / polygon_factor(around)
    verify("V10", "pinched tube, gas, r^3", found / radius**3, gas, 1e-2)
    verify(
        "V10", "pinched tube of 6 unstretched radii, length, r", abs(x[-1] - x[0]) / rest.radius, 4.5761, 1e-2
    )
