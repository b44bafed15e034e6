"""Points and primvars of one prim at one time code against the attributes of its object, bit for bit."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from pxr import Usd, UsdGeom

from tests.blender.imported import attributes_of

TYPES = {
    "float[]": "FLOAT",
    "int[]": "INT",
    "color3f[]": "FLOAT_COLOR",
    "float2[]": "FLOAT2",
    "texCoord2f[]": "FLOAT2",
}
"""Types of primvars and the types of attributes that Blender makes of them."""
DOMAINS = {"vertex": "POINT", "uniform": "FACE", "faceVarying": "CORNER"}
"""Where Blender puts the values of a primvar. One for all is put at the points, or since 5.2 at the corners."""


def array_differences(
    prim: Usd.Prim,
    thing: bpy.types.Object,
    graph: bpy.types.Depsgraph,
    code: float,
    dumped: np.ndarray | None,
) -> Iterator[tuple[str, str]]:
    """Names of what differs, and how; `dumped`: points (V, 3) expected instead of the prim's."""
    shown = attributes_of(thing, graph)
    points = UsdGeom.PointBased(prim).GetPointsAttr().Get(code) if dumped is None else dumped
    yield from _compare("points", "POINT", "FLOAT_VECTOR", np.asarray(points), shown.get("position"))
    if prim.IsA(UsdGeom.Points):
        widths = np.asarray(UsdGeom.Points(prim).GetWidthsAttr().Get(code))
        radii = np.broadcast_to(widths / np.float32(2.0), len(points))
        yield from _compare("widths", "POINT", "FLOAT", radii, shown.get("radius"))
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
        name, kind = primvar.GetPrimvarName(), str(primvar.GetTypeName())
        if kind not in TYPES:
            yield name, f"a {kind} does not arrive in Blender"
            continue
        values, domain = np.asarray(primvar.ComputeFlattened(code)), DOMAINS.get(primvar.GetInterpolation())
        if domain is None and name in shown:
            domain = shown[name][0]
            values = np.repeat(values, len(shown[name][2]), axis=0)
        if domain == "FACE" and TYPES[kind] == "FLOAT_COLOR":
            # Blender spreads colours of faces over their corners.
            counts = np.asarray(UsdGeom.Mesh(prim).GetFaceVertexCountsAttr().Get())
            domain, values = "CORNER", np.repeat(values, counts, axis=0)
        yield from _compare(name, domain, TYPES[kind], values, shown.get(name))


def _compare(
    name: str, domain: str | None, kind: str, values: np.ndarray, shown: tuple[str, str, np.ndarray] | None
) -> Iterator[tuple[str, str]]:
    if shown is None:
        yield name, "does not arrive in Blender"
        return
    if shown[:2] != (domain, kind):
        yield name, f"expected {domain} {kind}, in Blender {' '.join(shown[:2])}"
        return
    columns = values.reshape(len(values), -1)
    # Blender's colours have an alpha.
    arrived = shown[2][:, : columns.shape[1]]
    if columns.shape != arrived.shape or columns.dtype != arrived.dtype:
        yield name, f"{columns.shape} {columns.dtype}, in Blender {arrived.shape} {arrived.dtype}"
        return
    off = _bits(columns) != _bits(arrived)
    if off.any():
        row = int(np.flatnonzero(off.any(axis=1))[0])
        yield name, f"element {row} is {columns[row]}, in Blender {arrived[row]}"


def _bits(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values).view(np.uint32)
