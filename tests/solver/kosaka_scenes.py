"""A small balloon of the `kosaka` model with three bubbles, and air put into it at random."""

from __future__ import annotations

from functools import cache

import numpy as np

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.balloon.tube_mesh import BalloonMesh
from balloon_usd.plan import Plan, plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kosaka.model import KosakaModel
from balloon_usd.solver.kosaka.parameters import SUBSTEPS
from balloon_usd.solver.kosaka.scene import KosakaScene
from balloon_usd.solver.simulation import NOMINAL_RATE

AROUND, FINE = 16, 32
"""Vertices round a coarse mesh, and round one as fine as that of the thesis's experiment."""
DENTS = 5e-4
"""How far vertices are moved at random, m."""
RECIPE = """
format: 1
name: small
units: cm
balloons:
  main: {size: 260, capsule: 16}
steps:
  - bubbles: {first: 4, second: 3}
  - rest: third
physics: {model: kosaka}
"""


@cache
def small_plan(around: int = AROUND) -> tuple[Plan, BalloonMesh]:
    """The plan of a capsule of 16 cm, and a mesh of it."""
    figure = plan(Recipe.parse(RECIPE))
    (strip,) = figure.strips.values()
    ends = tuple(bubble.rest_end for bubble in strip.bubbles)
    return figure, capsule_mesh(ends[-1], strip.inflated_radius, around, ends)


def small_model(device: str, copies: int = 1, around: int = AROUND) -> KosakaModel:
    """A model of one or several small balloons, each a sculpture of its own."""
    figure, mesh = small_plan(around)
    return KosakaModel([figure] * copies, [[mesh]] * copies, NOMINAL_RATE, SUBSTEPS, device)


def one_frame(model: KosakaModel) -> None:
    """Let the physics run for a frame in which no hand does anything."""
    model.stepper.advance(contact=False, fingers=False, searches=1)


def filled(device: str, seed: int, copies: int = 1) -> KosakaModel:
    """A model whose balloons are filled with air anywhere in them."""
    model = small_model(device, copies)
    air = model.scene.air.numpy()
    air[:] = np.concatenate(
        [within(np.random.default_rng(seed + k), len(air) // copies) for k in range(copies)]
    )
    model.scene.air.assign(air)
    return model


def borders(model: KosakaModel, body: int = 0) -> tuple[int, ...]:
    """Rings between the bubbles of one balloon, in order."""
    ends = model.scene.end_joint.numpy()[model.scene.bubbles_of(body)]
    return tuple(int(joint) for joint in ends if joint >= 0)


def place_of(model: KosakaModel, joint: int) -> float:
    """Where a ring is along the straight balloon, m."""
    return float(model.scene.x.numpy()[model.scene.joint_first.numpy()[joint], 0])


def freeze(model: KosakaModel, *joints: int) -> None:
    """Freeze rings and part the clusters, as after a frame in which they were drawn together."""
    for joint in joints:
        model.hands.close(joint, float(model.hands.neck[joint]))
    model.hands.upload()
    frozen = model.scene.frozen.numpy()
    frozen[list(joints)] = 1
    model.scene.frozen.assign(frozen)
    model.clusters.part(model.hands.radius_goal > 0.0)


def scatter(scene: KosakaScene, seed: int, beyond: float = 0.0) -> None:
    """Dent the first balloon and put its air anywhere within it, or as far `beyond` its wall (m)."""
    random = np.random.default_rng(seed)
    x, air = scene.x.numpy(), scene.air.numpy()
    vertices, particles = int(scene.vertex_start[1]), int(scene.air_start[1])
    x[:vertices] += random.normal(0.0, DENTS, (vertices, 3))
    air[:particles] = within(random, particles, beyond)
    scene.x.assign(x)
    scene.air.assign(air)


def within(random: np.random.Generator, count: int, beyond: float = 0.0) -> np.ndarray:
    """Points (count, 3) evenly spread in the small balloon, or as far `beyond` its wall (m)."""
    mesh = small_plan()[1]
    radius = float(np.abs(mesh.points[:, 1]).max())
    low, high = mesh.points.min(axis=0) - beyond, mesh.points.max(axis=0) + beyond
    points = random.uniform(low, high, (8 * count, 3))
    axis = np.zeros_like(points)
    axis[:, 0] = np.clip(points[:, 0], radius, mesh.points[:, 0].max() - radius)
    kept = points[np.linalg.norm(points - axis, axis=1) < radius + beyond]
    return kept[:count]
