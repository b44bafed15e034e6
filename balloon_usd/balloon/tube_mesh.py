"""The closed all-quad mesh of a twisting balloon: lip, knot, tube or round body, and tip.

The flat tube lies along +x with the knot at x = 0 and the nozzle lip at negative x. Every ring has the same
number of vertices; the two ends are closed by square grids, so that all faces are quads. The cross-section is
the polygon circumscribed to the circle of radius R0: hoop and axial equilibrium of a pressurised polygonal
tube then are exactly those of the round tube, at every level of detail. The rings of a round balloon have
more vertices, and lie closer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.ringed_faces import (
    Ints,
    cap_points,
    mirrored_texture,
    ring_starts,
    ringed_bubbles,
    ringed_quads,
    ringed_texture,
    unit_circle,
)
from balloon_usd.balloon.round_outline import LAST, round_outline

if TYPE_CHECKING:
    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.sizes import BalloonSize

KNOT_LENGTH = 1.8
"""Rubber taken by the knot bead, in R0 (judged by eye against a tied 260)."""
LIP_LENGTH = 2.0
"""Length of the nozzle left behind the knot, in R0."""
LIP_FLARE = 1.35
"""Radius of the lip's rim, in R0."""
LIP_DOME = 0.075
"""Height of the lid that closes the nozzle, in that of half a ball."""
BEFORE_CAP = 0.5
"""Share of the wall behind the last joint of a round balloon that is no cap, at least."""
GRADING = 0.18
"""Growth of the axial spacing per distance from the nearest joint."""
TORN_ROWS = 5
"""Rows of faces that are gone once a bubble tears: they stand where two do of one that does not. Frames show
them as a lid on each rag, of two rows, and a thread between both: a thread of one row is not thin where a
renderer subdivides it.
"""

MIRRORED_FACE = [0, 3, 2, 1]
"""Corners of a face from whose mirror image the outside is where it was."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class BalloonMesh:
    """One balloon's mesh with the rings that the plan speaks of."""

    points: Floats
    """Unstressed vertex positions, (V, 3) float32, m."""
    quads: Ints
    """Faces, (Q, 4) int32, counter-clockwise from outside; first edge hoop, second axial on the tube."""
    st: Floats
    """Texture coordinates per face corner, (Q, 4, 2) float32: s round the tube, t along it."""
    quad_bubble: Ints
    """Bubble of every face, (Q,) int32, index into the balloon's own bubbles."""
    along: Floats
    """Unstressed distance from the knot of every vertex, (V,) float32, m; negative on knot and lip."""
    around: int
    """Vertices of a ring."""
    ring_start: Ints
    """First vertex of every ring, (R,) int32; a ring's vertices are consecutive."""
    ring_along: NDArray[np.float64]
    """Unstressed distance from the knot of every ring, (R,) float64, m."""

    def mirrored(self) -> BalloonMesh:
        """Return the mirror image, left and right exchanged: the second edge of a face is hoop there.

        Faces keep the diagonal at which renderers split them; print on a tube reads as before.
        """
        st = self.st[:, MIRRORED_FACE]
        if self.around:
            st = mirrored_texture(st)
        points = self.points * np.array([1.0, -1.0, 1.0], dtype=np.float32)
        return replace(self, points=points, quads=self.quads[:, MIRRORED_FACE], st=st)

    def ring_at(self, along: float) -> int:
        """Return the ring nearest to this unstressed distance from the knot (m)."""
        return int(np.argmin(np.abs(self.ring_along - along)))

    def rings_between(self, first: float, last: float) -> list[int]:
        """Return the rings from one unstressed distance from the knot (m) to another."""
        return list(range(self.ring_at(first), self.ring_at(last) + 1))


def ring_stations(
    detail: Detail,
    size: BalloonSize,
    joints: tuple[float, ...],
    guides: tuple[float, ...] = (),
    torn: tuple[float, ...] = (),
) -> NDArray[np.float64]:
    """Return the unstressed positions of the tube's rings, (R,) float64, m.

    There is one at every joint, and they stand closer beside joints; every guide has one of its own near.

    `torn`: places in bubbles that tear.

    Raises:
        ValueError: a joint lies outside the tube.
    """
    last = last_ring(size, max(joints, default=0.0))
    marks = sorted({0.0, *joints, last})
    if marks[0] < 0.0 or marks[-1] > last:
        raise ValueError(f"joints must lie between 0 and {last:.4f} m, got {joints}")
    coarse = detail.axial * size.radius * (detail.around / around_of(size, detail))
    fine = detail.axial_at_joint * size.neck_radius
    stations = [np.zeros(1)]
    for low, high in pairwise(marks):
        own = [guide for guide in guides if low < guide < high]
        row = _graded(low, high, fine, coarse, own, tail=high == last)
        stations.append(_torn(low, row) if any(low < place < high for place in torn) else row)
    return np.concatenate(stations)


def _graded(
    low: float, high: float, fine: float, coarse: float, guides: list[float], *, tail: bool
) -> NDArray[np.float64]:
    """Cut (low, high] so that the spacing grows from both joints; at the tip it only grows from `low`."""
    s = np.linspace(low, high, 512)
    distance = s - low if tail else np.minimum(s - low, high - s)
    spacing = np.minimum(coarse, fine + GRADING * distance)
    cells = np.concatenate([[0.0], np.cumsum(0.5 * (1 / spacing[1:] + 1 / spacing[:-1]) * np.diff(s))])
    count = max(2, round(float(cells[-1])))
    while True:
        stations: NDArray[np.float64] = np.interp(np.arange(count + 1) * cells[-1] / count, cells, s)
        led = [int(np.argmin(np.abs(stations - guide))) for guide in guides]
        # The last ring of the tube is no joint, and may be led.
        ends = {0} if tail else {0, count}
        if len({*led, *ends}) == len(led) + len(ends):
            return stations[1:]
        # Two hands cannot lead one ring.
        count += 1


def _torn(low: float, stations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the places of the rings behind `low` with the rows in their middle that tear."""
    ends = np.concatenate([[low], stations])
    first = first_torn_row(len(stations) - 2 + TORN_ROWS)
    torn = np.linspace(ends[first], ends[first + 2], TORN_ROWS + 1)
    return np.concatenate([ends[:first], torn, ends[first + 3 :]])[1:]


def first_torn_row(rows: int) -> int:
    """Return which of the rows of a bubble that tears is the first that is gone then."""
    return (rows - TORN_ROWS) // 2


@lru_cache(maxsize=64)
def tube_mesh(
    size: BalloonSize,
    detail: Detail,
    joints: tuple[float, ...],
    bubble_ends: tuple[float, ...],
    guides: tuple[float, ...] = (),
    torn: tuple[float, ...] = (),
) -> BalloonMesh:
    """Return the mesh of a balloon with a ring at every joint (m along the flat tube), one for each guide.

    Sculptures of a crowd share it, so its arrays cannot be written to.

    `bubble_ends`: where each bubble ends, m along the flat tube, ascending; the knot and lip belong to the
    first bubble and the tip to the last. `torn`: places in bubbles that tear, m along the flat tube.

    Raises:
        ValueError: a joint lies outside the tube.
    """
    knot, lip = _nozzle(size)
    behind = np.concatenate(
        [-knot - lip + lip * np.linspace(0, 1, 4), -knot + knot * np.linspace(0, 1, 5)[1:-1]]
    )
    along = np.concatenate([behind, ring_stations(detail, size, joints, guides, torn)])
    rings, n = len(along), around_of(size, detail)
    tube = _wall(size, along, n)
    lip_cap = _domed_cap(n, float(tube[0, 0, 1]), float(tube[0, 0, 1]))
    lip_cap[:, 0] = along[0] - lip_cap[:, 0] * LIP_DOME
    tip_cap, beyond = _tip(size, along[-1], tube[-1])
    vertex_along = np.concatenate([lip_cap[:, 0], np.repeat(along, n), along[-1] + beyond])
    points = np.concatenate([lip_cap, tube.reshape(-1, 3), tip_cap]).astype(np.float32)
    mesh = BalloonMesh(
        points=points,
        quads=ringed_quads(n, rings),
        st=ringed_texture(n, (along - along[0]) / (along[-1] - along[0])),
        quad_bubble=ringed_bubbles(n, along, bubble_ends),
        along=vertex_along.astype(np.float32),
        around=n,
        ring_start=ring_starts(n, rings),
        ring_along=along,
    )
    for name in ("points", "quads", "st", "quad_bubble", "along", "ring_start", "ring_along"):
        getattr(mesh, name).flags.writeable = False
    return mesh


def around_of(size: BalloonSize, detail: Detail) -> int:
    """Return how many vertices a ring of a balloon has."""
    if size.heart:
        return detail.heart_around
    return detail.around if size.neck is None else detail.round_around


def _nozzle(size: BalloonSize) -> tuple[float, float]:
    """Return how long the knot and the lip behind it are, m."""
    return KNOT_LENGTH * size.neck_radius, LIP_LENGTH * size.neck_radius


def last_ring(size: BalloonSize, last_joint: float) -> float:
    """Return where the last ring lies before the cap of the tip, m from the knot along the wall.

    `last_joint`: the same of the last joint, which in a round balloon may lie near the tip.
    """
    if size.neck is None:
        return size.length - size.radius
    if size.heart:
        return size.heart_wall.last
    cap = float(round_outline(size.radius, size.neck, LAST).along[-1])
    return max(cap, last_joint + BEFORE_CAP * (size.length - last_joint))


def _wall(size: BalloonSize, along: NDArray[np.float64], around: int) -> NDArray[np.float64]:
    """Return the corners of rings drawn about the wall, (R, around, 3), m, by their places along it."""
    x, radius = _outline(size, along)
    knot, lip = _nozzle(size)
    radius /= math.cos(math.pi / around)
    radius *= 1.0 + (LIP_FLARE - 1.0) * np.clip((-knot - along) / lip, 0.0, 1.0) ** 2
    wall = np.empty((len(along), around, 3))
    wall[:, :, 0] = x[:, None]
    wall[:, :, 1:] = radius[:, None, None] * unit_circle(around)
    if size.heart:
        turn = math.tau * np.arange(around) / around
        before = int(np.searchsorted(along, 0.0))
        wall[before:] = _drawn_about(size.heart_wall.points(along[before:, None], turn), around)
    return wall


def _tip(
    size: BalloonSize, along: float, rim: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the inner points of the cap behind the last ring, (K, 3), m, and how far behind it along the
    balloon they lie, (K,), m.

    `along`, `rim`: distance from the knot (m) and corners, (around, 3), of that ring.
    """
    around = len(rim)
    if size.heart:
        heart, flat = size.heart_wall, cap_points(around, 1.0)
        beyond = (1.0 - np.hypot(*flat.T)) * (heart.length - along)
        return _drawn_about(heart.points(along + beyond, np.arctan2(flat[:, 1], flat[:, 0])), around), beyond
    ball = size.radius / math.cos(math.pi / around)
    cap = _domed_cap(around, float(rim[0, 1]), ball)
    beyond = cap[:, 0] * size.radius / ball
    cap[:, 0] = beyond + rim[0, 0]
    return cap, beyond


def _drawn_about(points: NDArray[np.float64], around: int) -> NDArray[np.float64]:
    """Return points of a wall, (..., 3), where the corners of a polygon are that is drawn about it."""
    out = 1.0 / math.cos(math.pi / around)
    return np.asarray(points * np.array([1.0, out, out]))


def _outline(
    size: BalloonSize, along: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where rings lie along the axis, and their radii, (R,) each, m; behind the knot all is a tube."""
    if size.neck is None:
        return along, np.full(len(along), size.radius)
    whole = round_outline(size.radius, size.neck)
    x = np.where(along < 0.0, along, np.interp(along, whole.along, whole.x))
    return x, np.interp(along, whole.along, whole.radius)


def _domed_cap(around: int, radius: float, ball: float) -> NDArray[np.float64]:
    """Inner points of a cap of a ball, ((around/4 - 1)^2, 3), m, lifted towards +x over its rim.

    `radius`: of the rim; `ball`: of the ball.
    """
    flat = cap_points(around, radius)
    height = np.sqrt(np.maximum(ball**2 - np.sum(flat**2, axis=1), 0.0))
    return np.column_stack([height - math.sqrt(ball**2 - radius**2), flat])
