"""Closed surfaces of quads, and the count of what pierces them, one pair after another."""

from __future__ import annotations

import numpy as np


def block(corner, size):
    """A box of six quads: its points and quads."""
    unit = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return np.array(corner) + unit * size, quads


def tube(radius, length, *, across=False, around=8, rings=20):
    """An open tube along x, or across it along y, about the origin: its points and quads."""
    turn = np.arange(around) * 2.0 * np.pi / around
    x = np.repeat(np.linspace(-0.5 * length, 0.5 * length, rings), around)
    y, z = (np.tile(radius * part, rings) for part in (np.cos(turn), np.sin(turn)))
    k, after = np.arange(around), (np.arange(around) + 1) % around
    row = around * np.arange(rings - 1)[:, None]
    quads = np.stack([row + k, row + after, row + around + after, row + around + k], axis=2).reshape(-1, 4)
    return np.stack([y, x, z] if across else [x, y, z], axis=1), quads


def together(*surfaces):
    """Several surfaces as one."""
    starts = np.cumsum([0, *(len(points) for points, _ in surfaces)])
    return np.concatenate([points for points, _ in surfaces]), np.concatenate(
        [quads + start for (_, quads), start in zip(surfaces, starts, strict=False)]
    )


def six_volumes(a, b, c, d):
    """Six times the volume of a tetrahedron of integers, in Python's own."""
    u, v, w = ([int(x) for x in row] for row in (b - a, c - a, d - a))
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(x * y for x, y in zip(cross, w, strict=True))


def by_hand(points, triangles, faces=None):
    """All pairs of an edge and a triangle that it pierces, of points on a lattice of integers."""
    faces = triangles if faces is None else faces
    sides = {tuple(sorted((int(t[i]), int(t[i - 1])))) for t in triangles for i in range(3)}
    found = set()
    for edge in sides:
        p, q = points[list(edge)]
        for index, triangle in enumerate(triangles):
            if set(edge) & set(faces[index].tolist()):
                continue
            a, b, c = points[triangle]
            over = six_volumes(a, b, c, p), six_volumes(a, b, c, q)
            around = [six_volumes(p, q, *pair) for pair in ((a, b), (b, c), (c, a))]
            parted = min(over) < 0 < max(over)
            if parted and (min(around) > 0 or max(around) < 0):
                found.add((*edge, index))
    return found
