"""V14: the ends of an open tube are turned, and its meridians, taut as strings, draw in a waist."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.rubber import Rubber
from tests.verification.setups import Rig, tube

RADIUS, THICKNESS, AROUND, RINGS = 0.01, 0.1e-3, 16, 21
GATHERED = 0.08
"""Radius at which both ends are held, in radii of the tube. Rubber pulls where it is stretched most: only in a wall that
hangs in pleats, with no hoop stretch to shear, is that along the meridians.
"""
TAUT = 1.1
"""Stretch of the meridians before the turn."""
STRING = Rubber("string", mu=(1.0e6,), alpha=(2.0,), softening=None)


def waist(turn):
    """Turn the ends of a gathered tube (rad) and settle it; return the radius of its middle, in that of its ends."""
    mesh = tube(RADIUS, AROUND, np.linspace(0.0, 6.0 * RADIUS, RINGS))
    rig = Rig(mesh, STRING, THICKNESS, gauge=(0.0, 0.0, 0.0), vented=(0, 1, 2))
    angle = turn * mesh.points[:, 0] / mesh.points[:, 0].max()
    y, z = GATHERED * mesh.points[:, 1:].T
    x = TAUT * mesh.points[:, 0]
    # It begins as wide as its ends everywhere: the waist is the solver's own.
    rig.place(
        np.column_stack([x, y * np.cos(angle) - z * np.sin(angle), y * np.sin(angle) + z * np.cos(angle)])
    )
    rig.hands.radius[:] = rig.hands.radius_goal[:] = GATHERED * RADIUS / math.cos(math.pi / AROUND)
    for ring in (0, 1):
        rig.hands.clasp(ring, rig.array("ring_middle").astype(np.float32))
    rig.settle(1e-4 * GATHERED, most=2000)
    rings = rig.points[: RINGS * AROUND].reshape(RINGS, AROUND, 3)
    radii = np.linalg.norm(rings[:, :, 1:], axis=2).mean(axis=1)
    return radii[RINGS // 2] / radii[0]


@pytest.mark.parametrize(
    ("degrees", "theory"), [(60, 0.866), (90, 0.7071), (120, 0.5), (150, 0.2588), (180, 0.0)]
)
def test_turned_meridians_draw_in_a_waist_of_the_cosine_of_half_the_turn(verify, degrees, theory):
    cosine = math.cos(math.radians(degrees / 2))
    assert cosine == pytest.approx(theory, abs=1e-4)
    verify(
        "V14", f"waist of a cage turned by {degrees} degrees, R", waist(math.radians(degrees)), theory, 1e-2
    )
