"""Properties 20 to 23 and 25: primvars, bubbles, materials and what stands below what."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom, UsdShade

from balloon_usd.stage.geometry import FAMILY
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import clouds_of, first_value, meshes_of, prims_of, samples_of

if TYPE_CHECKING:
    from collections.abc import Iterator

SAFE_TYPES = frozenset({"color3f[]", "float2[]", "float3[]", "float[]", "int[]", "point3f[]", "texCoord2f[]"})
"""Primvar types that arrive in DCC tools; half, double, matrix, string and scalars get lost."""


def primvars_fit(stage: Any) -> Iterator[Finding]:
    """Property 20: primvar lengths fit their interpolation at every sample; DCC-safe types only."""
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        lengths = _lengths(shape) if isinstance(shape, UsdGeom.Mesh) else _cloud_lengths(shape)
        for primvar in UsdGeom.PrimvarsAPI(shape).GetAuthoredPrimvars():
            path = str(primvar.GetAttr().GetPath())
            if str(primvar.GetTypeName()) not in SAFE_TYPES:
                yield Finding(20, f"type {primvar.GetTypeName()} gets lost in DCC tools", path)
                continue
            expected = lengths.get(primvar.GetInterpolation(), -1) * primvar.GetElementSize()
            counted = primvar.GetIndicesAttr() if primvar.IsIndexed() else primvar.GetAttr()
            for time, values in samples_of(counted):
                if len(values) != expected:
                    text = f"{len(values)} {primvar.GetInterpolation()} values, expected {expected}"
                    yield Finding(20, text, path, time)


def bubbles_partition(stage: Any) -> Iterator[Finding]:
    """Property 21: bubble subsets partition the faces; bound subsets cover the mesh, family materialBind."""
    for mesh in meshes_of(stage):
        path = str(mesh.GetPath())
        if not UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, FAMILY):
            yield Finding(21, f'no subsets of family "{FAMILY}"', path)
        elif UsdGeom.Subset.GetFamilyType(mesh, FAMILY) != UsdGeom.Tokens.partition:
            yield Finding(21, f'family "{FAMILY}" is no partition', path)
        for family in UsdGeom.Subset.GetAllGeomSubsetFamilyNames(mesh):
            valid, why = UsdGeom.Subset.ValidateFamily(mesh, UsdGeom.Tokens.face, family)
            if not valid:
                yield Finding(21, " ".join(why.split()), path)
        yield from _bound_subset_faults(mesh)


def materials_bound(stage: Any) -> Iterator[Finding]:
    """Property 22: all that is visible has one material inside the asset, with a preview surface in 0..1."""
    root = stage.GetDefaultPrim()
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        path = str(shape.GetPath())
        if shape.ComputeVisibility() == UsdGeom.Tokens.invisible:
            continue
        material, _ = UsdShade.MaterialBindingAPI(shape).ComputeBoundMaterial()
        if not material:
            yield Finding(22, "no material", path)
            continue
        if not shape.GetPrim().HasAPI(UsdShade.MaterialBindingAPI):
            yield Finding(22, "MaterialBindingAPI is not applied", path)
        if root and not material.GetPath().HasPrefix(root.GetPath()):
            yield Finding(22, f"material {material.GetPath()} is outside the asset", path)
        for text in _preview_faults(material):
            yield Finding(22, text, str(material.GetPath()))


def points_and_nesting(stage: Any) -> Iterator[Finding]:
    """Property 23: point widths above 0, ids unique, as many as needed; no gprim below a gprim."""
    for cloud in clouds_of(stage):
        yield from _width_faults(cloud)
        yield from _id_faults(cloud)
    for gprim in prims_of(stage, UsdGeom.Gprim):
        parent = gprim.GetPrim().GetParent()
        while parent:
            if parent.IsA(UsdGeom.Gprim):
                yield Finding(23, f"below the gprim {parent.GetPath()}", str(gprim.GetPath()))
            parent = parent.GetParent()


def color_and_sides_authored(stage: Any) -> Iterator[Finding]:
    """Property 25: displayColor and doubleSided are authored."""
    for mesh in meshes_of(stage):
        for attribute in (mesh.GetDisplayColorAttr(), mesh.GetDoubleSidedAttr()):
            if not attribute.HasAuthoredValue():
                yield Finding(25, f"{attribute.GetName()} is not authored", str(mesh.GetPath()))
    for cloud in clouds_of(stage):
        if not cloud.GetDisplayColorAttr().HasAuthoredValue():
            yield Finding(25, "primvars:displayColor is not authored", str(cloud.GetPath()))


def _lengths(mesh: Any) -> dict[str, int]:
    """Number of elements of each interpolation."""
    counts = first_value(mesh.GetFaceVertexCountsAttr())
    points = len(first_value(mesh.GetPointsAttr()))
    return {
        "constant": 1,
        "uniform": len(counts),
        "varying": points,
        "vertex": points,
        "faceVarying": int(counts.sum()),
    }


def _cloud_lengths(cloud: Any) -> dict[str, int]:
    """Number of elements of each interpolation."""
    points = len(first_value(cloud.GetPointsAttr()))
    return {"constant": 1, "uniform": 1, "varying": points, "vertex": points, "faceVarying": points}


def _width_faults(cloud: Any) -> Iterator[Finding]:
    expected = _cloud_lengths(cloud).get(cloud.GetWidthsInterpolation(), -1)
    for time, widths in samples_of(cloud.GetWidthsAttr()):
        if len(widths) != expected:
            yield Finding(23, f"{len(widths)} widths, expected {expected}", str(cloud.GetPath()), time)
        if (widths <= 0.0).any():
            yield Finding(23, "widths are not above 0", str(cloud.GetPath()), time)


def _id_faults(cloud: Any) -> Iterator[Finding]:
    expected = _cloud_lengths(cloud)["vertex"]
    for time, ids in samples_of(cloud.GetIdsAttr()):
        if len(ids) != expected:
            yield Finding(23, f"{len(ids)} ids, expected {expected}", str(cloud.GetPath()), time)
        if len(np.unique(ids)) != len(ids):
            yield Finding(23, "ids are not unique", str(cloud.GetPath()), time)


def _bound_subset_faults(mesh: Any) -> Iterator[Finding]:
    path = str(mesh.GetPath())
    covered: set[int] = set()
    bound = False
    for subset in UsdGeom.Subset.GetAllGeomSubsets(mesh):
        if not UsdShade.MaterialBindingAPI(subset).GetDirectBinding().GetMaterial():
            continue
        bound = True
        covered.update(first_value(subset.GetIndicesAttr()).tolist())
        if subset.GetFamilyNameAttr().Get() != UsdShade.Tokens.materialBind:
            yield Finding(21, "a bound subset outside family materialBind", str(subset.GetPath()))
    if bound and len(covered) != len(first_value(mesh.GetFaceVertexCountsAttr())):
        yield Finding(21, "bound subsets do not cover the mesh", path)


def _preview_faults(material: Any) -> Iterator[str]:
    shader, _, _ = material.ComputeSurfaceSource()
    if not shader or shader.GetShaderId() != "UsdPreviewSurface":
        yield "no UsdPreviewSurface"
        return
    for color_input in shader.GetInputs():
        if color_input.GetTypeName().cppTypeName != "GfVec3f" or "Color" not in color_input.GetBaseName():
            continue
        value = color_input.Get()
        if value is not None and not all(0.0 <= channel <= 1.0 for channel in value):
            yield f"{color_input.GetBaseName()} is {tuple(value)}, expected 0..1"
