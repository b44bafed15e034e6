"""The air of a balloon as points: who the particles are, how large, and where they rest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom, Vt
from balloon_usd.stage.animated import BY_CLUSTER, ON_AIR

if TYPE_CHECKING:
    from balloon_usd.stage.description import AirDescription
    from balloon_usd.stage.pose import AirPose


def author_air(stage: Any, path: Any, air: AirDescription, pose: AirPose) -> None:
    """Author the particles at a path; their default is the pose."""
    cloud = UsdGeom.Points.Define(stage, path)
    cloud.CreateIdsAttr(Vt.Int64Array.FromNumpy(np.arange(air.count, dtype=np.int64)))
    # One width for all is allowed, but USD's own extents want one a point.
    cloud.CreateWidthsAttr(Vt.FloatArray(air.count, air.width))
    cloud.SetWidthsInterpolation(UsdGeom.Tokens.vertex)
    for moving in ON_AIR:
        cloud.GetPrim().CreateAttribute(moving.name, moving.type_name, custom=False).Set(moving.read(pose))
    primvars = UsdGeom.PrimvarsAPI(cloud)
    for by_cluster in BY_CLUSTER:
        name = UsdGeom.Primvar.StripPrimvarsName(by_cluster.name)
        primvar = primvars.CreatePrimvar(name, by_cluster.type_name, UsdGeom.Tokens.vertex)
        primvar.Set(by_cluster.read(pose.cluster))
