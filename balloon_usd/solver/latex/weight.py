"""What a figure of latex weighs, and where: its rubber, and the gas of every bubble."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.air import MOLAR_MASS
from balloon_usd.solver.corners import vector_areas
from balloon_usd.solver.rigid_figure import Lumps, RigidFigure
from balloon_usd.solver.sculpture import ALL

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

DISC = math.sqrt(0.5)
"""Radius of the ring that has the inertia of a disc, in that of the disc: the gas of a slice of a bubble."""
SLACK = 500.0
"""Pressure up to which rubber is flat, Pa."""
NARROW = 0.005
"""Radius of rubber that is flat all over, m."""


def rigid_figure(sculpture: LatexSculpture, points: Floats, part: Ints | slice = ALL) -> RigidFigure:
    """Return a part of a sculpture as a rigid body; `points`: all its vertices, (V, 3), m."""
    scene, hands, own = sculpture.scene, sculpture.hands, sculpture.vertices
    segment = scene.vertex_segment.numpy()[own]
    quads = np.concatenate(
        [scene.bodies[b].quads + scene.vertex_start[b] - own.start for b in sculpture.bodies]
    )
    middles = _ring_middles(points, scene.vertex_ring.numpy()[own])
    out = points - middles
    radius = np.linalg.norm(out, axis=1)
    rubber = scene.true_mass.numpy()[own].astype(float)
    share = _shares(_wall_about(points, quads) * radius, segment, len(hands.amount))
    gas = Lumps(
        middles + DISC * out, MOLAR_MASS * share * hands.amount[segment], share * hands.volume[segment]
    )
    lumps = Lumps.of([Lumps(points, rubber, np.zeros(len(rubber))).at(part), gas.at(part)])
    firmness = _firmness(sculpture, segment, radius)
    return RigidFigure.of(lumps, points[part], _faces_of(quads, len(points), part), firmness[part])


def _faces_of(quads: NDArray[np.int32], vertices: int, part: Ints | slice) -> Ints:
    """Return the faces that have all their corners in a part of so many vertices, numbered within it."""
    within = np.full(vertices, -1)
    within[part] = np.arange(len(within[part]))
    found: Ints = within[quads]
    return found[(found >= 0).all(axis=1)]


def _firmness(sculpture: LatexSculpture, segment: NDArray[np.int64], radius: Floats) -> Floats:
    """Return how stiff the ground's push on every vertex is, (V,), N/m: where a round wall is pressed flat,
    the pressure behind it acts on an area that grows with the depth by 2 pi times the radius.

    What is flat, and knots, are as firm as the softest bubble: they are small, and what they are of is not.
    """
    scene, hands = sculpture.scene, sculpture.hands
    volume = np.maximum(hands.volume, 1.0e-12).astype(float)
    gauge = hands.amount * float(scene.air.molar_energy) / volume - scene.settings.atmosphere
    blown = [s for s in np.unique(segment[segment >= 0]).tolist() if gauge[s] > SLACK]
    firm = np.zeros(len(gauge))
    for each in blown:
        firm[each] = 2.0 * math.pi * float(np.median(radius[segment == each])) * gauge[each]
    softest = firm[blown].min() if blown else 2.0 * math.pi * NARROW * SLACK
    return np.asarray(np.maximum(np.where(segment >= 0, firm[segment], 0.0), softest))


def _ring_middles(points: Floats, ring: NDArray[np.int64]) -> Floats:
    """Return the middle of the ring of every vertex, (V, 3), m."""
    _, ring, count = np.unique(ring, return_inverse=True, return_counts=True)
    sums = np.stack([np.bincount(ring, weights=points[:, k]) for k in range(3)], axis=1)
    middles: Floats = (sums / count[:, None])[ring]
    return middles


def _wall_about(points: Floats, quads: NDArray[np.int64]) -> Floats:
    """Return the area of the wall about every vertex, (V,), m2."""
    area = 0.25 * np.linalg.norm(vector_areas(points, quads), axis=1)
    return np.asarray(np.bincount(quads.ravel(), np.repeat(area, 4), len(points)), dtype=float)


def _shares(weights: Floats, segment: NDArray[np.int64], segments: int) -> Floats:
    """Return the share that every vertex has of its segment, (V,), in proportion to weights (V,); none where
    it belongs to no segment.
    """
    inside = segment >= 0
    weights = np.where(inside, weights, 0.0)
    total = np.bincount(np.maximum(segment, 0), weights=weights, minlength=segments)
    return np.asarray(np.where(inside, weights / np.maximum(total, 1.0e-30)[np.maximum(segment, 0)], 0.0))
