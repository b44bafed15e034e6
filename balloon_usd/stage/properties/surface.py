"""Properties 12 to 16: the meshes are whole, closed surfaces at every sample, the particles all there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom, Vt

from balloon_usd.stage.pose import extent_of
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import (
    attributes_of,
    clouds_of,
    first_value,
    is_float,
    meshes_of,
    samples_of,
    value_at,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

TIGHT = 1e-6
"""An extent fits within this fraction of its size (float32 rounding)."""

SMALLEST_AREA = 1e-12
"""Area of a face [m2] that counts as none: a square of a thousandth of a millimetre."""


def topology_valid(stage: Any) -> Iterator[Finding]:
    """Property 12: valid topology at every sample, constant count of points and of particles."""
    yield from _particle_faults(stage)
    for mesh in meshes_of(stage):
        path = str(mesh.GetPath())
        counts, indices = _topology(mesh)
        seen: set[int] = set()
        for time, points in samples_of(mesh.GetPointsAttr()):
            if len(points) in seen:
                continue
            if seen:
                yield Finding(12, f"{len(points)} points, {min(seen)} before", path, time)
            seen.add(len(points))
            valid, why = UsdGeom.Mesh.ValidateTopology(
                Vt.IntArray.FromNumpy(indices), Vt.IntArray.FromNumpy(counts), len(points)
            )
            if not valid or not len(counts):
                yield Finding(12, " ".join(why.split()) or "no faces", path, time)
        if not seen:
            yield Finding(12, "no points", path)


def _particle_faults(stage: Any) -> Iterator[Finding]:
    for cloud in clouds_of(stage):
        path = str(cloud.GetPath())
        counts = [(time, len(points)) for time, points in samples_of(cloud.GetPointsAttr())]
        if not counts or not counts[0][1]:
            yield Finding(12, "no particles", path)
        for time, count in counts:
            if count != counts[0][1]:
                yield Finding(12, f"{count} particles, {counts[0][1]} before", path, time)


def all_finite(stage: Any) -> Iterator[Finding]:
    """Property 13: no NaN or infinity anywhere."""
    for attribute in attributes_of(stage):
        path = str(attribute.GetPath())
        times = [*attribute.GetTimeSamples(), None]
        for time in times:
            values = value_at(attribute, time)
            if is_float(values) and not np.isfinite(values).all():
                yield Finding(13, "NaN or infinity", path, time)


def extents_tight(stage: Any) -> Iterator[Finding]:
    """Property 14: an extent per sample, enclosing and tight; particles count with their widths."""
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        for time, points in samples_of(shape.GetPointsAttr()):
            if not len(points):
                continue
            radii = _radii(shape, time, len(points))
            expected = np.stack([extent_of(points - radii)[0], extent_of(points + radii)[1]])
            found = value_at(shape.GetExtentAttr(), time)
            slack = TIGHT * float(np.ptp(expected))
            if found.shape != (2, 3) or np.abs(found - expected).max() > slack:
                text = f"extent is {found.tolist()}, expected {expected.tolist()}"
                yield Finding(14, text, str(shape.GetPath()), time)


def _radii(shape: Any, time: float | None, count: int) -> NDArray[np.float32]:
    """Radius of each point (P, 1), or of all (1, 1); 0 for meshes and where widths do not fit."""
    widths = value_at(shape.GetWidthsAttr(), time) if isinstance(shape, UsdGeom.Points) else np.zeros(1)
    fits = len(widths) in {1, count}
    return np.asarray(0.5 * widths if fits else [0.0], dtype=np.float32)[:, None]


def closed_surface(stage: Any) -> Iterator[Finding]:
    """Property 15: watertight, wound outwards, no zero-area face, no unused or coincident point."""
    for mesh in meshes_of(stage):
        path = str(mesh.GetPath())
        counts, indices = _topology(mesh)
        points_count = len(first_value(mesh.GetPointsAttr()))
        if not len(indices) or indices.max() >= points_count or counts.sum() != len(indices):
            yield Finding(15, "faces do not fit the points", path)
            continue
        for text in _edge_faults(counts, indices, points_count):
            yield Finding(15, text, path)
        triangles, faces = _triangles(counts, indices)
        for time, points in samples_of(mesh.GetPointsAttr()):
            if len(points) == points_count:
                for text in _shape_faults(points.astype(np.float64), triangles, faces):
                    yield Finding(15, text, path, time)


def subdivision_authored(stage: Any) -> Iterator[Finding]:
    """Property 16: subdivisionScheme is authored; no normals on subdivided meshes."""
    for mesh in meshes_of(stage):
        path = str(mesh.GetPath())
        scheme = mesh.GetSubdivisionSchemeAttr()
        if not scheme.HasAuthoredValue():
            yield Finding(16, "subdivisionScheme is not authored", path)
        normals = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
        authored = mesh.GetNormalsAttr().HasAuthoredValue() or normals.HasAuthoredValue()
        if authored and scheme.Get() != UsdGeom.Tokens.none:
            yield Finding(16, "normals on a subdivided mesh", path)


def _topology(mesh: Any) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Vertex counts (F,) and vertex numbers (sum of counts,) of the faces."""
    counts = first_value(mesh.GetFaceVertexCountsAttr())
    indices = first_value(mesh.GetFaceVertexIndicesAttr())
    return counts.astype(np.int32), indices.astype(np.int32)


def _edge_faults(counts: NDArray[np.int32], indices: NDArray[np.int32], points: int) -> Iterator[str]:
    """Faults in the edges: a closed, consistently wound surface has each edge once in each direction."""
    ends = np.cumsum(counts)
    following = np.arange(len(indices)) + 1
    following[ends - 1] = ends - counts
    here, there = indices.astype(np.int64), indices[following].astype(np.int64)
    edges, uses = np.unique(here * points + there, return_counts=True)
    back = there * points + here
    if (uses > 1).any():
        yield f"{int((uses > 1).sum())} edges are used twice in one direction (winding)"
    open_edges = int((~np.isin(back, edges)).sum())
    if open_edges:
        yield f"{open_edges} open edges"
    unused = points - len(np.unique(indices))
    if unused:
        yield f"{unused} unused points"


def _triangles(
    counts: NDArray[np.int32], indices: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.intp]]:
    """Fans of the faces: vertex numbers (T, 3) and the face of each triangle (T,)."""
    starts = np.cumsum(counts) - counts
    corners, faces = [], []
    for step in range(1, int(counts.max()) - 1):
        large = np.flatnonzero(counts > step + 1)
        first = starts[large]
        corners.append(np.stack([indices[first], indices[first + step], indices[first + step + 1]], axis=1))
        faces.append(large)
    return np.concatenate(corners), np.concatenate(faces)


def _shape_faults(
    points: NDArray[np.float64], triangles: NDArray[np.int32], faces: NDArray[np.intp]
) -> Iterator[str]:
    """Faults of one sample of the points (V, 3)."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.bincount(faces, weights=np.linalg.norm(normals, axis=1) / 2.0)
    flat = int((areas < SMALLEST_AREA).sum())
    if flat:
        yield f"{flat} faces without area"
    # Six times the volume, about the middle of the points to keep the digits.
    if float(np.sum((a - points.mean(axis=0)) * normals)) <= 0.0:
        yield "faces point inwards"
    coincident = len(points) - len(np.unique(points, axis=0))
    if coincident:
        yield f"{coincident} coincident points"
