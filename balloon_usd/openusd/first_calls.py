"""The first calls of OpenUSD, which make what there is once in a process."""

from __future__ import annotations

from pxr import Ar, Plug, Sdf, Usd, UsdGeom


def make_first_calls() -> None:
    """Find the plugins, and make the resolver of paths, the formats of files, and the schemas of prims."""
    Plug.Registry().GetAllPlugins()
    Ar.GetResolver()
    for ending in (".usda", ".usdc"):
        Usd.Stage.Open(Sdf.Layer.CreateAnonymous(ending))
    UsdGeom.Mesh.Define(Usd.Stage.CreateInMemory(), "/mesh")
