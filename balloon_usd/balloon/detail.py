"""Levels of detail: how finely a balloon is meshed and how finely time is cut."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Detail:
    """A level of detail of the mesh and the time step that it needs.

    Mesh lengths are in unstressed radii R0, so that every size is meshed alike.
    """

    name: str
    around: int
    """Vertices round the tube, a multiple of four (the end caps are square grids)."""
    axial: float
    """Axial spacing of rings far from joints, in R0."""
    axial_at_joint: float
    """Axial spacing of rings beside a joint, in R0."""
    substeps: int
    """Substeps per frame at 24 frames per second."""
    round_around: int
    """Vertices round a round balloon, a multiple of four: it is as wide as three tubes."""
    heart_around: int
    """Vertices round a heart, a multiple of four: with 20 one is 3 % too narrow."""
    capsule_around: int
    """Vertices round a capsule, a multiple of four."""
    shape_quads: int
    """Quads up to which the faces of a mesh file are split."""


DETAILS: dict[str, Detail] = {
    "draft": Detail(
        "draft",
        around=12,
        axial=0.66,
        axial_at_joint=0.34,
        substeps=100,
        round_around=20,
        heart_around=24,
        capsule_around=32,
        shape_quads=2500,
    ),
    "preview": Detail(
        "preview",
        around=20,
        axial=0.42,
        axial_at_joint=0.22,
        substeps=200,
        round_around=28,
        heart_around=28,
        capsule_around=48,
        shape_quads=8000,
    ),
    "full": Detail(
        "full",
        around=28,
        axial=0.27,
        axial_at_joint=0.15,
        substeps=300,
        round_around=32,
        heart_around=32,
        capsule_around=64,
        shape_quads=24000,
    ),
}


def detail_named(name: str) -> Detail:
    """Return the level of detail with this name.

    Raises:
        ValueError: there is no such level.
    """
    try:
        return DETAILS[name]
    except KeyError:
        raise ValueError(f"unknown detail {name!r}, expected one of {', '.join(DETAILS)}") from None
