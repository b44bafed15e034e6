"""The net of springs of a mesh: who is tied to whom, and how long each spring naturally is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

SLOTS = 4
"""Springs at one vertex."""
SHORTEST = 0.2
"""Shortest natural length, in lengths at the start."""
STEEPEST = 0.25
"""Smallest cosine of the meridian's slope that counts: the rings of a net cannot follow a steeper wall."""
AIRLESS, AIRY = 0.3, 0.5
"""Radii below which no air pushes and above which all does, in radii of the blown-up balloon."""


def edges_of(quads: Ints) -> Ints:
    """Return the edges of some quads once each, (E, 2) int32, in order of their vertices."""
    pairs = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    return np.unique(np.sort(pairs, axis=1), axis=0).astype(np.int32)


@dataclass(frozen=True)
class Net:
    """Springs by vertex, each listed at both of its ends."""

    ends: Ints
    """Other end of every spring at a vertex, (V, 4) int32; -1 for none."""
    natural: Floats
    """Its natural length, (V, 4), m; 1 for none."""


def net_of(edges: Ints, natural: Floats, vertices: int) -> Net:
    """Return the net of some edges (E, 2) and their natural lengths (E,), m.

    Raises:
        ValueError: more than four edges meet at a vertex.
    """
    ends = np.full((vertices, SLOTS), -1, dtype=np.int32)
    lengths = np.ones((vertices, SLOTS))
    both = np.concatenate([edges, edges[:, ::-1]])
    order = np.lexsort((both[:, 1], both[:, 0]))
    here, there, size = both[order, 0], both[order, 1], np.tile(natural, 2)[order]
    count = np.bincount(here, minlength=vertices)
    if count.max() > SLOTS:
        raise ValueError(f"at most {SLOTS} edges may meet at a vertex, {count.max()} do")
    slot = np.arange(len(here)) - np.repeat(np.cumsum(count) - count, count)
    ends[here, slot] = there
    lengths[here, slot] = size
    return Net(ends, lengths)


@dataclass(frozen=True)
class Tension:
    """What a net carries per unit of the air's pressure: it is at rest when its springs pull as much."""

    edges: Ints
    """(E, 2)"""
    length: Floats
    """Length at the start, (E,), m."""
    load: Floats
    """Pull of every edge over the pressure, (E,), m2."""
    around: NDArray[np.bool_]
    """Edges that run round the tube, (E,)."""
    wide: NDArray[np.bool_]
    """Edges of its widest part, (E,)."""

    def pressure_for(self, natural: float, swell: float, ks: float) -> float:
        """Return the air's pressure (1/(m s2)) at which springs round the tube with a natural length of
        `natural` lengths are at rest when the net is larger by `swell`; less, where short springs along the
        tube could not carry it.
        """
        around, all_wide = self.wide & self.around, self.wide
        wanted = ks * (1.0 + swell - natural) * self.length[around] / self.load[around]
        most = ks * (1.0 + swell - SHORTEST) * self.length[all_wide] / self.load[all_wide]
        return float(min(np.median(wanted), most.min()))

    def natural_lengths(self, pressure: float, swell: float, ks: float) -> Floats:
        """Return natural lengths, (E,), m, at which the net carries a pressure when larger by `swell`."""
        natural = (1.0 + swell) * self.length - pressure * self.load / ks
        return np.maximum(natural, SHORTEST * self.length)


def tension_of(mesh: BalloonMesh, points: Floats) -> Tension:
    """Return what the springs of a balloon of revolution along x must carry (Laplace's law of a membrane).

    `points`: (V, 3), m, at the start.
    """
    edges = edges_of(mesh.quads)
    length = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)
    hoop, axial, radius = _ring_tensions(mesh, points)
    rings = len(mesh.ring_start)
    inner = (int(mesh.ring_start[0]), int(mesh.ring_start[-1]) + mesh.around)
    ring = np.clip((np.arange(len(points)) - inner[0]) // mesh.around, 0, rings - 1)
    capped = (np.arange(len(points)) < inner[0]) | (np.arange(len(points)) >= inner[1])
    first, second = ring[edges[:, 0]], ring[edges[:, 1]]
    in_cap = capped[edges].any(axis=1)
    around = (first == second) & ~in_cap
    slant = np.linalg.norm(np.diff(points[mesh.ring_start], axis=0), axis=1)
    beside = 0.5 * (np.concatenate([slant[:1], slant]) + np.concatenate([slant, slant[-1:]]))[first]
    chord = 2.0 * radius * np.sin(np.pi / mesh.around)
    along = 0.5 * (axial[first] + axial[second])
    load = np.where(around, hoop[first] * beside, along * 0.5 * (chord[first] + chord[second]))
    load = np.where(in_cap, along * length, load)
    wide = radius > 0.98 * radius.max()
    return Tension(edges, length, load, around, wide[first] & wide[second] & ~in_cap)


def _ring_tensions(mesh: BalloonMesh, points: Floats) -> tuple[Floats, Floats, Floats]:
    """Tension round and along the wall over the pressure, and the radius, of every ring, (R,), m."""
    rings = points[mesh.ring_start[:, None] + np.arange(mesh.around)]
    middle = rings.mean(axis=1)
    radius = np.linalg.norm((rings - middle[:, None])[:, :, 1:], axis=2).mean(axis=1)
    slope = np.arctan2(np.gradient(radius), np.gradient(middle[:, 0]))
    steep = np.maximum(np.cos(slope), STEEPEST)
    step = np.hypot(np.gradient(radius), np.gradient(middle[:, 0]))
    bend = -np.gradient(slope) / step
    axial = 0.5 * radius / steep
    hoop = np.clip(1.0 - axial * bend, 0.5, 1.0) * radius / steep
    air = np.clip((radius / radius.max() - AIRLESS) / (AIRY - AIRLESS), 0.0, 1.0)
    return hoop * air, axial * air, radius
