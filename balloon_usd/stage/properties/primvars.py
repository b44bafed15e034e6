"""Property 20: values have types that arrive, and primvars as many as their interpolation wants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import UsdGeom
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import clouds_of, meshes_of, mistyped, value_at

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.stage.properties.shape import Shape, Value

SAFE_TYPES = frozenset(
    {"color3f[]", "float2[]", "float3[]", "float[]", "int[]", "normal3f[]", "point3f[]", "texCoord2f[]"}
)
"""Primvar types that arrive in DCC tools; half, double, matrix, string and scalars get lost."""

_TYPE = "author an array of float, int, float2, float3, color3f, point3f, normal3f or texCoord2f"


def types_of_schemas(stage: Any) -> Iterator[Finding]:
    """Property 20: attributes have the types of their schemas."""
    for prim in stage.Traverse():
        for path, found, wanted in mistyped(prim):
            remedy = f"author it as {wanted}"
            yield Finding(20, f"is of type {found}, which nothing reads", path, remedy=remedy)


def types_arrive(stage: Any) -> Iterator[Finding]:
    """Property 20: DCC-safe types only."""
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        for primvar in UsdGeom.PrimvarsAPI(shape).GetAuthoredPrimvars():
            if str(primvar.GetTypeName()) not in SAFE_TYPES:
                text = f"type {primvar.GetTypeName()} gets lost in DCC tools"
                yield Finding(20, text, str(primvar.GetAttr().GetPath()), remedy=_TYPE)


def lengths_fit(value: Value) -> Iterator[Finding]:
    """Property 20: primvar lengths fit their interpolation at every sample, indices their values."""
    if value.shape is None:
        return
    prim, name = value.attribute.GetPrim(), value.attribute.GetName()
    if UsdGeom.Primvar.IsPrimvar(value.attribute):
        primvar = UsdGeom.Primvar(value.attribute)
        if primvar.IsIndexed() or str(primvar.GetTypeName()) not in SAFE_TYPES:
            return
        # A primvar may have samples alone, which are then its value at every time.
        if len(value.array) or value.time_code is not None or not primvar.GetAttr().GetNumTimeSamples():
            yield from _length(value, primvar, value.shape)
    elif name.startswith("primvars:") and name.endswith(":indices"):
        primvar = UsdGeom.Primvar(prim.GetAttribute(name.removesuffix(":indices")))
        if not (primvar and primvar.IsIndexed()):
            return
        if value.array.ndim != 1 or value.array.dtype.kind not in "iu":
            if value.array.size:
                yield Finding(20, "indices are no integers", value.path, value.time_code)
        elif len(value.array) or value.time_code is not None:
            yield from _length(value, primvar, value.shape)
            yield from _range(value, primvar)


def _length(value: Value, primvar: Any, shape: Shape) -> Iterator[Finding]:
    interpolation = primvar.GetInterpolation()
    expected = shape.lengths.get(interpolation, -1) * (1 if primvar.IsIndexed() else primvar.GetElementSize())
    if len(value.array) != expected:
        text = f"{len(value.array)} {interpolation} values, expected {expected}"
        yield Finding(20, text, str(primvar.GetAttr().GetPath()), value.time_code)


def _range(value: Value, primvar: Any) -> Iterator[Finding]:
    values = value_at(primvar.GetAttr(), 0.0 if value.time_code is None else value.time_code)
    count = len(values) // primvar.GetElementSize() if values.ndim else 1
    indices = value.array
    if len(indices) and not (indices.min() >= 0 and indices.max() < count):
        text = f"indices reach from {indices.min()} to {indices.max()}, but there are {count} values"
        yield Finding(20, text, value.path, value.time_code)
