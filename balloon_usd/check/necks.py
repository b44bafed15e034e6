"""Necks of twisted balloons, found in a stage: rings where bubbles meet, and the joints that hold them.

The meshes of balloons are rows of rings (`balloon.ringed_faces`). Their texture coordinates tell how far each
ring was from the knot before it was blown up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import networkx as nx
import numpy as np

from balloon_usd.balloon.ringed_faces import inner_vertices, ring_starts, ringed_quads
from balloon_usd.balloon.sizes import NECK_REACH
from balloon_usd.balloon.tube_mesh import KNOT_LENGTH, LIP_LENGTH, MIRRORED_FACE
from balloon_usd.quality.joints import APART
from balloon_usd.quality.walls import CAPSULE_NECK_REACH, NO_NECK, SIDE_BY_SIDE, necks_apart, sides_of_ring

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.quality.walls import Side

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]

LIP_RING, KNOT_RING = 3, 7
"""Rings of a tube at which its lip and its knot end."""
ROUNDING = 1e-4
"""Of texture coordinates, as a share of the reach of a neck."""
MOST_AROUND = 256
"""Vertices of a ring, at most: no level of detail has as many."""


@dataclass(frozen=True)
class Neck:
    """Rubber on both sides of a place where bubbles meet, or that is tied into a knot."""

    ring: Numbers
    """Vertices of the ring in its middle."""
    vertices: Numbers
    """All of its vertices."""
    away: Floats
    """How far each of them lies from the ring along the balloon, unstressed; in R0, or of capsules in m."""
    rings: Numbers
    """All rings of its balloon, (R, around) vertices."""
    sides: tuple[Side, ...]
    """All rubber of its balloon before it, and all behind it."""

    def moved(self, before: int) -> Neck:
        """Return it with the numbers of its vertices counted on from some before them."""
        sides = tuple(side.moved(before) for side in self.sides)
        return Neck(self.ring + before, self.vertices + before, self.away, self.rings + before, sides)


def necks_of(quads: Numbers, st: Floats, bubbles: Numbers, first: Floats) -> list[Neck]:
    """Return the necks of a balloon, or of the mirror image of one; none where the mesh is no row of rings.

    Args:
        quads: (F, 4) vertices.
        st: texture coordinates of the corners, (F, 4, 2); empty where there are none.
        bubbles: of the faces, (F,).
        first: points (V, 3) of the earliest frame, m.
    """
    if len(st) != len(quads):
        return []
    around = _around(quads, len(first))
    if not around:
        around, st = _around(quads[:, MIRRORED_FACE], len(first)), st[:, MIRRORED_FACE]
    if not around:
        return []
    rings = ring_starts(around, _rings(len(first), around))[:, None].astype(np.int64) + np.arange(around)
    faces = slice((around // 4) ** 2, (around // 4) ** 2 + (len(rings) - 1) * around)
    rows = bubbles[faces].reshape(-1, around)[:, 0]
    t = st[faces, :, 1].reshape(-1, around, 4)
    places = np.append(t[:, 0, 0], t[-1, 0, 3])
    meets = 1 + np.flatnonzero(rows[1:] != rows[:-1])
    if _is_tube(places):
        # In R0, from the knot; the caps are beyond all necks.
        along = np.full(len(first), np.inf)
        along[: rings[0, 0]] = -np.inf
        along[rings] = (places * LIP_LENGTH / places[LIP_RING] - LIP_LENGTH - KNOT_LENGTH)[:, None]
        start, reach = KNOT_RING, NECK_REACH
    else:
        along, radius = _measured(first, rings)
        start, reach = 0, CAPSULE_NECK_REACH * radius
    reach *= 1.0 + ROUNDING
    found = [_neck(rings, start, np.maximum(along, 0.0), reach, ())]
    for at in meets.tolist():
        beyond = along - along[rings[at]].mean()
        sides = tuple(sides_of_ring(rings[at], beyond))
        found.append(_neck(rings, at, np.abs(beyond), reach, sides))
    return found


def _neck(rings: Numbers, at: int, away: Floats, reach: float, sides: tuple[Side, ...]) -> Neck:
    """Return a neck in the midst of a ring; `away`: how far all vertices are from it, (V,)."""
    near = np.flatnonzero(away <= reach)
    return Neck(rings[at], near, away[near], rings, sides)


class Necks:
    """The necks of a stage, and the joints that hold them: those that lie together belong to one."""

    def __init__(self, necks: Sequence[Neck], last: Floats) -> None:
        """Find the joints that hold in the end; `last`: points of the last frame, (V, 3), m."""
        self._neck = np.full(len(last), NO_NECK, dtype=np.int64)
        """The nearest neck of each vertex that lies in one."""
        nearest = np.full(len(last), np.inf)
        for index, neck in enumerate(necks):
            near = neck.vertices[neck.away <= nearest[neck.vertices]]
            self._neck[near] = index
            nearest[neck.vertices] = np.minimum(nearest[neck.vertices], neck.away)
        self._rings = [neck.ring for neck in necks]
        widest = np.array([_radii(last[neck.rings]).max() for neck in necks])
        self._reach = np.maximum.outer(widest, widest)
        """Of pairs, the radius of the wider balloon, m."""
        self._kept = self._apart(last) <= APART * self._reach

    def joints_in(self, points: Floats) -> Numbers:
        """Return the joint in whose neck each vertex lies in a frame, (V,); `NO_NECK` of others.

        A joint is what holds in the end, or what lies side by side in this frame, as hands hold what slips.
        `points`: (V, 3), m.
        """
        if not self._rings:
            return self._neck
        near = nx.from_numpy_array(self._kept | (self._apart(points) <= SIDE_BY_SIDE * self._reach))
        number = np.full(len(self._rings) + 1, NO_NECK)
        for joint, together in enumerate(nx.connected_components(near)):
            number[list(together)] = joint
        return number[self._neck]

    def _apart(self, points: Floats) -> Floats:
        """Return the distances between all necks, m; `points`: (V, 3), m."""
        middles = np.array([points[ring].mean(axis=0) for ring in self._rings]).reshape(-1, 3)
        return necks_apart(middles)


def _around(quads: Numbers, vertices: int) -> int:
    """Return how many vertices each ring has; 0 where the faces are no row of rings."""
    for around in range(8, MOST_AROUND + 1, 4):
        rings = _rings(vertices, around)
        fits = rings > 1 and 2 * inner_vertices(around) + rings * around == vertices
        if fits and np.array_equal(quads, ringed_quads(around, rings)):
            return around
    return 0


def _rings(vertices: int, around: int) -> int:
    return (vertices - 2 * inner_vertices(around)) // around


def _is_tube(places: Floats) -> bool:
    """Whether rings stand as lip and knot of a tube have them; those of a capsule stand alike everywhere."""
    if len(places) <= KNOT_RING or places[LIP_RING] <= 0.0:
        return False
    share = (places[KNOT_RING] - places[LIP_RING]) / (places[LIP_RING] - places[0])
    return math.isclose(share, KNOT_LENGTH / LIP_LENGTH, rel_tol=1e-3)


def _measured(first: Floats, rings: Numbers) -> tuple[Floats, float]:
    """Return how far vertices are from the start of a straight capsule, (V,), and its radius."""
    middles = first[rings].mean(axis=1)
    axis = middles[-1] - middles[0]
    along = first @ (axis / max(float(np.linalg.norm(axis)), 1e-30))
    return along - along.min(), float(_radii(first[rings]).max())


def _radii(rings: Floats) -> Floats:
    return np.asarray(np.linalg.norm(rings - rings.mean(axis=1, keepdims=True), axis=2).mean(axis=1))
