from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdShade, UsdUtils

from balloon_usd.stage import write_stage
from tests.stage.selections import complaints
from tests.stage.tubes import Frame, frames, sculpture


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("shot")
    written = write_stage(sculpture(), frames(12), folder, shot=True)
    assert written.files[-1] == folder / "dog_shot.usda"
    return folder


@pytest.fixture
def shot(folder: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(folder / "dog_shot.usda"))


def points_of(stage: Usd.Stage, path: str, time: float) -> NDArray[np.float64]:
    """World positions (V, 3) of a mesh."""
    mesh = UsdGeom.Mesh.Get(stage, path)
    local = np.asarray(mesh.GetPointsAttr().Get(time), dtype=np.float64)
    to_world = np.array(mesh.ComputeLocalToWorldTransform(time))
    return (np.concatenate([local, np.ones((len(local), 1))], axis=1) @ to_world)[:, :3]


def on_picture(stage: Usd.Stage, points: NDArray[np.float64], camera: str = "camera") -> NDArray[np.float64]:
    """Places (N, 2) on the picture of a camera, -1..1 inside it."""
    frustum = UsdGeom.Camera.Get(stage, f"/shot/{camera}").GetCamera(1).frustum
    matrix = np.array(frustum.ComputeViewMatrix() * frustum.ComputeProjectionMatrix())
    clip = np.concatenate([points, np.ones((len(points), 1))], axis=1) @ matrix
    assert (clip[:, 3] > 0.0).all()
    return clip[:, :2] / clip[:, 3:]


def test_a_shot_opens_whole_with_the_rates_and_range_of_the_stage(shot: Usd.Stage) -> None:
    assert shot.GetCompositionErrors() == []
    assert (shot.GetStartTimeCode(), shot.GetEndTimeCode()) == (1, 12)
    assert shot.GetTimeCodesPerSecond() == shot.GetFramesPerSecond() == 24
    assert (UsdGeom.GetStageUpAxis(shot), UsdGeom.GetStageMetersPerUnit(shot)) == ("Z", 1.0)
    root = shot.GetDefaultPrim()
    assert (root.GetPath(), Usd.ModelAPI(root).GetKind()) == ("/shot", "assembly")
    assert Usd.ModelAPI(shot.GetPrimAtPath("/shot/sculpture")).GetKind() == "component"


def test_the_validators_of_usd_have_nothing_to_say(shot: Usd.Stage) -> None:
    assert complaints(shot) == []


def test_asset_and_shot_can_be_moved_together(folder: Path, tmp_path: Path) -> None:
    shutil.copytree(folder, tmp_path / "elsewhere")
    _, _, unresolved = UsdUtils.ComputeAllDependencies(str(tmp_path / "elsewhere" / "dog_shot.usda"))
    assert unresolved == []
    layer = (tmp_path / "elsewhere" / "dog_shot.usda").read_text()
    assert "references = @./dog/dog.usda@" in layer


def test_the_camera_sees_the_sculpture_at_every_time_code_and_fills_its_picture(shot: Usd.Stage) -> None:
    places = np.concatenate(
        [
            on_picture(shot, points_of(shot, f"/shot/sculpture/geo/render/{name}", time))
            for name in ("main", "second")
            for time in range(1, 13)
        ]
    )
    assert np.abs(places).max() < 1.0
    assert np.abs(places).max() > 0.75


def test_another_camera_is_near_to_the_finished_sculpture(tmp_path: Path) -> None:
    """A sculpture that gets smaller while it is made, as they do."""

    def shrinking() -> Iterator[Frame]:
        for frame in frames(4):
            size = np.float32([1.0, 0.8, 0.5, 0.3][frame.time_code - 1])
            yield replace(frame, points=tuple(points * size for points in frame.points))

    write_stage(sculpture(), shrinking(), tmp_path, shot=True)
    shot = Usd.Stage.Open(str(tmp_path / "dog_shot.usda"))
    final = np.concatenate(
        [points_of(shot, f"/shot/sculpture/geo/render/{name}", 4) for name in ("main", "second")]
    )
    from_far, from_near = (
        np.ptp(on_picture(shot, final, name), axis=0).max() for name in ("camera", "camera_finished")
    )
    assert from_near > 1.5
    assert from_far < 0.5 * from_near
    assert np.abs(on_picture(shot, final, "camera_finished")).max() < 1.0


def test_the_camera_sees_the_ground_all_over_its_picture(shot: Usd.Stage) -> None:
    """Rays through the corners of the picture meet the floor or the wall behind."""
    camera = UsdGeom.Camera.Get(shot, "/shot/camera").GetCamera(1)
    ground = points_of(shot, "/shot/ground", 1).reshape(-1, 2, 3)
    for corner in ((-1, -1), (1, -1), (-1, 1), (1, 1), (0, 0)):
        ray = Gf.Ray(camera.frustum.position, _towards(camera, corner))
        hits = [
            ray.Intersect(Gf.Vec3d(*a.tolist()), Gf.Vec3d(*b.tolist()), Gf.Vec3d(*c.tolist()))[0]
            for (a, b), (d, c) in zip(ground[:-1], ground[1:], strict=True)
            for a, b, c in ((a, b, c), (a, c, d))
        ]
        assert any(hits), corner


def _towards(camera: Gf.Camera, corner: tuple[float, float]) -> Gf.Vec3d:
    window = camera.frustum.window
    across = window.GetMin()[0] + 0.5 * (corner[0] + 1) * window.GetSize()[0]
    height = window.GetMin()[1] + 0.5 * (corner[1] + 1) * window.GetSize()[1]
    return camera.transform.TransformDir(Gf.Vec3d(across, height, -1.0))


def test_lamps_look_at_the_sculpture_and_stand_outside_of_the_picture(shot: Usd.Stage) -> None:
    middle = np.mean(
        [points_of(shot, f"/shot/sculpture/geo/render/{n}", 1).mean(axis=0) for n in ("main", "second")],
        axis=0,
    )
    lamps = [UsdLux.RectLight(prim) for prim in shot.Traverse() if prim.IsA(UsdLux.RectLight)]
    assert len(lamps) == 3
    for lamp in lamps:
        stand = UsdGeom.Xformable(lamp).ComputeLocalToWorldTransform(1)
        place, shines = np.array(stand.ExtractTranslation()), np.array(stand.TransformDir((0, 0, -1)))
        towards = (middle - place) / np.linalg.norm(middle - place)
        assert float(shines @ towards) > 0.98
        assert np.abs(on_picture(shot, place[None])).max() > 1.0
        assert 0.5 <= lamp.GetIntensityAttr().Get() <= 10.0
    assert [str(prim.GetPath()) for prim in shot.Traverse() if prim.IsA(UsdLux.DomeLight)] == [
        "/shot/lights/sky"
    ]


def test_the_ground_lies_below_the_sculpture_and_has_a_material(shot: Usd.Stage) -> None:
    lowest = min(
        points_of(shot, "/shot/sculpture/geo/render/main", time)[:, 2].min() for time in range(1, 13)
    )
    ground = points_of(shot, "/shot/ground", 1)
    assert 0.0 < lowest - ground[:, 2].min() < 1e-3
    normals = np.asarray(UsdGeom.Mesh.Get(shot, "/shot/ground").GetNormalsAttr().Get())
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)
    quads = ground[
        np.asarray(UsdGeom.Mesh.Get(shot, "/shot/ground").GetFaceVertexIndicesAttr().Get()).reshape(-1, 4)
    ]
    wound = np.cross(quads[:, 1] - quads[:, 0], quads[:, 3] - quads[:, 0])
    assert (wound[:, 2] > -1e-9).all()
    assert wound[0, 2] > 0.0
    assert UsdShade.MaterialBindingAPI(shot.GetPrimAtPath("/shot/ground")).ComputeBoundMaterial()[0]


def lowest(stage: Usd.Stage) -> NDArray[np.float64]:
    """Height of the lowest point of the sculpture at every time code."""
    meshes = ["/shot/sculpture/geo/render/main"]
    heights = [[points_of(stage, mesh, time)[:, 2].min() for mesh in meshes] for time in range(1, 31)]
    return np.array(heights).min(axis=1)


def test_what_lands_is_held_above_the_ground_while_it_is_made_and_set_down_gently(tmp_path: Path) -> None:
    fallen = [
        replace(frame, points=tuple(_raised(each, frame) for each in frame.points)) for frame in frames(30)
    ]
    write_stage(replace(sculpture(), lands=True), fallen, tmp_path, shot=True)
    shot = Usd.Stage.Open(str(tmp_path / "dog_shot.usda"))
    heights, ground = lowest(shot), points_of(shot, "/shot/ground", 1)[:, 2].min()
    assert ground == pytest.approx(0.0, abs=2e-4)
    assert heights.min() > -1e-5
    assert heights[0] == pytest.approx(0.0, abs=1e-5)
    assert heights[-1] == pytest.approx(0.0, abs=1e-5)
    assert np.abs(np.diff(heights)).max() < 0.01


def test_what_does_not_land_is_not_moved(shot: Usd.Stage) -> None:
    assert UsdGeom.Xformable.Get(shot, "/shot/sculpture").GetOrderedXformOps() == []


def _raised(points: NDArray[np.float32], frame: Frame) -> NDArray[np.float32]:
    """Points, (V, 3), of a figure that is made 3 cm deep in the ground, and lies on it from frame 18 on."""
    moved = points.copy()
    moved[:, 2] += -0.03 * min(max((18 - frame.time_code) / 8.0, 0.0), 1.0) - points[:, 2].min()
    return moved


def test_the_cameras_expose_half_a_frame_and_blur_nothing_else(shot: Usd.Stage) -> None:
    for name in ("camera", "camera_finished"):
        camera = UsdGeom.Camera.Get(shot, f"/shot/{name}")
        assert (camera.GetShutterOpenAttr().Get(), camera.GetShutterCloseAttr().Get()) == (-0.25, 0.25)
        assert camera.GetFStopAttr().Get() == 0.0


def test_a_shot_may_refer_to_a_stage_in_one_file(tmp_path: Path) -> None:
    written = write_stage(sculpture(), frames(3), tmp_path, flat=True, shot=True)
    assert [file.name for file in written.files] == ["dog.usdc", "dog_shot.usda"]
    stage = Usd.Stage.Open(str(tmp_path / "dog_shot.usda"))
    assert stage.GetPrimAtPath("/shot/sculpture/geo/render/main").IsA(UsdGeom.Mesh)


def test_variants_can_be_chosen_in_the_shot(shot: Usd.Stage) -> None:
    shot.SetEditTarget(shot.GetSessionLayer())
    prim = shot.GetPrimAtPath("/shot/sculpture")
    prim.GetVariantSet("look").SetVariantSelection("chrome")
    prim.GetVariantSet("state").SetVariantSelection("finished")
    mesh = shot.GetPrimAtPath("/shot/sculpture/geo/render/main")
    bound, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert bound.GetPath() == "/shot/sculpture/mtl/chrome_main"
    assert not UsdGeom.Mesh(mesh).GetPointsAttr().GetNumTimeSamples()


def test_a_sculpture_may_be_called_as_what_stands_round_it(tmp_path: Path) -> None:
    for name in ("shot", "camera", "ground"):
        write_stage(sculpture(name=name), frames(2), tmp_path, shot=True)
        stage = Usd.Stage.Open(str(tmp_path / f"{name}_shot.usda"))
        assert stage.GetPrimAtPath("/shot/sculpture/geo/render/main").IsA(UsdGeom.Mesh)
