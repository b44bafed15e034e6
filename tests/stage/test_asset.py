from __future__ import annotations

import shutil
import stat
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdShade

from balloon_usd import __version__
from balloon_usd.stage import WrittenStage, write_stage
from tests.stage.tubes import LENGTH, RADIUS, Frame, frames, sculpture, tube_mesh, tube_points

if TYPE_CHECKING:
    from pytest_regressions.file_regression import FileRegressionFixture

MAIN = "/dog/geo/render/main"


def files_of(folder: Path) -> list[str]:
    return sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())


def test_an_asset_is_an_interface_over_a_payload_of_six_layers(tmp_path: Path) -> None:
    written = write_stage(sculpture(), frames(3), tmp_path / "new" / "out")
    detail = ["draft.usda", "draft_finished.usda", "draft_geo.usdc", "draft_sim.usdc", "draft_stress.usdc"]
    payload = [*detail, "materials.usda"]
    assert files_of(tmp_path / "new" / "out") == [
        "dog/dog.usda",
        *(f"dog/payload/{name}" for name in payload),
    ]
    assert written.files[0] == tmp_path / "new" / "out" / "dog" / "dog.usda"
    assert all(file.is_file() for file in written.files)
    assert len(written.files) == 7


def test_a_flat_stage_is_one_file(tmp_path: Path) -> None:
    written = write_stage(sculpture(), frames(3), tmp_path, flat=True)
    assert files_of(tmp_path) == ["dog.usdc"]
    assert written.files == (tmp_path / "dog.usdc",)


def test_the_result_tells_frames_and_extent(tmp_path: Path) -> None:
    written = write_stage(sculpture(), frames(5), tmp_path)
    assert written == WrittenStage(written.files, 5, written.extent)
    (low, high) = written.extent
    assert low[0] == pytest.approx(-RADIUS)
    assert high[0] == pytest.approx(LENGTH + RADIUS)


@pytest.mark.parametrize("form", [{}, {"flat": True, "shot": True}, {"shot": True}, {"usdz": True}])
def test_the_result_tells_the_hashes_and_the_size_of_its_files(form: dict[str, bool], tmp_path: Path) -> None:
    written = write_stage(sculpture(), frames(3), tmp_path, **form)
    contents = {file: file.read_bytes() for file in written.files}
    assert written.sha256 == {file: sha256(content).hexdigest() for file, content in contents.items()}
    assert written.size == sum(map(len, contents.values()))


@pytest.mark.parametrize(
    "layer", ["dog.usda", "payload/draft.usda", "payload/draft_finished.usda", "payload/materials.usda"]
)
def test_text_layers_stay_as_they_are(
    layer: str, tmp_path: Path, file_regression: FileRegressionFixture
) -> None:
    write_stage(sculpture(), frames(5), tmp_path)
    text = (tmp_path / "dog" / layer).read_text().replace(f'"{__version__}"', '"VERSION"')
    file_regression.check(text, extension=".usda", basename=Path(layer).stem)


@pytest.mark.parametrize("layer", ["draft_geo.usdc", "draft_sim.usdc", "draft_stress.usdc"])
def test_crate_layers_stay_as_they_are(
    layer: str, tmp_path: Path, file_regression: FileRegressionFixture
) -> None:
    """Structure only: the values are held by the other tests."""
    write_stage(sculpture(), frames(5), tmp_path)
    lines: list[str] = []

    def note(path: Sdf.Path) -> None:
        spec = opened.GetObjectAtPath(path)
        if isinstance(spec, Sdf.AttributeSpec):
            times = opened.ListTimeSamplesForPath(path)
            lines.append(f"{path} {spec.typeName} {sorted(spec.ListInfoKeys())} {times}")
        elif isinstance(spec, Sdf.PrimSpec):
            lines.append(f"{path} {spec.specifier} {spec.typeName}")

    opened = Sdf.Layer.OpenAsAnonymous(str(tmp_path / "dog" / "payload" / layer))
    opened.Traverse(Sdf.Path.absoluteRootPath, note)
    file_regression.check("\n".join(sorted(lines)) + "\n", basename=Path(layer).stem)


def test_every_sample_is_the_frame_bit_for_bit(dog: Usd.Stage) -> None:
    mesh = UsdGeom.Mesh.Get(dog, MAIN)
    stretch = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("stretch")
    for frame in frames(12):
        assert np.array_equal(mesh.GetPointsAttr().Get(frame.time_code), frame.points[0])
        assert np.array_equal(stretch.Get(frame.time_code), frame.stretch[0])


def test_a_still_viewer_sees_the_finished_sculpture(dog: Usd.Stage) -> None:
    *_, last = frames(12)
    assert np.array_equal(UsdGeom.Mesh.Get(dog, MAIN).GetPointsAttr().Get(), last.points[0])


def test_the_samples_are_not_hidden_by_the_resting_pose(dog: Usd.Stage) -> None:
    mesh = UsdGeom.Mesh.Get(dog, MAIN)
    source = mesh.GetPointsAttr().GetResolveInfo(Usd.TimeCode(3)).GetSource()
    assert source == Usd.ResolveInfoSourceTimeSamples


def test_bubbles_keep_their_names_and_numbers(dog: Usd.Stage) -> None:
    root = dog.GetDefaultPrim()
    names = list(root.GetAttribute("balloon_usd:bubbles").Get())
    assert names == ["nose", "left_ear", "right_ear", "stem", "petal"]
    for balloon, expected in (("main", names[:3]), ("second", names[3:])):
        mesh = UsdGeom.Mesh.Get(dog, f"/dog/geo/render/{balloon}")
        numbers = np.asarray(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("bubble").Get())
        subsets = UsdGeom.Subset.GetGeomSubsets(mesh, "face", "bubbles")
        assert [subset.GetPrim().GetName() for subset in subsets] == expected
        for subset in subsets:
            faces = np.asarray(subset.GetIndicesAttr().Get())
            assert {names[number] for number in numbers[faces]} == {subset.GetPrim().GetName()}


def test_a_mesh_may_count_in_the_names_of_the_whole_sculpture(dog: Usd.Stage, tmp_path: Path) -> None:
    names = ("nose", "left_ear", "right_ear", "stem", "petal")
    second = tube_mesh("second", ("stem", "petal"), 7, (0.1, 0.3, 0.7))
    globally = tube_mesh("second", names, 7, (0.1, 0.3, 0.7))
    object.__setattr__(globally, "quad_bubble", second.quad_bubble + 3)
    description = sculpture(meshes=(sculpture().meshes[0], globally))
    written = write_stage(description, frames(2), tmp_path)
    stage = Usd.Stage.Open(str(written.files[0]))
    path = "/dog/geo/render/second.primvars:bubble"
    assert stage.GetAttributeAtPath(path).Get() == dog.GetAttributeAtPath(path).Get()


def test_pressure_comes_by_bubble_and_by_vertex(dog: Usd.Stage) -> None:
    per_bubble = np.asarray(dog.GetDefaultPrim().GetAttribute("balloon_usd:pressure").Get(4))
    assert per_bubble.tolist() == [2004.0, 2104.0, 2204.0, 2304.0, 2404.0]
    mesh = UsdGeom.Mesh.Get(dog, MAIN)
    per_vertex = np.asarray(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("pressure").Get(4))
    numbers = np.asarray(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("bubble").Get())
    quads = np.asarray(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 4)
    for vertex in range(len(per_vertex)):
        around = per_bubble[numbers[(quads == vertex).any(axis=1)]]
        assert per_vertex[vertex] == pytest.approx(around.mean(), rel=1e-6)
    assert {2004.0, 2054.0, 2104.0, 2154.0, 2204.0} == set(per_vertex.tolist())


def test_a_step_is_a_moment_on_the_time_line(dog: Usd.Stage) -> None:
    step = dog.GetDefaultPrim().GetAttribute("balloon_usd:step")
    assert step.GetTimeSamples() == [1.0, 5.0]
    assert step.Get(4) == "bubbles: nose, left_ear"
    assert step.Get(12) == "lock: left_ear, right_ear"


def test_meshes_of_one_colour_share_one_material(tmp_path: Path) -> None:
    red = (0.8, 0.05, 0.08)
    one, other = sculpture().meshes
    object.__setattr__(other, "color", red)
    stage = Usd.Stage.Open(str(write_stage(sculpture(meshes=(one, other)), frames(2), tmp_path).files[0]))
    bound = {
        str(UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPath())
        for prim in stage.Traverse()
        if prim.IsA(UsdGeom.Mesh)
    }
    assert bound == {"/dog/mtl/latex_main"}
    names = stage.GetPrimAtPath("/dog/mtl").GetAllChildrenNames()
    assert names == ["latex_main", "clear_main", "chrome_main", "clay", "print", "stress"]


def test_a_balloon_has_its_own_finish_where_the_colours_of_the_recipe_are_shown(tmp_path: Path) -> None:
    one, other = sculpture().meshes
    object.__setattr__(one, "finish", "clear")
    stage = Usd.Stage.Open(str(write_stage(sculpture(meshes=(one, other)), frames(2), tmp_path).files[0]))
    bound = {}
    for look in ("recipe", "chrome"):
        stage.GetDefaultPrim().GetVariantSet("look").SetVariantSelection(look)
        bound[look] = {
            prim.GetName(): UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPath().name
            for prim in stage.Traverse()
            if prim.IsA(UsdGeom.Mesh)
        }
    assert bound["recipe"] == {one.name: f"clear_{one.name}", other.name: f"latex_{other.name}"}
    assert bound["chrome"] == {one.name: f"chrome_{one.name}", other.name: f"chrome_{other.name}"}


def test_two_colours_under_one_material_name_get_two_materials(tmp_path: Path) -> None:
    meshes = sculpture().meshes
    for mesh in meshes:
        object.__setattr__(mesh, "material", "latex")
    stage = Usd.Stage.Open(str(write_stage(sculpture(meshes=meshes), frames(2), tmp_path).files[0]))
    names = stage.GetPrimAtPath("/dog/mtl").GetAllChildrenNames()
    assert names[:4] == ["latex", "latex_2", "clear_latex", "clear_latex_2"]


def test_the_room_is_known_without_the_payload(written: Path) -> None:
    stage = Usd.Stage.Open(str(written / "dog" / "dog.usda"), Usd.Stage.LoadNone)
    hint = UsdGeom.ModelAPI(stage.GetDefaultPrim()).GetExtentsHint()
    assert not stage.GetPrimAtPath(MAIN)
    assert hint[1][0] == pytest.approx(LENGTH + RADIUS)


def test_the_asset_opens_where_it_is_moved_to(written: Path, tmp_path: Path) -> None:
    shutil.copytree(written / "dog", tmp_path / "elsewhere")
    stage = Usd.Stage.Open(str(tmp_path / "elsewhere" / "dog.usda"))
    assert stage.GetPrimAtPath(MAIN).IsA(UsdGeom.Mesh)


def test_time_codes_need_not_begin_at_one(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_stage(sculpture(), frames(3, first=6), tmp_path).files[0]))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (6, 8)
    step = stage.GetDefaultPrim().GetAttribute("balloon_usd:step")
    assert step.GetTimeSamples() == [6.0]
    assert step.Get(6) == "lock: left_ear, right_ear"


def test_no_step_is_made_up_before_the_first_one(tmp_path: Path) -> None:
    description = sculpture(twists=((3, "lock"), (3, "bend"), (99, "never reached")))
    stage = Usd.Stage.Open(str(write_stage(description, frames(4), tmp_path).files[0]))
    step = stage.GetDefaultPrim().GetAttribute("balloon_usd:step")
    assert [step.Get(time) for time in (1, 2, 3, 4)] == ["", "", "lock; bend", "lock; bend"]


def test_a_sender_may_reuse_its_arrays(tmp_path: Path) -> None:
    def reused() -> object:
        one, other = tube_points(7, 0.0), tube_points(7, 0.0) + np.array([0, 0, 0.1], np.float32)
        per_bubble = np.ones(5, dtype=np.float32)
        stretch = np.ones(len(one), dtype=np.float32)
        for time_code in (1, 2):
            one += np.float32(0.001)
            yield Frame(time_code, (one, other), (stretch, stretch), per_bubble, per_bubble)
        one[:] = 99.0

    stage = Usd.Stage.Open(str(write_stage(sculpture(), reused(), tmp_path).files[0]))  # type: ignore[arg-type]
    points = UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr()
    assert np.asarray(points.Get()).max() < 1.0
    assert points.Get() == points.Get(2)


def test_others_may_read_what_was_written(tmp_path: Path) -> None:
    for file in (*write_stage(sculpture(), frames(2), tmp_path).files, tmp_path / "dog"):
        assert file.stat().st_mode & stat.S_IROTH


def test_an_open_stage_sees_the_new_files(tmp_path: Path) -> None:
    first = write_stage(sculpture(), frames(3), tmp_path)
    stage = Usd.Stage.Open(str(first.files[0]))
    write_stage(sculpture(), frames(4), tmp_path)
    assert stage.GetEndTimeCode() == 4
    assert len(UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().GetTimeSamples()) == 4
