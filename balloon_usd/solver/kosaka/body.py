"""A balloon of the thesis's model: blown up, with its net of springs and its air particles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.plan.blown import BlownShape, blown_shape
from balloon_usd.plan.meshing import joint_places
from balloon_usd.plan.particles import start_particles
from balloon_usd.solver.body import NECK_RADIUS, Body, RingSpec
from balloon_usd.solver.kosaka.net import Net, net_of, tension_of
from balloon_usd.solver.kosaka.parameters import KEPT_OFF, Parameters, parameters, pressure_of_push

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Strip
    from balloon_usd.plan.rings import RingTable
    from balloon_usd.recipe.kosaka import Kosaka

LIP_RING = 3
"""Ring at which the nozzle's lip ends."""
NOZZLE_TAPER = 1.6
"""Slope at which the nozzle widens beside its narrow places (m per m)."""
NEAR = 1e-9
"""Distance below which two places along a balloon are the same, m."""


@dataclass(frozen=True, kw_only=True)
class KosakaBody(Body):
    """A balloon with its springs, its air and the constants of both."""

    net: Net
    parameters: Parameters
    push: float
    """Push of a particle on the rubber, m/s2 (eq. 3.10)."""
    vertex_mass: float
    """Mass (kg) of a vertex at which the air's push is the pressure in a real balloon: it turns accelerations
    into newtons and pascals.
    """
    air: NDArray[np.float32]
    """Particles at the start, (P, 3) float32, m."""


def kosaka_body(
    strip: Strip, table: RingTable, mesh: BalloonMesh, given: Kosaka, pressure: float, dt: float
) -> KosakaBody:
    """Return the body of a balloon that starts blown up.

    Args:
        strip: the balloon.
        table: its planned rings.
        mesh: its mesh.
        given: constants that the recipe sets itself.
        pressure: gauge pressure in a real balloon of this kind (Pa).
        dt: time step (s).
    """
    shape = blown_shape(strip)
    points = blown_points(mesh, shape, capsule=strip.capsule)
    law = parameters(given, shape.wide, 2.0 * math.pi * shape.wide / mesh.around, dt)
    tension = tension_of(mesh, points)
    carried = tension.pressure_for(law.natural, law.swell, law.ks)
    push = law.push if law.push is not None else carried / (KEPT_OFF * pressure_of_push(law))
    natural = tension.natural_lengths(carried, law.swell, law.ks)
    guides = tuple(r.along for r in table.rings if r.balloon == strip.balloon and not r.joint)
    rings = _rings(mesh, joint_places(strip), guides, capsule=strip.capsule)
    n = mesh.around
    borders = [(n // 4) ** 2 + (r.first - int(mesh.ring_start[0])) for r in rings if r.parts]
    nearest = np.abs(mesh.along[:, None] - mesh.ring_along[None, :]).argmin(axis=1).astype(np.int32)
    return KosakaBody(
        points=points.astype(np.float32),
        quads=mesh.quads,
        radius=strip.size.radius,
        along=mesh.along,
        mesh_rings=tuple((int(f), n) for f in mesh.ring_start),
        vertex_ring=nearest,
        rings=rings,
        segment_ends=np.array([*borders, len(mesh.quads)], dtype=np.int32),
        neck_radius=NECK_RADIUS * strip.size.radius,
        spare_segments=0 if strip.capsule else 1,
        net=net_of(tension.edges, natural, len(points)),
        parameters=law,
        push=push,
        vertex_mass=pressure / carried,
        air=start_particles(strip, given.spacing).astype(np.float32),
    )


def blown_points(mesh: BalloonMesh, shape: BlownShape, *, capsule: bool) -> NDArray[np.float64]:
    """Return the vertices (V, 3) float64, m, of a mesh whose balloon is blown up; a capsule is so already."""
    points = mesh.points.astype(np.float64)
    if capsule:
        return points
    along = mesh.along.astype(np.float64)
    flat = float(np.linalg.norm(points[mesh.ring_start[-1], 1:]))
    nozzle = along < -NEAR
    tip = along > mesh.ring_along[-1] + NEAR
    place = shape.place_of(along)
    drawn_in = [
        shape.neck + NOZZLE_TAPER * np.abs(along - mesh.ring_along[k]) for k in (LIP_RING, _knot(mesh))
    ]
    wide = np.where(nozzle, np.minimum(np.min(drawn_in, axis=0), flat), shape.radius_at(place))
    wide = np.where(tip, shape.thin, wide)
    points[:, 0] = np.where(nozzle, along, place)
    points[:, 1:] *= wide[:, None] / flat
    return points


def _knot(mesh: BalloonMesh) -> int:
    """Ring at which a tube is tied."""
    return int(np.searchsorted(mesh.ring_along, -NEAR))


def _rings(
    mesh: BalloonMesh, joints: tuple[float, ...], guides: tuple[float, ...], *, capsule: bool
) -> tuple[RingSpec, ...]:
    """Rings that hands hold, in order; a tube's knot is closed and carries the nozzle."""
    knot = 0 if capsule else _knot(mesh)
    start = int(mesh.ring_start[knot])
    begin = (
        RingSpec(start, mesh.around, False) if capsule else RingSpec(start, mesh.around, True, True, start)
    )
    marks = sorted([(mesh.ring_at(s), True) for s in joints] + [(mesh.ring_at(s), False) for s in guides])
    return (begin, *(RingSpec(int(mesh.ring_start[r]), mesh.around, parts) for r, parts in marks))
