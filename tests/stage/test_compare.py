from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade, Vt

from balloon_usd.stage import differences

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

MAIN = "/dog/geo/render/main"


@pytest.fixture
def other(written: Path) -> Usd.Stage:
    """The flat dog, which the layered one is compared with."""
    return Usd.Stage.Open(str(written / "dog.usdc"))


def nudge(stage: Usd.Stage, by: float) -> None:
    points = UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr()
    moved = np.array(points.Get(3)) + np.float32(by)
    points.Set(Vt.Vec3fArray.FromNumpy(moved), 3)


@pytest.mark.parametrize(
    ("by", "tolerance", "same"), [(3e-7, 1e-6, True), (1e-5, 1e-6, False), (3e-7, 0.0, False)]
)
def test_points_are_compared_within_the_tolerance(
    by: float, tolerance: float, same: bool, other: Usd.Stage, tmp_path: Path
) -> None:
    other.GetRootLayer().Export(str(tmp_path / "copy.usdc"))
    copy = Usd.Stage.Open(str(tmp_path / "copy.usdc"))
    nudge(copy, by)
    assert (list(differences(copy, other, tolerance=tolerance)) == []) is same


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda s: s.DefinePrim("/dog/geo/extra", "Scope"), "/dog/geo/extra: only in the first stage"),
        (lambda s: s.RemovePrim(f"{MAIN}/nose"), f"{MAIN}/nose: only in the second stage"),
        (lambda s: s.GetDefaultPrim().SetKind("group"), "/dog: "),
        (lambda s: s.SetFramesPerSecond(30), "framesPerSecond: 30.0 and 24.0"),
        (
            lambda s: s.GetPrimAtPath(MAIN).RemoveProperty("primvars:st"),
            "primvars:st: only in the second stage",
        ),
        (lambda s: UsdGeom.Mesh.Get(s, MAIN).GetPointsAttr().ClearAtTime(3), "times of the samples differ"),
        (
            lambda s: UsdGeom.Mesh.Get(s, MAIN).GetOrientationAttr().Set("leftHanded"),
            "orientation: values differ",
        ),
        (
            lambda s: (
                UsdGeom.PrimvarsAPI(s.GetPrimAtPath(MAIN)).GetPrimvar("bubble").SetInterpolation("constant")
            ),
            "interpolation is constant and uniform",
        ),
        (
            lambda s: UsdShade.MaterialBindingAPI(s.GetPrimAtPath(MAIN)).UnbindDirectBinding(),
            "targets differ",
        ),
        (
            lambda s: s.GetAttributeAtPath("/dog/mtl/latex_main.outputs:surface").ClearConnections(),
            "connections differ",
        ),
        (lambda s: setattr(s.GetRootLayer(), "customLayerData", {}), "provenance: "),
    ],
)
def test_a_difference_is_told_with_its_place(
    change: Callable[[Usd.Stage], object], told: str, other: Usd.Stage, tmp_path: Path
) -> None:
    other.GetRootLayer().Export(str(tmp_path / "copy.usdc"))
    copy = Usd.Stage.Open(str(tmp_path / "copy.usdc"))
    assert list(differences(copy, other)) == []
    change(copy)
    assert told in "\n".join(differences(copy, other, tolerance=1e-6))
