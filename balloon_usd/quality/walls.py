"""The walls of a sculpture as one surface: triangles, bubbles, and the necks of its joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import networkx as nx
import numpy as np

from balloon_usd.balloon.sizes import NECK_REACH
from balloon_usd.quality.joints import joints_of, made_joints
from balloon_usd.quality.ring_corners import RingCorners

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.frame import Frame

    Numbers = NDArray[np.int64]

CAPSULE_NECK_REACH = 0.25
"""The same of a capsule, in radii before it is twisted."""
ROUND_NECK_REACH = 0.5
"""The same of a round balloon or a heart, in R0: what is folded up lies within 0.4 where one is twisted or
tied, and a whole R0 is most of a balloon.
"""
NO_NECK = -1
STUB_REACH = 1.2
"""How far from the middle of its neck what is left of an end that was cut off lies, at most, in the neck's
radius: a lid with a nib (`solver.severed`).
"""
SIDE_BY_SIDE = 0.25
"""Distance up to which necks lie side by side, in radii of the blown-up balloon: two closed ones are 0.2
apart.
"""
OPEN = 0.3
"""Radius of a neck that has opened again, at least, in how far the rubber before it reaches."""


class Side(NamedTuple):
    """Rubber on one side of a neck, up to the end of its balloon: it may be cut off there."""

    ring: Numbers
    """Vertices of the ring in the middle of the neck."""
    vertices: Numbers
    """All vertices beyond it."""
    others: Numbers
    """All before it."""

    def moved(self, before: int) -> Side:
        """Return it with the numbers of its vertices counted on from some before them."""
        return Side(self.ring + before, self.vertices + before, self.others + before)

    def is_cut_off(self, points: NDArray[np.floating]) -> bool:
        """Whether all that is beyond lies in the neck; `points`: of all balloons, (V, 3) m."""
        ring = points[self.ring].astype(np.float64)
        middle = ring.mean(axis=0)
        radius = _far(ring, middle)
        # Of what hangs there its two ends tell so, without a look at all of it.
        beyond = (self.vertices[[0, -1]], self.vertices)
        if any(_far(points[some], middle) > STUB_REACH * radius for some in beyond):
            return False
        return radius < OPEN * _far(points[self.others], middle)


class Slipping(NamedTuple):
    """Joints that hands hold together as one until they let go, and nothing does then."""

    joints: tuple[int, ...]
    """Of each of its necks."""
    rings: tuple[RingCorners, ...]
    """In the middle of each neck."""
    reach: float
    """How far apart necks side by side are, at most, m."""

    def together(self, frame: Frame) -> list[set[int]]:
        """Return its joints as they still lie together in a frame."""
        middles = np.array([ring.places(frame).mean(axis=0) for ring in self.rings])
        near = nx.from_numpy_array(necks_apart(middles) <= self.reach)
        # Necks of one joint are together wherever they lie.
        near.add_edges_from((self.joints.index(joint), k) for k, joint in enumerate(self.joints))
        return [{self.joints[k] for k in lump} for lump in nx.connected_components(near)]


class Walls(NamedTuple):
    """All balloons of a sculpture together, their vertices one after another."""

    quads: Numbers
    """(F, 4) vertices."""
    triangles: Numbers
    """(T, 3), the first halves of all quads, then the second ones."""
    bubble_of_triangle: Numbers
    """(T,), in plan order."""
    bubble_of_vertex: Numbers
    """A bubble that each vertex belongs to, (V,)."""
    names: tuple[str, ...]
    """Of the bubbles."""
    neck: Numbers
    """Joint in whose neck each vertex lies, (V,); `NO_NECK` of others."""
    sides: tuple[Side, ...] = ()
    """Of all necks but those of knots."""
    slipping: tuple[Slipping, ...] = ()

    def held(self) -> Numbers:
        """Return the joint in whose neck each vertex lies while hands hold it, (V,): those that are meant to
        slip are one.
        """
        return self._neck_with([set(each.joints) for each in self.slipping])

    def let_go(self, frame: Frame) -> Numbers:
        """Return the same in a frame after hands have let go: as long as necks lie side by side."""
        return self._neck_with([lump for each in self.slipping for lump in each.together(frame)])

    def _neck_with(self, lumps: list[set[int]]) -> Numbers:
        """Return the joint in whose neck each vertex lies where the joints of each lump are one, (V,)."""
        neck = self.neck.copy()
        for lump in lumps:
            neck[np.isin(neck, list(lump))] = min(lump)
        return neck

    def cut_off(self, points: NDArray[np.floating]) -> Walls:
        """Return them as in a frame, (V, 3) m: what was cut off lies in the neck from which it was."""
        stubs = [side for side in self.sides if side.is_cut_off(points)]
        if not stubs:
            return self
        neck = self.neck.copy()
        for stub in stubs:
            neck[stub.vertices] = neck[stub.ring[0]]
        return self._replace(neck=neck)


def walls_of(plan: Plan, meshes: Sequence[BalloonMesh]) -> Walls:
    """Return the walls of a plan; one mesh a balloon, in the order of `Plan.strips`."""
    quads, bubbles, necks = [], [], []
    sides: list[Side] = []
    vertices = before = 0
    rings = [(ring, joint) for joint, group in enumerate(joints_of(plan)) for ring in group.rings]
    for strip, mesh in zip(plan.strips.values(), meshes, strict=True):
        quads.append(mesh.quads.astype(np.int64) + vertices)
        bubbles.append(mesh.quad_bubble.astype(np.int64) + before)
        neck = np.full(len(mesh.points), NO_NECK, dtype=np.int64)
        nearest = np.full(len(mesh.points), neck_reach(strip))
        for ring, joint in rings:
            place = plan.table.rings[ring]
            if place.balloon == strip.balloon and not (strip.inverted and place.along <= 0.0):
                # Knot and lip lie behind their ring.
                away = np.abs(np.maximum(mesh.along, 0.0) - place.along)
                near = away <= nearest
                neck[near], nearest[near] = joint, away[near]
                if place.along > 0.0:
                    corners = np.r_[RingCorners.of(plan, meshes, ring).vertices]
                    beyond = mesh.along - mesh.along[corners[0]]
                    sides += [side.moved(vertices) for side in sides_of_ring(corners, beyond)]
        necks.append(neck)
        vertices += len(mesh.points)
        before += len(strip.bubbles)
    names = tuple(bubble.name for bubble in plan.bubbles)
    found = walls_from(np.concatenate(quads), np.concatenate(bubbles), np.concatenate(necks), names, sides)
    return found._replace(slipping=tuple(_slipping(plan, meshes, dict(rings))))


def _slipping(plan: Plan, meshes: Sequence[BalloonMesh], joint_of: Mapping[int, int]) -> Iterator[Slipping]:
    """Yield the joints that a recipe makes one of and that slip; `joint_of`: rings of the plan."""
    for made in made_joints(plan):
        joints = tuple(joint_of[ring] for ring in made.rings)
        if len(set(joints)) > 1:
            rings = tuple(RingCorners.of(plan, meshes, ring) for ring in made.rings)
            widest = max(plan.strips[plan.table.rings[ring].balloon].inflated_radius for ring in made.rings)
            yield Slipping(joints, rings, SIDE_BY_SIDE * widest)


def walls_from(
    quads: Numbers,
    bubble_of_quad: Numbers,
    neck: Numbers,
    names: tuple[str, ...],
    sides: Sequence[Side] = (),
) -> Walls:
    """Return the walls of quads (F, 4) in bubbles (F,), with the necks of all vertices (V,)."""
    of_vertex = np.zeros(len(neck), dtype=np.int64)
    of_vertex[quads] = bubble_of_quad[:, None]
    return Walls(quads, halves(quads), np.tile(bubble_of_quad, 2), of_vertex, names, neck, tuple(sides))


def sides_of_ring(ring: Numbers, beyond: NDArray[np.floating]) -> list[Side]:
    """Return what lies on either side of a ring, if anything does; `beyond`: how far each vertex is behind
    it, (V,).
    """
    others = np.ones(len(beyond), dtype=bool)
    others[ring] = False
    first, last = (np.flatnonzero(others & (side * beyond > 0.0)) for side in (-1.0, 1.0))
    return [Side(ring, *each) for each in ((first, last), (last, first)) if len(first) and len(last)]


def necks_apart(middles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distances between necks, (N, N), m; `middles`: (N, 3), m."""
    return np.asarray(np.linalg.norm(middles[:, None] - middles[None], axis=2))


def _far(points: NDArray[np.floating], middle: NDArray[np.float64]) -> float:
    """Return how far the farthest of some points, (N, 3), is from a place, (3,), m."""
    return float(np.linalg.norm(points - middle, axis=1).max())


def halves(quads: Numbers) -> Numbers:
    """Return the triangles of quads (F, 4), (2 F, 3): the first halves of all, then the second ones."""
    return np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


def neck_reach(strip: Strip) -> float:
    """Return how far from its joint rubber of a neck lies unstressed, at most, m."""
    if strip.capsule:
        return CAPSULE_NECK_REACH * strip.inflated_radius
    return (ROUND_NECK_REACH if strip.is_round else NECK_REACH) * strip.size.radius
