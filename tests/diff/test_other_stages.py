"""Stages of other software: any prim, any arc, instances, curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import warp as wp
import warp.render
from pxr import Gf, Usd, UsdGeom

from balloon_usd.diff import Comparison, compare_files


def told(found: Comparison) -> list[str]:
    return [str(difference) for difference in found.differences]


def rendered(file: Path, lift: float) -> Path:
    """A mesh, points and a moving ball, as Warp's own renderer writes them."""
    renderer = warp.render.UsdRenderer(str(file), fps=30)
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=np.float32)
    faces = np.array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
    for frame in range(4):
        renderer.begin_frame(frame / 30.0)
        up = np.float32(0.1 * frame + (lift if frame == 2 else 0.0))
        renderer.render_mesh("tent", corners + np.array([0, up, 0], np.float32), faces)
        renderer.render_points("dust", corners * (1 + up), radius=0.01)
        renderer.render_sphere("ball", (0.0, float(up), 0.0), wp.quat_identity(), 0.2)
        renderer.end_frame()
    renderer.save()
    return file


def test_stages_of_warps_renderer_are_compared(tmp_path: Path) -> None:
    one, same, other = (
        rendered(tmp_path / f"{name}.usda", lift) for name, lift in (("a", 0.0), ("b", 0.0), ("c", 0.01))
    )
    assert told(compare_files(one, same)) == []
    found = told(compare_files(one, other))
    (tent,) = (text for text in found if "tent moved" in text)
    assert "tent moved 0.1 mm at 2 (" in tent, "its units are centimetres"
    assert any("dust" in text for text in found)
    assert any("ball" in text for text in found)


def crowd(file: Path, *, radius: float = 1.0, shift: float = 0.0) -> Path:
    """A hundred instances of one curve and one mesh, of which one stands a little aside."""
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, "Z")
    source = stage.CreateClassPrim("/source")
    mesh = UsdGeom.Mesh.Define(stage, source.GetPath().AppendChild("sail"))
    mesh.CreatePointsAttr([(0, 0, 0), (radius, 0, 0), (0, radius, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    curve = UsdGeom.BasisCurves.Define(stage, source.GetPath().AppendChild("rope"))
    curve.CreatePointsAttr([(0, 0, 0), (0, 0, radius)])
    curve.CreateCurveVertexCountsAttr([2])
    for number in range(100):
        prim = UsdGeom.Xform.Define(stage, f"/crowd/boat_{number:02}")
        prim.AddTranslateOp().Set(Gf.Vec3d(number + (shift if number == 7 else 0.0), 0, 0))
        prim.GetPrim().GetReferences().AddInternalReference("/source")
        prim.GetPrim().SetInstanceable(True)
    stage.GetRootLayer().Save()
    return file


def test_what_differs_in_a_hundred_instances_is_told_once(tmp_path: Path) -> None:
    found = told(compare_files(crowd(tmp_path / "a.usda"), crowd(tmp_path / "b.usda", radius=1.5)))
    assert [text for text in found if "boat_01" in text and "sail" in text] == []
    assert "/crowd/boat_00/sail: sail moved 500 mm (largest, vertex 1), rms 408 mm" in found
    assert "/crowd/boat_00/rope: rope moved 500 mm (largest, vertex 1), rms 354 mm" in found
    assert found[-1] == (
        "/crowd/boat_00: the same in 99 more instances: /crowd/boat_01, /crowd/boat_02, /crowd/boat_03, ..."
    )


def test_an_instance_that_stands_elsewhere_is_told_with_its_distance(tmp_path: Path) -> None:
    found = told(compare_files(crowd(tmp_path / "a.usda"), crowd(tmp_path / "b.usda", shift=0.02)))
    assert found == [
        "/crowd/boat_07.xformOp:translate: differ by up to 0.02",
        "/crowd/boat_07/sail: sail moved 20 mm (largest, vertex 0), rms 20 mm",
        "/crowd/boat_07/rope: rope moved 20 mm (largest, vertex 0), rms 20 mm",
    ]


def test_a_prim_of_another_kind_is_a_difference(tmp_path: Path) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    files[0].write_text("#usda 1.0\ndef Xform 'a' (kind = 'group')\n{\n rel r = </a>\n}\n")
    files[1].write_text("#usda 1.0\nover 'a' (active = false)\n{\n float r = 1\n}\n")
    assert told(compare_files(*files)) == [
        "/a: active: False only in the second stage",
        "/a: kind: group only in the first stage",
        "/a: specifier: def and over",
        "/a: typeName: Xform only in the first stage",
        "/a.r: an attribute in one stage, a relationship in the other",
    ]


@pytest.mark.parametrize("samples", ["1: 0, 2: 1, 3: 2", "1: 0, 2: 1, 4: 2", "1: 0"])
def test_other_times_of_samples_are_a_difference_and_those_in_common_are_compared(
    samples: str, tmp_path: Path
) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    for file, given in zip(files, ("1: 0, 2: 5, 3: 2", samples), strict=True):
        lines = ",\n".join(given.split(", "))
        file.write_text(f"#usda 1.0\ndef 'a'\n{{\n double x.timeSamples = {{\n{lines}\n}}\n}}\n")
    found = told(compare_files(*files))
    expected = {
        "1: 0, 2: 1, 3: 2": ["/a.x: 5 and 1 at 2; at 1 of 3 time codes"],
        "1: 0, 2: 1, 4: 2": [
            "/a.x: times of the samples differ: 3 and 3 samples, 3 only in the first stage",
            "/a.x: 5 and 1 at 2; at 1 of 2 time codes",
        ],
        "1: 0": ["/a.x: times of the samples differ: 3 and 1 samples, 2 only in the first stage"],
    }
    assert found == expected[samples]
