"""V30: two balls that press on each other push as hard as their gas does on the disc between them.

Both are held round their equators and brought so near that each is pressed flat by the other. The theory of a rubber
membrane tells the disc and the force from the distance alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import sphere_pressure
from balloon_usd.solver.settings import SceneSettings
from tests.verification.pressed_ball import PressedBall
from tests.verification.setups import STEP, Floats, Meeting, Part, cube_sphere, plain, turned

RADIUS, THICKNESS, STRETCH = 0.02, 0.2e-3, 1.2
LATEX = plain(rubber_named())
PRESSURE = float(sphere_pressure(LATEX, STRETCH)) * THICKNESS / RADIUS
EQUATOR = STRETCH * RADIUS
THEORY = PressedBall(LATEX, RADIUS, THICKNESS, STRETCH, PRESSURE)
OFFSET = 0.5e-3
"""Distance at which the balls begin to press, m."""
GAP = 0.8 * OFFSET
"""What is left of it: both walls together press with five times the gas where it is used up."""
CELLS, COARSE, FINE = 14, 8, 18
"""Quads along an edge of the cube that a ball is made of. With 14, friction holds the balls to 0.5 sideways by
1.0 to 1.3 % of their push, however they begin.
"""
CORE = 0.25
"""Part of a disc that is flat for sure, in radii of the equators."""
TURN = 0.5
"""Angle by which one ball is turned about the axis, radians: no vertex meets another."""
HEIGHTS = (0.8, 0.65, 0.5)
"""Of the discs above the equators, in radii of these."""


@dataclass(frozen=True)
class Pressed:
    """Two balls at rest."""

    push: Floats
    """Force of contact on the upper one, (3,), N."""
    hold: tuple[Floats, Floats]
    """Forces on what holds the lower and the upper one, (3,), N."""
    disc: float
    """Radius of the flat disc of the lower one, as told by its shape, m."""
    gap: float
    """Between the discs, m."""


@cache
def pressed(height: float, cells: int = CELLS) -> Pressed:
    """Bring two balls together until each reaches only so far above its equator, in radii of that."""
    mesh = cube_sphere(RADIUS, cells)
    equator = np.flatnonzero(np.abs(mesh.points[:, 2]) < 1e-9)
    ball = Part(mesh, THICKNESS, PRESSURE, equator)
    rig = Meeting([ball, ball], LATEX, SceneSettings(dt=STEP, drag=0.0, contact_offset=OFFSET))
    apart = np.array([0.0, 0.0, height * EQUATOR + 0.5 * GAP])
    # They begin as ellipsoids that do not touch yet.
    points = mesh.points * STRETCH * np.array([1.0, 1.0, 0.98 * height])
    rig.place(np.concatenate([points - apart, turned(points, TURN) + apart]))
    rig.settle(1e-4, most=2000)
    lower, upper = (rig.points[own] for own in rig.vertices)
    lower, upper = lower[lower[:, 2] > -apart[2]], upper[upper[:, 2] < apart[2]]
    level, above = (np.median(half[np.hypot(*half.T[:2]) < CORE * EQUATOR, 2]) for half in (lower, upper))
    disc = disc_of(np.hypot(*lower.T[:2]), level - lower[:, 2])
    return Pressed(rig.push(1, 0), (rig.hold(0), rig.hold(1)), disc, float(above - level))


def disc_of(radii: Floats, depths: Floats) -> float:
    """Radius (m) of the disc that a wall lies flat on, given how far its points are from the axis and from the disc.

    Beside the disc the wall leaves it as a parabola: the radius is a series in the square root of the depth.
    """
    beside = (depths > 0.5 * OFFSET) & (depths < 0.5 * depths.max())
    return float(np.polyfit(np.sqrt(depths[beside]), radii[beside], 3)[-1])


@pytest.mark.parametrize("height", HEIGHTS)
def test_two_balls_push_as_hard_as_theory_says_of_their_distance(verify, height):
    found = pressed(height)
    disc = THEORY.disc(height * EQUATOR)
    force = PRESSURE * math.pi * disc**2
    name = f"balls pressed to {height:g}"
    verify("V30", f"{name}, force, N", found.push[2], force, 3e-2)
    verify("V30", f"{name}, disc, mm", 1e3 * found.disc, 1e3 * disc, 3e-2)
    verify("V30", f"{name}, gap, mm", 1e3 * found.gap, 1e3 * GAP, 3e-2)


@pytest.mark.parametrize("height", HEIGHTS)
def test_two_balls_push_with_their_gas_on_the_disc_between_them(verify, height):
    found = pressed(height)
    name = f"balls pressed to {height:g}"
    verify("V30", f"{name}, force by the disc, N", found.push[2], PRESSURE * math.pi * found.disc**2, 3e-2)


@pytest.mark.parametrize("height", HEIGHTS)
def test_what_holds_two_balls_bears_their_push(verify, height):
    found = pressed(height)
    for name, hold, side in zip(("lower", "upper"), found.hold, (1.0, -1.0), strict=True):
        verify(
            "V30", f"pressed to {height:g}, hold of the {name} ball, N", side * hold[2], found.push[2], 1e-3
        )


@pytest.mark.parametrize("height", HEIGHTS)
def test_what_holds_two_balls_bears_nothing_sideways(verify, height):
    found = pressed(height, FINE)
    for name, hold in zip(("lower", "upper"), found.hold, strict=True):
        sideways = float(np.hypot(*hold[:2])) / found.push[2]
        what = f"pressed to {height:g}, hold of the {name} ball sideways, in its push"
        verify("V30", what, sideways, 0.0, 5e-3)


def test_a_finer_mesh_pushes_nearer_to_theory():
    disc = THEORY.disc(HEIGHTS[0] * EQUATOR)
    coarse, fine = (
        pressed(HEIGHTS[0], cells).push[2] - PRESSURE * math.pi * disc**2 for cells in (COARSE, CELLS)
    )
    assert abs(fine) < (COARSE / CELLS) ** 2 * abs(coarse)
