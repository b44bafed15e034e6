"""Properties 12 to 16: the meshes are whole, closed surfaces at every sample, the particles all there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom, Vt
from balloon_usd.stage.pose import extent_of
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import clouds_of, is_float, meshes_of
from balloon_usd.stage.properties.triangles import coincident, edge_faults

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from balloon_usd.stage.properties.shape import Moment, Value

TIGHT = 1e-6
"""An extent fits within this fraction of its size (float32 rounding)."""

SMALLEST_AREA = 1e-12
"""Area of a face [m2] that counts as none: a square of a thousandth of a millimetre."""

FACES = UsdGeom.Tokens.faceVertexIndices


def points_authored(stage: Any) -> Iterator[Finding]:
    """Property 12: there are points, faces between those of a mesh, and particles."""
    for mesh in meshes_of(stage):
        if not mesh.GetPointsAttr().HasValue():
            yield Finding(12, "no points", str(mesh.GetPath()))
        if not (mesh.GetFaceVertexIndicesAttr().HasValue() and mesh.GetFaceVertexCountsAttr().HasValue()):
            yield Finding(12, "no faces", str(mesh.GetPath()))
    for cloud in clouds_of(stage):
        if not cloud.GetPointsAttr().HasValue():
            yield Finding(12, "no particles", str(cloud.GetPath()))


def faces_fit_points(value: Value) -> Iterator[Finding]:
    """Property 12: valid topology."""
    shape = value.shape
    if shape is None or not shape.is_mesh or value.attribute.GetName() != FACES:
        return
    indices, counts = (Vt.IntArray.FromNumpy(np.ascontiguousarray(a)) for a in (shape.indices, shape.counts))
    valid, why = UsdGeom.Mesh.ValidateTopology(indices, counts, shape.point_count)
    if not valid or not len(counts):
        yield Finding(12, " ".join(why.split()) or "no faces", shape.path, value.time_code)
    few = int((shape.counts < 3).sum())
    if few:
        yield Finding(12, f"{few} faces with fewer than three corners", shape.path, value.time_code)


def count_constant(moment: Moment) -> Iterator[Finding]:
    """Property 12: a constant count of points and of particles."""
    shape, count = moment.shape, len(moment.points)
    what = "points" if shape.is_mesh else "particles"
    if moment.before is None and not count:
        yield Finding(12, f"no {what}", shape.path, moment.time_code)
    if moment.before is not None and count != len(moment.before.points):
        text = f"{count} {what}, {len(moment.before.points)} before"
        yield Finding(12, text, shape.path, moment.time_code)


def all_finite(value: Value) -> Iterator[Finding]:
    """Property 13: no NaN or infinity anywhere."""
    if is_float(value.array) and not np.isfinite(value.array).all():
        yield Finding(13, "NaN or infinity", value.path, value.time_code)


def extents_tight(moment: Moment) -> Iterator[Finding]:
    """Property 14: an extent per sample, enclosing and tight; particles count with their widths."""
    shape, points = moment.shape, moment.points
    if not len(points):
        return
    found = moment.value(shape.schema.GetExtentAttr())
    if found.shape != (2, 3):
        yield Finding(14, "no extent", shape.path, moment.time_code, _EXTENT)
        return
    if shape.is_mesh:
        expected = extent_of(points)
    else:
        radii = _radii(moment)
        expected = np.stack([extent_of(points - radii)[0], extent_of(points + radii)[1]])
    off = np.abs(found - expected).max()
    if off > TIGHT * float(np.ptp(expected)):
        inside = bool((found[0] <= expected[0]).all() and (found[1] >= expected[1]).all())
        what = "is loose" if inside else "does not hold the points"
        yield Finding(14, f"extent {what}, by {off:.3g}", shape.path, moment.time_code, _EXTENT)


_EXTENT = "author extent as the smallest and largest corner of the points of the same time code"


def _radii(moment: Moment) -> NDArray[np.float32]:
    """Radius of each point (P, 1), or of all (1, 1); 0 where widths do not fit."""
    widths = moment.value(moment.shape.schema.GetWidthsAttr())
    fits = len(widths) in {1, len(moment.points)}
    return np.asarray(0.5 * widths if fits else [0.0], dtype=np.float32)[:, None]


def edges_closed(value: Value) -> Iterator[Finding]:
    """Property 15: watertight, consistent winding, no unused point."""
    shape = value.shape
    if shape is None or not (shape.is_mesh and shape.sculpted) or value.attribute.GetName() != FACES:
        return
    if not shape.faces_fit:
        yield Finding(15, "faces do not fit the points", shape.path, value.time_code)
        return
    for text in edge_faults(shape.counts, shape.indices, shape.point_count):
        yield Finding(15, text, shape.path, value.time_code)


def surface_whole(moment: Moment) -> Iterator[Finding]:
    """Property 15: wound outwards, no zero-area face, no coincident point."""
    shape, points = moment.shape, moment.points
    triangles = shape.triangles if shape.sculpted else None
    if triangles is None or len(points) != shape.point_count:
        return
    areas, volume = triangles.areas_and_volume(points)
    flat = int((areas < SMALLEST_AREA / shape.metre / shape.metre).sum())
    if flat:
        yield Finding(15, f"{flat} faces without area", shape.path, moment.time_code)
    if volume <= 0.0:
        yield Finding(15, "faces point inwards", shape.path, moment.time_code)
    same = coincident(points)
    if same:
        yield Finding(15, f"{same} coincident points", shape.path, moment.time_code)


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
            yield Finding(16, "normals on a subdivided mesh", path, remedy="leave the normals out")
