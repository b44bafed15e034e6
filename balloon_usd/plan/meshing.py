"""The mesh that a plan asks for: a tube with a ring at every joint, an even capsule, or what a file holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.balloon.shape_mesh import shape_mesh
from balloon_usd.balloon.tube_mesh import BalloonMesh, tube_mesh
from balloon_usd.plan.rings import guide_places

if TYPE_CHECKING:
    from balloon_usd.balloon.detail import Detail
    from balloon_usd.plan.model import Plan
    from balloon_usd.plan.strip import Strip


def joint_places(strip: Strip) -> tuple[float, ...]:
    """Return the unstressed distances of a strip's joints from the knot, m, without the knot itself."""
    return tuple(bubble.rest_end for bubble in strip.bubbles[:-1])


def meshes_of(plan: Plan, detail: Detail) -> tuple[BalloonMesh, ...]:
    """Return the meshes of the balloons of a plan at a level of detail, as frames show them."""
    return shown_meshes(plan, made_meshes(plan, detail))


def shown_meshes(plan: Plan, made: tuple[BalloonMesh, ...]) -> tuple[BalloonMesh, ...]:
    """Return meshes as frames show them; `made`: as hands have them."""
    return tuple(mesh.mirrored() for mesh in made) if plan.mirrored else made


def made_meshes(plan: Plan, detail: Detail) -> tuple[BalloonMesh, ...]:
    """Return the meshes of the balloons of a plan at a level of detail, as hands have them."""
    return tuple(mesh_of(strip, detail) for strip in plan.strips.values())


def mesh_of(strip: Strip, detail: Detail) -> BalloonMesh:
    """Return the mesh of one balloon at a level of detail, as hands have it."""
    if strip.shape is not None:
        return shape_mesh(strip.shape.surface, detail)
    ends = tuple(bubble.rest_end for bubble in strip.bubbles)
    if strip.capsule:
        return capsule_mesh(ends[-1], strip.inflated_radius, detail.capsule_around, ends)
    torn = tuple(0.5 * (bubble.rest_start + bubble.rest_end) for bubble in strip.bubbles if bubble.tears)
    return tube_mesh(strip.size, detail, joint_places(strip), ends, guide_places(strip), torn)
