"""What the solver knows of one balloon in any model: its mesh, and the rings that can be held or closed."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

Ints = NDArray[np.int32]

NECK_RADIUS = 0.55
"""Radius of a twisted neck, in R0: about 2.5 mm on a 260. The bunched rubber itself is half as thick."""


@dataclass(frozen=True)
class RingSpec:
    """A ring of vertices that hands can hold and, if it parts two bubbles, close."""

    first: int
    """First of its consecutive vertices."""
    around: int
    """Number of its vertices."""
    parts: bool
    """Whether it is the border between two segments."""
    closed: bool = False
    """Whether it is closed from the start (the knot)."""
    carried: int = 0
    """Vertices before it that a closed ring carries along rigidly (the nozzle behind the knot)."""
    folds: bool = True
    """Whether the rubber about it is folded up in itself once it is closed, as in a twisted neck."""


@dataclass(frozen=True)
class Body:
    """One balloon before it is put on a device."""

    points: NDArray[np.float32]
    """Vertex positions at the start, (V, 3) float32, m."""
    quads: Ints
    """Faces, (Q, 4) int32, counter-clockwise from outside."""
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
    """End of every segment's run of quads, (S,) int32: segments are consecutive runs of faces."""
    neck_radius: float
    """Radius of a closed joint, m."""
    spare_rings: int = 0
    """Rings before those that a plan speaks of."""
    spare_segments: int = 0
    """Segments before the first bubble."""
    contact_offset: float | None = None
    """Distance at which its walls begin to press, m; None for that of the scene."""
    contact_arc: float = 0.0
    """What that distance grows by with the area of the face that is touched, 1/m."""
    inside: tuple[int, int] | None = None
    """Balloon of its sculpture, and bubble of that, in which it lies; None where it lies in none."""
    place: NDArray[np.float32] | None = None
    """Unstressed place of every vertex, (V, 3) float32, m, where it is not told by `along`."""

    outward: NDArray[np.float32] | None = None
    """Unstressed outward direction of every vertex, (V, 3) float32, 0 where there is none; None where the
    inside of the wall never meets itself.
    """

    @property
    def along_only(self) -> NDArray[np.float32]:
        """Places along the balloon, (V, 3) float32, m, as if it had no width."""
        return np.stack([self.along, 0.0 * self.along, 0.0 * self.along], axis=1)


def body_ranges(counts: Sequence[int]) -> tuple[range, ...]:
    """Return the bodies of every sculpture, given how many each has."""
    ends = np.concatenate([[0], np.cumsum(counts)])
    return tuple(range(int(a), int(b)) for a, b in pairwise(ends))
