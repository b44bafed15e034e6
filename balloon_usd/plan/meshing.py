"""The mesh that a plan asks for: a ring at every joint, finer beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_mesh import BalloonMesh, tube_mesh

if TYPE_CHECKING:
    from balloon_usd.balloon.detail import Detail
    from balloon_usd.plan.strip import Strip


def joint_places(strip: Strip) -> tuple[float, ...]:
    """Return the unstressed distances of a strip's joints from the knot, m, without the knot itself."""
    return tuple(bubble.rest_end for bubble in strip.bubbles[:-1])


def mesh_of(strip: Strip, detail: Detail) -> BalloonMesh:
    """Return the mesh of one balloon at a level of detail."""
    joints = joint_places(strip)
    return tube_mesh(strip.size, detail, joints, tuple(bubble.rest_end for bubble in strip.bubbles))
