"""Properties 21 to 23 and 25: bubbles, materials and what stands below what."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom, UsdShade
from balloon_usd.stage.geometry import FAMILY
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import (
    clouds_of,
    first_value,
    meshes_of,
    mistyped,
    prims_of,
    samples_of,
    sculpted,
)
from balloon_usd.stage.properties.shape import lengths_of_cloud
from balloon_usd.stage.shaders import PREVIEW_SURFACE

if TYPE_CHECKING:
    from collections.abc import Iterator


def bubbles_partition(stage: Any) -> Iterator[Finding]:
    """Property 21: bubble subsets partition the faces; bound ones, of family materialBind, cover a mesh
    without a material.
    """
    for mesh in sculpted(stage, meshes_of(stage)):
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
    told: set[str] = set()
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        path = str(shape.GetPath())
        if shape.ComputeVisibility() == UsdGeom.Tokens.invisible:
            continue
        drawn = _bound_subsets(shape) if _covered_by_subsets(shape) else [shape]
        for bound in drawn:
            material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
            if not material:
                yield Finding(22, "no material", path, remedy="bind a material of the asset")
                continue
            if not bound.GetPrim().HasAPI(UsdShade.MaterialBindingAPI):
                remedy = "apply the schema MaterialBindingAPI to the prim"
                yield Finding(22, "MaterialBindingAPI is not applied", str(bound.GetPath()), remedy=remedy)
            if root and not material.GetPath().HasPrefix(root.GetPath()):
                text = f"material {material.GetPath()} is outside the asset"
                yield Finding(22, text, path, remedy="move the material below the root prim")
            if str(material.GetPath()) not in told:
                told.add(str(material.GetPath()))
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


def _width_faults(cloud: Any) -> Iterator[Finding]:
    count = len(first_value(cloud.GetPointsAttr()))
    expected = lengths_of_cloud(count).get(cloud.GetWidthsInterpolation(), -1)
    for time, widths in samples_of(cloud.GetWidthsAttr()):
        if len(widths) != expected:
            yield Finding(23, f"{len(widths)} widths, expected {expected}", str(cloud.GetPath()), time)
        if (widths <= 0.0).any():
            yield Finding(23, "widths are not above 0", str(cloud.GetPath()), time)


def _id_faults(cloud: Any) -> Iterator[Finding]:
    expected = len(first_value(cloud.GetPointsAttr()))
    for time, ids in samples_of(cloud.GetIdsAttr()):
        if len(ids) != expected:
            yield Finding(23, f"{len(ids)} ids, expected {expected}", str(cloud.GetPath()), time)
        if len(np.unique(ids)) != len(ids):
            yield Finding(23, "ids are not unique", str(cloud.GetPath()), time)


def _bound_subsets(shape: Any) -> list[Any]:
    """Face subsets that have a material of their own."""
    if not isinstance(shape, UsdGeom.Mesh):
        return []
    subsets = [s for s in UsdGeom.Subset.GetAllGeomSubsets(shape) if not any(mistyped(s.GetPrim()))]
    return [s for s in subsets if UsdShade.MaterialBindingAPI(s).GetDirectBinding().GetMaterial()]


def _covered_by_subsets(shape: Any) -> bool:
    covered = {
        face for subset in _bound_subsets(shape) for face in first_value(subset.GetIndicesAttr()).tolist()
    }
    return bool(covered) and len(covered) == len(first_value(shape.GetFaceVertexCountsAttr()))


def _bound_subset_faults(mesh: Any) -> Iterator[Finding]:
    bound = _bound_subsets(mesh)
    for subset in bound:
        if subset.GetFamilyNameAttr().Get() != UsdShade.Tokens.materialBind:
            yield Finding(21, "a bound subset outside family materialBind", str(subset.GetPath()))
    # Faces of no subset show the material of the mesh.
    own, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    if bound and not own and not _covered_by_subsets(mesh):
        yield Finding(21, "bound subsets do not cover the mesh", str(mesh.GetPath()))


def _preview_faults(material: Any) -> Iterator[str]:
    shader, _, _ = material.ComputeSurfaceSource()
    if not shader or shader.GetShaderId() != PREVIEW_SURFACE:
        yield "no UsdPreviewSurface"
        return
    for color_input in shader.GetInputs():
        if color_input.GetTypeName().cppTypeName != "GfVec3f" or "Color" not in color_input.GetBaseName():
            continue
        value = color_input.Get()
        if value is not None and not all(0.0 <= channel <= 1.0 for channel in value):
            yield f"{color_input.GetBaseName()} is {tuple(value)}, expected 0..1"
