"""What the solver knows of one balloon: mesh, rubber, rings that can be held or closed, and chambers
between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.tube_mesh import BalloonMesh

Ints = NDArray[np.int32]


@dataclass(frozen=True)
class RingSpec:
    """A ring of vertices that hands can hold and, if it parts two chambers, close."""

    first: int
    """First of its consecutive vertices."""
    around: int
    """Number of its vertices."""
    parts: bool
    """Whether it is the border between two chambers."""
    closed: bool = False
    """Whether it is closed from the start (the knot)."""


@dataclass(frozen=True)
class Body:
    """One balloon before it is put on a device."""

    points: NDArray[np.float32]
    """Vertex positions at the start, (V, 3) float32, m."""
    rest: NDArray[np.float64]
    """Unstressed vertex positions, (V, 3) float64, m."""
    quads: Ints
    """Faces, (Q, 4) int32, counter-clockwise from outside."""
    thickness: NDArray[np.float64]
    """Unstressed wall thickness of every quad, (Q,) float64, m."""
    rubber: Rubber
    """Law of the wall."""
    radius: float
    """Unstressed tube radius, m: the scale of contact and necks."""
    along: NDArray[np.float32]
    """Unstressed distance of every vertex along the balloon, (V,) float32, m."""
    mesh_rings: tuple[tuple[int, int], ...]
    """All rings of the mesh as (first vertex, number of vertices); at least one."""
    vertex_ring: Ints
    """Nearest mesh ring of every vertex, (V,) int32."""
    rings: tuple[RingSpec, ...]
    """Rings for hands and joints, in order along the balloon."""
    segment_ends: Ints
    """End of every chamber's run of quads, (S,) int32: chambers are consecutive runs of faces."""
    gauge: NDArray[np.float64]
    """Gauge pressure of every chamber at the start, (S,) float64, Pa."""
    vented: tuple[int, ...]
    """Chambers open to the air: they keep their gauge pressure."""
    inlet: int
    """Chamber that the pump blows into."""
    neck_radius: float
    """Radius of a closed joint, m."""


NECK_RADIUS = 0.55
"""Radius of a twisted neck, in R0: about 2.5 mm on a 260. The bunched rubber itself is half as thick."""
LIP_THICKNESS = 5.0
"""Wall of the rolled lip, in wall thicknesses."""
LIP_PRESSURE = 0.7
"""Pressure that stands for the stiffness of the rolled lip, in pressures of the knot: it keeps the lip's
shape.
"""
SEED_THINNING = 0.12
"""Wall is thinner by this share behind the knot, where artists stretch it: the bulge starts there."""
SEED_LENGTH = 5.0
"""Length over which that thinning fades, in R0."""
TIP_THICKENING = 0.5
"""Wall is thicker by this share at the tip, where the former was dipped deepest."""
TIP_LENGTH = 3.0
"""Length over which that thickening fades, in R0."""
START_TAPER = 1.6
"""Slope at which the flat tube widens beside the knot at the start (m per m)."""


def tube_body(
    mesh: BalloonMesh,
    rubber: Rubber,
    radius: float,
    thickness: float,
    joints: tuple[float, ...],
    guides: tuple[float, ...],
    knot_pressure: float,
) -> Body:
    """Return the body of a twisting balloon: lip, knot bead, and a chamber between every two joints.

    `joints`, `guides`: unstressed distances from the knot, m; guides are rings that hands lead but never
    close.
    `knot_pressure`: gauge pressure sealed into the knot bead, Pa.
    """
    n = mesh.around
    bead = int(np.searchsorted(mesh.ring_along, -1e-9))
    lip = 3
    marks = [(lip, True, True), (bead, True, True)]
    marks += [(mesh.ring_at(s), True, False) for s in joints]
    marks += [(mesh.ring_at(s), False, False) for s in guides]
    marks.sort()
    rings = tuple(RingSpec(int(mesh.ring_start[r]), n, parts, closed) for r, parts, closed in marks)
    m = (n // 4) ** 2
    borders = [m + r * n for r, parts, _ in marks if parts]
    ends = np.array([*borders, len(mesh.quads)], dtype=np.int32)
    gauge = np.zeros(len(ends))
    gauge[0], gauge[1] = LIP_PRESSURE * knot_pressure, knot_pressure
    middle = mesh.along[mesh.quads].mean(axis=1)
    wall = thickness * (1.0 - SEED_THINNING * np.exp(-np.clip(middle, 0.0, None) / (SEED_LENGTH * radius)))
    wall *= 1.0 + TIP_THICKENING * np.exp((middle - mesh.along.max()) / (TIP_LENGTH * radius))
    wall[: borders[0]] *= LIP_THICKNESS
    neck = NECK_RADIUS * radius
    ring_of = np.abs(mesh.along[:, None] - mesh.ring_along[None, :]).argmin(axis=1).astype(np.int32)
    return Body(
        points=_tapered(mesh, [mesh.ring_along[lip], mesh.ring_along[bead]], neck),
        rest=mesh.points.astype(np.float64),
        quads=mesh.quads,
        thickness=wall,
        rubber=rubber,
        radius=radius,
        along=mesh.along,
        mesh_rings=tuple((int(f), n) for f in mesh.ring_start),
        vertex_ring=ring_of,
        rings=rings,
        segment_ends=ends,
        gauge=gauge,
        vented=(0,),
        inlet=2,
        neck_radius=neck,
    )


def _tapered(mesh: BalloonMesh, closed: list[float], neck: float) -> NDArray[np.float32]:
    """Vertex positions with the tube drawn in at the rings that are closed from the start."""
    points = mesh.points.copy()
    for s in closed:
        radius = np.maximum(np.linalg.norm(points[:, 1:], axis=1), 1e-9)
        wanted = neck + START_TAPER * np.abs(mesh.along - s)
        points[:, 1:] *= np.minimum(1.0, wanted / radius)[:, None]
    return points
