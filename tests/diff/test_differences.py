from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade, Vt

from balloon_usd.diff import differences

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

MAIN = "/dog/geo/render/main"
AIR = "/capsule/geo/render/main_air"


@pytest.fixture
def other(written: Path) -> Usd.Stage:
    """The flat dog, which the layered one is compared with."""
    return Usd.Stage.Open(str(written / "dog.usdc"))


def copy_of(stage: Usd.Stage, folder: Path) -> Usd.Stage:
    stage.GetRootLayer().Export(str(folder / "copy.usdc"))
    return Usd.Stage.Open(str(folder / "copy.usdc"))


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
    copy = copy_of(other, tmp_path)
    nudge(copy, by)
    assert (list(differences(copy, other, tolerance=tolerance)) == []) is same


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda s: s.DefinePrim("/dog/geo/extra", "Scope"), "/dog/geo/extra: only in the first stage"),
        (lambda s: s.RemovePrim(f"{MAIN}/nose"), f"{MAIN}/nose: only in the second stage"),
        (lambda s: s.GetDefaultPrim().SetKind("group"), "/dog: kind: group and component"),
        (lambda s: s.SetFramesPerSecond(30), "framesPerSecond: 30 and 24"),
        (
            lambda s: s.GetPrimAtPath(MAIN).RemoveProperty("primvars:st"),
            "primvars:st: only in the second stage",
        ),
        (lambda s: UsdGeom.Mesh.Get(s, MAIN).GetPointsAttr().ClearAtTime(3), "times of the samples differ"),
        (
            lambda s: UsdGeom.Mesh.Get(s, MAIN).GetOrientationAttr().Set("leftHanded"),
            "orientation: leftHanded and rightHanded",
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
        (
            lambda s: setattr(s.GetRootLayer(), "customLayerData", {}),
            "customLayerData:balloon_usd:recipe: dog.yaml only in the second stage",
        ),
    ],
)
def test_a_difference_is_told_with_its_place(
    change: Callable[[Usd.Stage], object], told: str, other: Usd.Stage, tmp_path: Path
) -> None:
    copy = copy_of(other, tmp_path)
    assert list(differences(copy, other)) == []
    change(copy)
    assert told in "\n".join(differences(copy, other, tolerance=1e-6))


@pytest.fixture
def springs(aired: Path) -> Usd.Stage:
    """The flat capsule with air."""
    return Usd.Stage.Open(str(aired / "capsule.usdc"))


def changed_particle(stage: Usd.Stage, name: str, time: float, value: object) -> None:
    attribute = stage.GetPrimAtPath(AIR).GetAttribute(name)
    rows = np.array(attribute.Get(time))
    rows[3] = value
    attribute.Set(rows, time)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda s: changed_particle(s, "points", 3, 0.5), "points: differ by up to 0.5"),
        (
            lambda s: changed_particle(s, "primvars:cluster", 5, 1),
            "primvars:cluster: 1 of 24 values differ at 5",
        ),
        (
            lambda s: changed_particle(s, "primvars:displayColor", 5, 0.9),
            "displayColor: differ by up to",
        ),
        (lambda s: UsdGeom.Points.Get(s, AIR).CreateIdsAttr(range(1, 25)), "ids: 24 of 24 values differ"),
        (lambda s: UsdGeom.Points.Get(s, AIR).CreateWidthsAttr([0.5]), "widths: "),
        (
            lambda s: UsdGeom.Points.Get(s, AIR).SetWidthsInterpolation("constant"),
            "interpolation is constant and vertex",
        ),
        (lambda s: UsdGeom.Points.Get(s, AIR).MakeInvisible(), "visibility: invisible and inherited"),
        (
            lambda s: s.GetAttributeAtPath("/capsule/mtl/wire/texture.inputs:file").Set("./net.png"),
            "inputs:file: values differ",
        ),
    ],
)
def test_particles_are_compared_too(
    change: Callable[[Usd.Stage], object], told: str, springs: Usd.Stage, tmp_path: Path
) -> None:
    copy = copy_of(springs, tmp_path)
    # The copy lies in another folder: the texture's name counts, not its place.
    assert list(differences(copy, springs)) == []
    change(copy)
    assert told in "\n".join(differences(copy, springs, tolerance=1e-6))


def test_another_look_is_a_difference(springs: Usd.Stage, aired: Path) -> None:
    other = Usd.Stage.Open(str(aired / "capsule" / "capsule.usda"))
    other.SetEditTarget(other.GetSessionLayer())
    assert list(differences(springs, other)) == []
    other.GetDefaultPrim().GetVariantSet("look").SetVariantSelection("recipe")
    (told,) = (text for text in differences(springs, other) if "material:binding" in text)
    assert told == (
        "/capsule/geo/render/main.material:binding: targets differ: /capsule/mtl/wire and /capsule/mtl/latex_red"
    )
    other.GetSessionLayer().Clear()
