"""Whether faces make a balloon: a closed surface of one piece, all turned the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from balloon_usd.mesh_file.error import MeshFileError

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

THIN = 2e-3
"""Least area of a face, in squares of its longest edge: thinner ones stretch like threads."""
FOLDED = 0.02
"""Least area of the triangle at each corner of a face, in areas of the face."""


def closed_faces(points: Floats, faces: Sequence[Ints]) -> tuple[Floats, list[Ints]]:
    """Return points (V, 3) and faces (k,) each of a closed surface, turned outwards, without unused points.

    Faces and points are counted from 1 in messages, as modelling programs show them in OBJ files.

    Raises:
        MeshFileError: what keeps the faces from being a balloon.
    """
    _require_faces(points, faces)
    _require_areas(points, faces)
    sides = _sides(faces)
    _require_closed(points, sides)
    _require_one_way(sides)
    _require_plain_points(faces)
    _require_one_piece(faces)
    used, numbered = np.unique(np.concatenate(faces), return_inverse=True)
    ends = np.cumsum([len(face) for face in faces])
    kept = np.split(numbered.astype(np.int32), ends[:-1])
    place = points[used]
    return (place, [face[::-1] for face in kept]) if _volume(place, kept) < 0.0 else (place, kept)


def _require_faces(points: Floats, faces: Sequence[Ints]) -> None:
    if not faces:
        raise MeshFileError("no faces, expected a closed surface of triangles or quads")
    if not np.isfinite(points).all():
        row = int(np.argmin(np.isfinite(points).all(axis=1)))
        raise MeshFileError(f"point {row + 1} is no number")
    for number, face in enumerate(faces, start=1):
        if face.min() < 0 or face.max() >= len(points):
            raise MeshFileError(f"face {number} names a point that is not among its {len(points)}")
        if len(set(face.tolist())) < len(face):
            raise MeshFileError(f"face {number} has one point at two corners")
    seen: dict[frozenset[int], int] = {}
    for number, face in enumerate(faces, start=1):
        first = seen.setdefault(frozenset(face.tolist()), number)
        if first != number:
            raise MeshFileError(f"faces {first} and {number} are one face twice: delete one of them")


def _require_areas(points: Floats, faces: Sequence[Ints]) -> None:
    """Refuse slivers, and quads that are folded or have a corner that points inwards."""
    for number, face in enumerate(faces, start=1):
        p = points[face]
        sides = np.roll(p, -1, axis=0) - p
        corners = 0.5 * np.cross(np.roll(sides, 1, axis=0), sides)
        normal = corners.sum(axis=0)
        area = float(np.linalg.norm(normal)) / (3 if len(face) == 3 else 2)
        longest = float((sides**2).sum(axis=1).max())
        if not area > THIN * longest:
            what = "has no area" if longest == 0.0 else "is a sliver"
            raise MeshFileError(f"face {number} {what}, expected faces about as wide as long")
        if (corners @ normal).min() < FOLDED * area * float(np.linalg.norm(normal)):
            raise MeshFileError(f"face {number} has a corner that points inwards: triangulate it")


def _sides(faces: Sequence[Ints]) -> dict[tuple[int, int], list[tuple[int, bool]]]:
    """Return the faces at every edge, by its points in rising order, and whether they run that way."""
    sides: dict[tuple[int, int], list[tuple[int, bool]]] = {}
    for number, face in enumerate(faces, start=1):
        corners = face.tolist()
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            sides.setdefault((min(a, b), max(a, b)), []).append((number, a < b))
    return sides


def _require_closed(points: Floats, sides: dict[tuple[int, int], list[tuple[int, bool]]]) -> None:
    for (a, b), beside in sides.items():
        if len(beside) > 2:
            numbers = ", ".join(str(number) for number, _ in beside)
            text = f"faces {numbers} meet at the edge of points {a + 1} and {b + 1}"
            raise MeshFileError(f"{text}, expected two at every edge")
    rim = [edge for edge, beside in sides.items() if len(beside) == 1]
    if rim:
        a, b = rim[0]
        text = f"not closed: {_edges(len(rim))} one face only, the first of points {a + 1} and {b + 1}"
        at = np.unique(np.array(rim).ravel())
        doubled = len(np.unique(points[at], axis=0)) < len(at)
        remedy = "merge its points by distance" if doubled else "fill its holes"
        raise MeshFileError(f"{text}: {remedy}")


def _edges(count: int) -> str:
    return "1 edge has" if count == 1 else f"{count} edges have"


def _require_one_way(sides: dict[tuple[int, int], list[tuple[int, bool]]]) -> None:
    for (one, forward), (other, too) in sides.values():
        if forward == too:
            text = f"faces {one} and {other} are turned against each other"
            raise MeshFileError(f"{text}: recalculate its normals to the outside")


def _require_plain_points(faces: Sequence[Ints]) -> None:
    """Refuse points at which two sheets touch that are joined nowhere else near."""
    fans: dict[int, nx.Graph[int]] = {}
    for face in faces:
        corners = face.tolist()
        for before, at, after in zip(
            [corners[-1], *corners[:-1]], corners, [*corners[1:], corners[0]], strict=True
        ):
            fans.setdefault(at, nx.Graph()).add_edge(before, after)
    for point, fan in fans.items():
        if not nx.is_connected(fan):
            raise MeshFileError(f"two parts touch in point {point + 1} alone, expected joined edges")


def _require_one_piece(faces: Sequence[Ints]) -> None:
    joined: nx.Graph[int] = nx.Graph()
    for face in faces:
        nx.add_path(joined, face.tolist())
    pieces = nx.number_connected_components(joined)
    if pieces > 1:
        raise MeshFileError(f"{pieces} pieces that are not joined, expected one: give each a balloon")


def _volume(points: Floats, faces: Sequence[Ints]) -> float:
    """Return the volume inside, m3, negative where faces are turned inwards."""
    total = 0.0
    origin = points.mean(axis=0)
    for face in faces:
        p = points[face] - origin
        total += float(np.einsum("ij,ij->", np.cross(p[1:-1], p[2:]), np.broadcast_to(p[0], p[2:].shape)))
    return total / 6.0
