"""Closed surfaces for balloons: the shipped heart, a ball, a cushion."""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.closed_shape import ClosedShape, shape_of_faces

Floats = NDArray[np.float64]

ROUND = 36
"""Points of the rim of the heart."""
RINGS = (0.24, 0.45, 0.64, 0.82)
"""Rings of points inside each sheet, as shares of the way from its middle to the rim."""
ACROSS = 30.0
"""Width of the heart, cm."""


def heart_rim() -> Floats:
    """Outline (36, 2) with the notch first, at even distances from there to the tip and back, cm.

    It is two circles that overlap, and their tangents through the tip.
    """
    middle, tip = np.array([0.9, 0.7]), np.array([0.0, -1.8])
    reach = float(np.linalg.norm(tip - middle))
    below = math.atan2(*(tip - middle)[::-1]) + math.acos(1.0 / reach)
    arc = np.linspace(math.pi - math.acos(0.9), below, 2001)
    right = middle + np.stack([np.cos(arc), np.sin(arc)], axis=1)
    half = np.concatenate([right, [tip]])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(half, axis=0), axis=1))])
    at = np.arange(ROUND // 2 + 1) * along[-1] / (ROUND // 2)
    sampled = np.stack([np.interp(at, along, half[:, k]) for k in range(2)], axis=1)
    mirrored = sampled[-2:0:-1] * [-1.0, 1.0]
    return np.asarray(ACROSS / 3.8 * np.concatenate([sampled, mirrored]))


def heart_text() -> str:
    """The file recipes/meshes/heart.obj: two sheets that share their rim, in the plane of x and z, cm."""
    rim, middle = heart_rim(), np.zeros(2)
    sheet = np.concatenate([[middle], *(middle + share * (rim - middle) for share in RINGS)])
    points = np.concatenate([rim, sheet, sheet])
    faces = []
    for first in (ROUND, ROUND + len(sheet)):
        # The middle of a sheet, its rings of points outwards, and the rim that both share.
        starts = [first + 1 + ROUND * k for k in range(len(RINGS))] + [0]
        for k in range(ROUND):
            then = (k + 1) % ROUND
            made = [(first, starts[0] + k, starts[0] + then)]
            made += [(a + k, b + k, b + then, a + then) for a, b in pairwise(starts)]
            # The notch is above, so this runs clockwise seen from -y, where the first sheet faces.
            faces += made if first > ROUND else [face[::-1] for face in made]
    lines = [
        "# A heart of two flat sheets with one rim, in cm, z up. The rim is two circles that overlap and their",
        "# tangents through the tip; each sheet is a web of 36 faces round and 5 outwards.",
    ]
    lines += [f"v {x:.4f} 0 {z:.4f}".replace(" -0.0000", " 0.0000") for x, z in points]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    return "\n".join(lines) + "\n"


def write_obj(file: Path, points: Any, faces: Any) -> Path:
    """Write points (V, 3) and faces, counted from 0."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.asarray(points, dtype=float).tolist()]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    file.write_text("\n".join(lines) + "\n")
    return file


def cube() -> tuple[Floats, list[tuple[int, ...]]]:
    """A cube from -1 to 1, its six faces turned outwards."""
    points = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, faces


def icosahedron() -> tuple[Floats, list[tuple[int, ...]]]:
    """An icosahedron of edge 2, turned outwards: five triangles at every point."""
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    around = [(0.0, s, t * golden) for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
    points = np.array([p[k:] + p[:k] for k in range(3) for p in around])
    near = np.linalg.norm(points[:, None] - points[None], axis=2)
    faces = []
    for a, b, c in combinations(range(12), 3):
        if max(near[a, b], near[b, c], near[c, a]) < 2.1:
            outward = np.dot(np.cross(points[b] - points[a], points[c] - points[a]), points[a]) > 0.0
            faces.append((a, b, c) if outward else (a, c, b))
    return points, faces


def ball(radius: float, cells: int) -> ClosedShape:
    """A cube of `cells` by `cells` quads a side, blown out to a sphere of a radius (m)."""
    points, faces = cube()
    shape = shape_of_faces(points, [np.array(face, dtype=np.int32) for face in faces])
    while len(shape.quads) < 6 * cells**2:
        shape = shape.split()
    # At equal angles, so that the faces are about as large.
    place = np.tan(0.25 * math.pi * shape.points)
    return ClosedShape(radius * place / np.linalg.norm(place, axis=1, keepdims=True), shape.quads)


def ring(
    wide: float = 10.0, thick: float = 3.0, around: int = 24, across: int = 10
) -> tuple[Floats, list[tuple[int, ...]]]:
    """A ring of round cross-section: radius of its middle and of the cross-section, and points along each."""
    points, faces = [], []
    for i in range(around):
        for j in range(across):
            u, v = 2.0 * math.pi * i / around, 2.0 * math.pi * j / across
            reach = wide + thick * math.cos(v)
            points.append((reach * math.cos(u), reach * math.sin(u), thick * math.sin(v)))
            k, m = (i + 1) % around, (j + 1) % across
            faces.append((across * i + j, across * k + j, across * k + m, across * i + m))
    return np.array(points), faces
