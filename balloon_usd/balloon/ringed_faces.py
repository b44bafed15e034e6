"""Faces of a closed all-quad surface: a row of rings, each end closed by a square grid.

Vertices are numbered in this order: the inner vertices of the start cap, ring after ring from start to end,
the inner vertices of the end cap. With n vertices round a ring a cap has (n/4)^2 faces and (n/4 - 1)^2 inner
vertices. Rings run counter-clockwise seen from the end.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

Ints = NDArray[np.int32]
Reals = NDArray[np.float64]


def inner_vertices(around: int) -> int:
    """Return the number of inner vertices of one cap."""
    return (around // 4 - 1) ** 2


def ring_starts(around: int, rings: int) -> Ints:
    """Return the first vertex of every ring, (rings,) int32."""
    return (inner_vertices(around) + around * np.arange(rings)).astype(np.int32)


def unit_circle(around: int) -> Reals:
    """Return the corners of a ring of radius 1, (around, 2)."""
    theta = 2 * math.pi * np.arange(around) / around
    return np.stack([np.cos(theta), np.sin(theta)], axis=1)


def polygon_share(around: int) -> float:
    """Return the area of a regular polygon drawn about a circle, in areas of the circle."""
    return around * math.tan(math.pi / around) / math.pi


def cap_points(around: int, radius: float) -> Reals:
    """Return the inner points of a flat cap, ((around/4 - 1)^2, 2), m: a Coons patch of its circle."""
    grid = _cap_grid(around, 0, around)
    flat = np.zeros((grid.max() + 1, 2))
    flat[:around] = radius * unit_circle(around)
    m = around // 4
    u = np.arange(1, m)[:, None, None] / m
    v = np.arange(1, m)[None, :, None] / m
    p = flat[grid]
    ruled = (1 - u) * p[:1, 1:m] + u * p[m:, 1:m] + (1 - v) * p[1:m, :1] + v * p[1:m, m:]
    corners = (1 - u) * (1 - v) * p[0, 0] + u * (1 - v) * p[m, 0] + u * v * p[m, m] + (1 - u) * v * p[0, m]
    return np.asarray((ruled - corners).reshape(-1, 2))


TILE = np.array([1.0, 0.0])
"""From a tile of a texture to the next."""


def ringed_quads(around: int, rings: int) -> Ints:
    """Return the faces, (F, 4) int32: start cap, rows from start to end, end cap.

    They are counter-clockwise from outside; between rings the first edge is hoop, the second axial.
    """
    row, k = np.meshgrid(np.arange(rings - 1), np.arange(around), indexing="ij")
    inner = inner_vertices(around)
    start, after = inner + row * around, inner + (row + 1) * around
    turn = (k + 1) % around
    tube = np.stack([start + k, start + turn, after + turn, after + k], axis=-1).reshape(-1, 4)
    first = _cap_grid(around, inner, 0)
    last = _cap_grid(around, inner + (rings - 1) * around, inner + rings * around)
    return np.concatenate([_grid_quads(first)[:, ::-1], tube, _grid_quads(last)]).astype(np.int32)


def ringed_texture(around: int, ring_t: Reals) -> NDArray[np.float32]:
    """Return texture coordinates per face corner, (F, 4, 2) float32: s round it, t from `ring_t` (R,).

    The tube fills the first tile, the caps at its start and end the next two (UDIM 1002, 1003): no face lies
    on another.
    """
    row, k = np.meshgrid(np.arange(len(ring_t) - 1), np.arange(around), indexing="ij")
    s_low, s_high = k / around, (k + 1) / around
    corners = [
        (s_low, ring_t[row]),
        (s_high, ring_t[row]),
        (s_high, ring_t[row + 1]),
        (s_low, ring_t[row + 1]),
    ]
    tube = np.stack([np.stack(corner, axis=-1) for corner in corners], axis=2).reshape(-1, 4, 2)
    m = around // 4
    at, beside = np.meshgrid(np.arange(m), np.arange(m), indexing="ij")
    corners_of_cap = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    cap = (np.stack([at, beside], axis=-1).reshape(-1, 1, 2) + corners_of_cap) / m
    return np.concatenate([cap + TILE, tube, cap + 2 * TILE]).astype(np.float32)


def mirrored_texture(st: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return texture coordinates, (F, 4, 2), that run the other way round, each face within its tile."""
    first = np.floor(st[..., 0].min(axis=1, keepdims=True))
    return np.stack([2.0 * first + 1.0 - st[..., 0], st[..., 1]], axis=-1).astype(np.float32)


def ringed_bubbles(around: int, ring_along: Reals, bubble_ends: Sequence[float]) -> Ints:
    """Return the bubble of every face, (F,) int32; `bubble_ends` (m, ascending) as `ring_along` (R,)."""
    middle = np.repeat(0.5 * (ring_along[1:] + ring_along[:-1]), around)
    cap = np.ones((around // 4) ** 2)
    at = np.concatenate([ring_along[0] * cap, middle, ring_along[-1] * cap])
    bubble = np.searchsorted(np.asarray(bubble_ends), at)
    return np.minimum(bubble, len(bubble_ends) - 1).astype(np.int32)


def _cap_grid(around: int, ring: int, first_inner: int) -> Ints:
    """Vertex numbers of a cap's square grid; its border is the ring, walked once."""
    m = around // 4
    grid = np.empty((m + 1, m + 1), dtype=np.int32)
    border = ring + np.arange(around, dtype=np.int32)
    grid[:m, 0], grid[m, :m] = border[:m], border[m : 2 * m]
    grid[m:0:-1, m], grid[0, m:0:-1] = border[2 * m : 3 * m], border[3 * m :]
    grid[1:m, 1:m] = first_inner + np.arange((m - 1) ** 2, dtype=np.int32).reshape(m - 1, m - 1)
    return grid


def _grid_quads(grid: Ints) -> Ints:
    """Quads of a vertex grid, counter-clockwise seen from +x when the border runs counter-clockwise."""
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1).reshape(-1, 4)
