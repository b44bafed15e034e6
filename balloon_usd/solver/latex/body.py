"""A balloon of the latex model: mesh, rubber, rings that can be held or closed, and chambers between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from balloon_usd.balloon.bubble_shape import neck_rubber, neck_rubber_of_length
from balloon_usd.balloon.sizes import BalloonSize
from balloon_usd.balloon.tip_wall import tip_thickening
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.open_tube import softened
from balloon_usd.solver.body import NECK_RADIUS, Body, RingSpec

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.tube_mesh import BalloonMesh


@dataclass(frozen=True, kw_only=True)
class LatexBody(Body):
    """A balloon with its wall of rubber and its chambers of gas."""

    rest: NDArray[np.float64]
    """Unstressed vertex positions, (V, 3) float64, m."""
    thickness: NDArray[np.float64]
    """Unstressed wall thickness of every quad, (Q,) float64, m."""
    rubber: Rubber
    """Law of the wall."""
    worked: NDArray[np.float64]
    """Energy to which every quad was stretched before, (Q,) float64, J/m3: up to there it is soft."""
    gauge: NDArray[np.float64]
    """Gauge pressure of every chamber at the start, (S,) float64, Pa."""
    vented: tuple[int, ...]
    """Chambers open to the air: they keep their gauge pressure."""
    inlet: int
    """Chamber that the pump blows into."""
    hidden: NDArray[np.float64] | None = None
    """Rubber that a closed neck hides from every segment, (S,) float64, as a share of the length that two
    leave it; None for none.
    """
    drawn: NDArray[np.float64] | None = None
    """Rubber that turns draw out of every segment into the necks before and behind it, (S, 2) float64, as a
    share of the same; None for none.
    """
    gap: float = math.inf
    """Distance of walls that lie close to each other at the start, m: little gas between them is stiff."""
    packs: bool = False
    """Whether the inside of its wall meets itself where it is wound up, and packs. Not where a maker twists:
    turns of a joint are counted there and not wound.
    """


LIP_THICKNESS = 5.0
"""Wall of the rolled lip, in wall thicknesses."""
LIP_PRESSURE = 0.7
"""Pressure that stands for the stiffness of the rolled lip, in pressures of the knot: it keeps the lip's
shape.
"""
SEED_LENGTH = 4.0
"""Length behind the knot that artists stretch beforehand, in R0: it is softer, so the bulge starts there."""
SEED_THINNING = 0.12
"""Share by which the wall is thinner there instead if the rubber does not soften."""
CONTACT_OFFSET = 0.4
"""Distance at which walls begin to press, in R0, 2 mm for a 260."""
ARC_OFFSET = 1.35
"""Distance besides, in heights of a bubble's arc over the edges of the face that is touched: edges of two
pressed bubbles would cross in a coarse mesh (2.8 mm together for a 260 in `draft`, 2.1 mm in `preview`). By
the face, because a small one, as in a neck, cannot bear the couple of a force that acts from afar.
"""
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
    short: Mapping[int, float] | None = None,
    drawn: tuple[float, ...] | None = None,
    *,
    parted: tuple[float, ...] = (),
    seeded: bool = True,
    inverted: bool = False,
) -> LatexBody:
    """Return the body of a twisting balloon: lip, knot bead, and a chamber between every two joints.

    `joints`, `guides`: unstressed distances from the knot, m; guides are rings that hands lead but never
    close.
    `knot_pressure`: gauge pressure sealed into the knot bead, Pa.
    `short`: inflated lengths of bubbles too short to tell by their rubber, m, by their number.
    `drawn`: unstressed rubber that turns draw into the neck of every joint, m.
    `parted`: places of joints whose necks hide no rubber, in place of `joints`, m.
    `seeded`: whether the wall is softer behind the knot, so that a bulge starts there.
    `inverted`: whether the wall of the first bubble is turned inside: then its outside meets itself, and
    knot and lip lie in it instead of being folded up in a neck.
    """
    n = mesh.around
    bead = int(np.searchsorted(mesh.ring_along, -1e-9))
    lip = 3
    marks = [(lip, True, True), (bead, True, True)]
    marks += [(mesh.ring_at(s), True, False) for s in (*joints, *parted)]
    marks += [(mesh.ring_at(s), False, False) for s in guides]
    marks.sort()
    rings = tuple(
        RingSpec(int(mesh.ring_start[r]), n, parts, closed, folds=not (closed and inverted))
        for r, parts, closed in marks
    )
    m = (n // 4) ** 2
    borders = [m + r * n for r, parts, _ in marks if parts]
    ends = np.array([*borders, len(mesh.quads)], dtype=np.int32)
    gauge = np.zeros(len(ends))
    gauge[0], gauge[1] = LIP_PRESSURE * knot_pressure, knot_pressure
    middle = mesh.along[mesh.quads].mean(axis=1)
    seed = _seed(middle / (SEED_LENGTH * radius)) if seeded else np.zeros_like(middle)
    wall = thickness * tip_thickening(mesh.along.max() - middle, radius)
    if rubber.softening is None:
        wall *= 1.0 - SEED_THINNING * seed
    wall[: borders[0]] *= LIP_THICKNESS
    neck = NECK_RADIUS * radius
    bulged = maxwell_state(rubber).bulged
    point = neck * math.cos(math.pi / n)
    necks = _Necks.of(mesh, rubber, radius, joints, point, short or {}, drawn or (0.0,) * len(joints))
    ring_of = _nearest(mesh.ring_along, mesh.along)
    return LatexBody(
        points=_tapered(mesh, necks.whole, [mesh.ring_along[lip], mesh.ring_along[bead]], neck),
        rest=np.column_stack([necks.twisted, mesh.points[:, 1:].astype(np.float64)]),
        quads=mesh.quads,
        thickness=wall,
        rubber=rubber,
        hidden=np.concatenate([[0.0, 0.0], necks.shares, np.zeros(len(parted))]),
        drawn=np.concatenate([np.zeros((2, 2)), necks.drawn_shares, np.zeros((len(parted), 2))]),
        worked=seed * float(rubber.energy(bulged.a, bulged.b)),
        radius=radius,
        contact_offset=CONTACT_OFFSET * radius,
        contact_arc=ARC_OFFSET / (8.0 * bulged.b * radius),
        along=mesh.along,
        outward=_outward(mesh, joints[0] if inverted else 0.0),
        mesh_rings=tuple((int(f), n) for f in mesh.ring_start),
        vertex_ring=ring_of,
        rings=rings,
        segment_ends=ends,
        gauge=gauge,
        vented=(0,),
        inlet=2,
        neck_radius=neck,
        spare_rings=1,
        spare_segments=2,
    )


def _outward(mesh: BalloonMesh, inverted: float) -> NDArray[np.float32]:
    """Direction from the axis of the tube to every vertex, (V, 3); 0 up to a distance from the knot (m) to
    which the wall is turned inside.
    """
    away = mesh.points.copy()
    away[:, 0] = 0.0
    away[(mesh.along > 0.0) & (mesh.along <= inverted)] = 0.0
    radius = np.maximum(np.linalg.norm(away, axis=1), 1e-9)
    return np.asarray(away / radius[:, None], dtype=np.float32)


def _nearest(rings: NDArray[np.float64], along: NDArray[np.float32]) -> NDArray[np.int32]:
    """Ring nearest to every vertex, (V,), by their distances from the knot, m, ascending those of rings."""
    return np.searchsorted(0.5 * (rings[1:] + rings[:-1]), along).astype(np.int32)


def _seed(place: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the seed, 1 behind the knot and fading over as much again; `place`: in seed lengths."""
    return np.where(place > 0.0, np.clip(2.0 - place, 0.0, 1.0), 0.0)


@dataclass(frozen=True)
class _Necks:
    """Where the rubber of a tube lies that its necks hide when they are closed.

    The mesh ends at the surface of a neck. The rubber inside it, left in the bubbles, would swell a short one
    by a third.
    """

    x: NDArray[np.float64]
    """Unstressed place of every vertex along the tube, (V,), m."""
    marks: NDArray[np.float64]
    """Places of the knot, of all joints and of the tip, m."""
    hidden: NDArray[np.float64]
    """Length that each of its necks hides from every bubble, m."""
    drawn: NDArray[np.float64]
    """Length that turns draw out of every bubble into its necks before and behind, (bubbles, 2), m."""
    knot: float
    """What the knot hides from the tube before it is twisted, m."""

    @classmethod
    def of(
        cls,
        mesh: BalloonMesh,
        rubber: Rubber,
        radius: float,
        joints: tuple[float, ...],
        neck: float,
        short: Mapping[int, float],
        drawn: tuple[float, ...],
    ) -> Self:
        """Return those of a tube, of necks of one radius (m), into which turns draw rubber (m)."""
        x = mesh.points[:, 0].astype(np.float64)
        size = BalloonSize("tube", radius, float(x.max()), radius)
        marks = np.array([0.0, *joints, x.max()])
        halves = 0.5 * np.array([0.0, *drawn, 0.0])
        drawn_out = np.stack([halves[:-1], halves[1:]], axis=1)
        lengths = np.diff(marks) - drawn_out.sum(axis=1)
        hidden = np.array([neck_rubber(size, softened(rubber), float(s), neck) for s in lengths])
        for k, length in short.items():
            hidden[k] = neck_rubber_of_length(size, softened(rubber), length, neck)
        return cls(x, marks, hidden, drawn_out, neck_rubber(size, softened(rubber), size.length, neck))

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Unstressed lengths between the marks, m."""
        return np.diff(self.marks)

    @property
    def whole(self) -> NDArray[np.float64]:
        """Unstressed place of every vertex before any joint is made, (V,) m: only the knot is tied."""
        return self._place(self._by_knot)

    @property
    def twisted(self) -> NDArray[np.float64]:
        """The same when all joints are closed and wound, (V,) m; the tip has no neck."""
        return self._place(self._lost)

    @property
    def shares(self) -> NDArray[np.float64]:
        """What each joint hides from every bubble, in the length that it has between finished ones."""
        joints = np.full(len(self.hidden), 2.0)
        joints[0] -= 1.0
        joints[-1] -= 1.0
        each: NDArray[np.float64] = (self._by_all - self._by_knot) / np.maximum(joints, 1.0)
        return each / (self.lengths - self._lost)

    @property
    def drawn_shares(self) -> NDArray[np.float64]:
        """What turns draw out of every bubble into its necks before and behind, in the same, (bubbles, 2)."""
        shares: NDArray[np.float64] = self.drawn / (self.lengths - self._lost)[:, None]
        return shares

    @property
    def _lost(self) -> NDArray[np.float64]:
        lost: NDArray[np.float64] = self._by_all + self.drawn.sum(axis=1)
        return lost

    @property
    def _by_all(self) -> NDArray[np.float64]:
        necks = np.full(len(self.hidden), 2.0)
        necks[-1] = 1.0
        return necks * self.hidden

    @property
    def _by_knot(self) -> NDArray[np.float64]:
        hidden = np.zeros(len(self.hidden))
        hidden[0] = self.knot
        return hidden

    def _place(self, hidden: NDArray[np.float64]) -> NDArray[np.float64]:
        moved = np.concatenate([[0.0], np.cumsum(self.lengths - hidden)])
        return np.where(self.x > 0.0, np.interp(self.x, self.marks, moved), self.x)


def _tapered(
    mesh: BalloonMesh, place: NDArray[np.float64], closed: list[float], neck: float
) -> NDArray[np.float32]:
    """Vertex positions with the tube drawn in at the rings that are closed from the start."""
    points = mesh.points.copy()
    points[:, 0] = place
    for s in closed:
        radius = np.maximum(np.linalg.norm(points[:, 1:], axis=1), 1e-9)
        wanted = neck + START_TAPER * np.abs(mesh.along - s)
        points[:, 1:] *= np.minimum(1.0, wanted / radius)[:, None]
    return points
