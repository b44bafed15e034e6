"""What does not move: the meshes' topology, texture coordinates, bubbles, the air, and a resting pose."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, UsdGeom, Vt
from balloon_usd.stage.air import author_air
from balloon_usd.stage.animated import BUBBLES, ON_MESH, ON_ROOT
from balloon_usd.stage.looks import author_within_quad
from balloon_usd.stage.prim_paths import part_path, parts_path, root_path

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import MeshDescription, StageDescription
    from balloon_usd.stage.pose import MeshPose, Pose

FAMILY = "bubbles"
"""Family of the face subsets, one a bubble."""


def author_geometry(stage: Any, description: StageDescription, final: Pose) -> None:
    """Author the meshes and the air; their default is the final pose, which is what still viewers show."""
    root = UsdGeom.Xform.Define(stage, root_path(description.name)).GetPrim()
    scope = parts_path(description.name)
    UsdGeom.Scope.Define(stage, scope.GetParentPath())
    UsdGeom.Scope.Define(stage, scope)
    for mesh, pose in zip(description.meshes, final.meshes, strict=True):
        usd_mesh = UsdGeom.Mesh.Define(stage, part_path(description.name, mesh.name))
        _author_topology(usd_mesh, mesh)
        _author_pose(usd_mesh.GetPrim(), pose)
        _author_primvars(usd_mesh.GetPrim(), mesh, description.bubbles_of(mesh))
        _author_subsets(usd_mesh, description.bubble_names, description.bubbles_of(mesh))
        if description.airs:
            author_within_quad(usd_mesh.GetPrim(), len(mesh.quads))
    for air, air_pose in zip(description.airs, final.airs, strict=True):
        author_air(stage, part_path(description.name, air.name), air, air_pose)
    names = root.CreateAttribute(BUBBLES, Sdf.ValueTypeNames.TokenArray, custom=True)
    names.SetDocumentation("Names of all bubbles, of all balloons, along each from its knot on.")
    names.Set(Vt.TokenArray(description.bubble_names))
    for moving in ON_ROOT:
        attribute = root.CreateAttribute(moving.name, moving.type_name, custom=True)
        attribute.SetDocumentation(moving.documentation)
        attribute.Set(moving.read(final))


def _author_topology(usd_mesh: Any, mesh: MeshDescription) -> None:
    counts = np.full(len(mesh.quads), 4, dtype=np.int32)
    usd_mesh.CreateFaceVertexCountsAttr(_integers(counts))
    usd_mesh.CreateFaceVertexIndicesAttr(_integers(mesh.quads.ravel()))
    usd_mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.catmullClark)
    usd_mesh.CreateInterpolateBoundaryAttr(UsdGeom.Tokens.edgeAndCorner)
    usd_mesh.CreateOrientationAttr(UsdGeom.Tokens.rightHanded)


def _author_pose(prim: Any, pose: MeshPose) -> None:
    for moving in ON_MESH:
        attribute = prim.CreateAttribute(moving.name, moving.type_name, custom=False)
        if moving.documentation:
            attribute.SetDocumentation(moving.documentation)
        attribute.Set(moving.read(pose))
        if UsdGeom.Primvar.IsPrimvar(attribute):
            UsdGeom.Primvar(attribute).SetInterpolation(UsdGeom.Tokens.vertex)


def _author_primvars(prim: Any, mesh: MeshDescription, bubbles: NDArray[np.int32]) -> None:
    primvars = UsdGeom.PrimvarsAPI(prim)
    corners = np.ascontiguousarray(mesh.st.reshape(-1, 2), dtype=np.float32)
    for name, type_name, interpolation, value in (
        ("bubble", Sdf.ValueTypeNames.IntArray, UsdGeom.Tokens.uniform, _integers(bubbles)),
        (
            "st",
            Sdf.ValueTypeNames.TexCoord2fArray,
            UsdGeom.Tokens.faceVarying,
            Vt.Vec2fArray.FromNumpy(corners),
        ),
    ):
        primvar = primvars.CreatePrimvar(name, type_name, interpolation)
        primvar.Set(value)
        if name == "bubble":
            primvar.GetAttr().SetDocumentation(f"Bubble of each face, counted in {BUBBLES}.")


def _author_subsets(usd_mesh: Any, names: tuple[str, ...], bubbles: NDArray[np.int32]) -> None:
    for bubble in np.unique(bubbles):
        faces = np.flatnonzero(bubbles == bubble)
        UsdGeom.Subset.CreateGeomSubset(
            usd_mesh, names[bubble], UsdGeom.Tokens.face, _integers(faces), FAMILY, UsdGeom.Tokens.partition
        )


def _integers(values: NDArray[np.integer[Any]]) -> Any:
    return Vt.IntArray.FromNumpy(np.ascontiguousarray(values, dtype=np.int32))
