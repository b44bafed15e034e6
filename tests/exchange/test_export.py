"""What leaves in another format is read back with meshio and compared bit for bit."""

from __future__ import annotations

import resource
import shutil
import tracemalloc
from pathlib import Path

import meshio
import numpy as np
import pytest
from pxr import Usd, UsdGeom, Vt

from balloon_usd.exchange.error import NotExportedError
from balloon_usd.exchange.export import export_stage, stage_range
from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

MOMENTS = {frame.time_code: frame for frame in frames(5)}
STILL_FORMATS = ("obj", "ply", "vtu")


def joined(time_code: int) -> np.ndarray:
    """The points of both tubes as the solver gave them."""
    return np.concatenate(MOMENTS[time_code].points)


def one_mesh(
    file: Path, counts: list[int], corners: list[int], points: list[tuple[float, float, float]]
) -> Path:
    """A stage of another program: y up, in centimetres, without animation."""
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    mesh = UsdGeom.Mesh.Define(stage, "/thing")
    mesh.CreatePointsAttr(Vt.Vec3fArray(points))
    mesh.CreateFaceVertexCountsAttr(counts)
    mesh.CreateFaceVertexIndicesAttr(corners)
    stage.Save()
    return file


PYRAMID = ([4, 3, 3, 3, 3], [0, 1, 2, 3, 0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0])
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 0, 2), (0, 0, 2), (1, 3, 1)]


@pytest.mark.parametrize("form", STILL_FORMATS)
def test_every_frame_has_the_bits_of_the_stage(form: str, dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, form)
    for code in MOMENTS:
        read = meshio.read(tmp_path / f"dog.{code:04d}.{form}")
        assert np.array_equal(read.points.astype(np.float32), joined(code))


@pytest.mark.parametrize("form", STILL_FORMATS)
def test_faces_keep_their_corners_and_their_sense(form: str, dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, form, frames=[1])
    read = meshio.read(tmp_path / f"dog.0001.{form}")
    one, other = sculpture().meshes
    expected = np.concatenate([one.quads, other.quads + one.vertex_count])
    found = np.concatenate([block.data for block in read.cells])
    assert {block.type for block in read.cells} == {"quad"}
    if form == "obj":
        # Faces of a bubble stand together.
        found, expected = (np.array(sorted(quads.tolist())) for quads in (found, expected))
    assert np.array_equal(found, expected)


@pytest.mark.parametrize("form", ["ply", "vtu"])
def test_stretch_and_pressure_are_fields_of_the_points(form: str, dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, form, frames=[3])
    read = meshio.read(tmp_path / f"dog.0003.{form}")
    assert np.array_equal(read.point_data["stretch"], np.concatenate(MOMENTS[3].stretch))
    stage = Usd.Stage.Open(str(dog))
    meshes = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    stored = [UsdGeom.PrimvarsAPI(prim).GetPrimvar("pressure").Get(3) for prim in meshes]
    assert np.array_equal(read.point_data["pressure"], np.concatenate(stored))


def test_balloon_and_bubble_are_fields_of_the_faces(dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, "vtu", frames=[1])
    read = meshio.read(tmp_path / "dog.0001.vtu")
    one, other = sculpture().meshes
    balloon = np.repeat([0, 1], [len(one.quads), len(other.quads)])
    assert np.array_equal(read.cell_data["balloon"][0], balloon)
    assert np.array_equal(
        read.cell_data["bubble"][0], np.concatenate([one.quad_bubble, other.quad_bubble + 3])
    )


def test_obj_has_objects_named_by_balloons_and_groups_named_by_bubbles(dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, "obj", frames=[1])
    lines = (tmp_path / "dog.0001.obj").read_text().splitlines()
    named = [line for line in lines if line[:2] in {"o ", "g "}]
    assert named == ["o main", "g nose", "g left_ear", "g right_ear", "o second", "g stem", "g petal"]
    assert lines[0] == "# Balloon dog of two tubes, time code 1, in metres, z up"


def test_xdmf_is_one_animation_with_moving_points_and_fields(dog: Path, tmp_path: Path) -> None:
    assert export_stage(dog, tmp_path, "xdmf") == (tmp_path / "dog.xdmf", tmp_path / "dog.h5")
    with meshio.xdmf.TimeSeriesReader(tmp_path / "dog.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert np.array_equal(points, joined(1))
        assert [cell.type for cell in cells] == ["quad"]
        assert reader.num_steps == len(MOMENTS)
        for number, (code, frame) in enumerate(MOMENTS.items()):
            seconds, point_data, cell_data = reader.read_data(number)
            assert seconds == pytest.approx((code - 1) / 24)
            assert np.array_equal(point_data["stretch"], np.concatenate(frame.stretch))
            assert np.unique(cell_data["bubble"][0]).tolist() == [0, 1, 2, 3, 4]
            # Meshio's reader takes the points of the first moment for all.
            moved = reader.collection[number].find("Geometry")[0]
            assert np.array_equal(reader._read_data_item(moved), joined(code))


def test_faces_stand_in_an_xdmf_series_once(dog: Path, tmp_path: Path) -> None:
    export_stage(dog, tmp_path, "xdmf")
    text = (tmp_path / "dog.xdmf").read_text()
    assert text.count("dog.h5:/data0<") == len(MOMENTS)
    assert str(tmp_path) not in text


def test_vtu_comes_with_an_index_that_paraview_opens_as_one_animation(dog: Path, tmp_path: Path) -> None:
    files = export_stage(dog, tmp_path, "vtu", frames=[1, 3])
    assert files[0] == tmp_path / "dog.pvd"
    text = files[0].read_text()
    assert 'timestep="0.0" file="dog.0001.vtu"' in text
    assert f'timestep="{2 / 24!r}" file="dog.0003.vtu"' in text


@pytest.mark.parametrize("form", [*STILL_FORMATS, "xdmf"])
def test_equal_stages_give_equal_bytes(form: str, dog: Path, tmp_path: Path) -> None:
    one, other = (export_stage(dog, tmp_path / name, form) for name in ("one", "other"))
    assert [file.read_bytes() for file in one] == [file.read_bytes() for file in other]


@pytest.mark.parametrize("form", [*STILL_FORMATS, "xdmf"])
def test_a_stage_of_other_software_without_animation_gives_one_file_in_metres(
    form: str, tmp_path: Path
) -> None:
    stage = one_mesh(tmp_path / "thing.usda", *PYRAMID, CORNERS)
    files = export_stage(stage, tmp_path / "out", form)
    assert files[0].name == f"thing.{form}"
    if form == "xdmf":
        with meshio.xdmf.TimeSeriesReader(files[0]) as reader:
            points, cells = reader.read_points_cells()
            assert not reader.read_data(0)[1]
    else:
        read = meshio.read(files[0])
        points, cells = read.points, read.cells
        assert not read.point_data
    assert points.astype(np.float32)[4] == pytest.approx([0.01, -0.01, 0.03])
    assert {block.type: len(block.data) for block in cells} == {"triangle": 4, "quad": 1}


@pytest.mark.parametrize("form", ["ply", "vtu"])
def test_faces_with_more_corners_pass_as_polygons(form: str, tmp_path: Path) -> None:
    points = [(np.cos(a), 0.0, np.sin(a)) for a in np.arange(5) * 2 * np.pi / 5]
    stage = one_mesh(tmp_path / "five.usda", [5], [0, 1, 2, 3, 4], points)
    (block,) = meshio.read(export_stage(stage, tmp_path, form)[0]).cells
    assert block.data.tolist() == [[0, 1, 2, 3, 4]]
    with pytest.raises(MeshFileError, match="thing has faces with 5 corners, XDMF takes 3 or 4"):
        export_stage(stage, tmp_path, "xdmf")


def test_faces_that_change_in_time_are_refused(tmp_path: Path) -> None:
    file = one_mesh(tmp_path / "thing.usda", *PYRAMID, CORNERS)
    stage = Usd.Stage.Open(str(file))
    counts = UsdGeom.Mesh(stage.GetPrimAtPath("/thing")).GetFaceVertexCountsAttr()
    counts.Set([4, 3, 3, 3, 3], 1)
    counts.Set([4, 3, 3, 3, 3], 2)
    stage.Save()
    with pytest.raises(MeshFileError, match="/thing changes its faces in time"):
        export_stage(file, tmp_path, "obj")


def test_frames_that_are_not_there_are_refused(dog: Path, tmp_path: Path) -> None:
    assert stage_range(dog) == (1, 5)
    with pytest.raises(MeshFileError, match=r"dog.usda has frames 1 to 5 only"):
        export_stage(dog, tmp_path, "obj", frames=[4, 6])


def test_a_range_that_nobody_has_animated_is_refused_unless_frames_are_named(
    dog: Path, tmp_path: Path
) -> None:
    stage = Usd.Stage.CreateNew(str(dog.with_name("long.usda")))
    stage.GetRootLayer().subLayerPaths.append(str(dog))
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(1e300)
    stage.Save()
    with pytest.raises(MeshFileError, match=r"long.usda has frames 1 to 1e\+300, name some of them"):
        export_stage(dog.with_name("long.usda"), tmp_path, "ply")
    assert len(export_stage(dog.with_name("long.usda"), tmp_path, "ply", frames=[2])) == 1


def test_a_folder_in_the_way_is_refused_and_nothing_is_written(dog: Path, tmp_path: Path) -> None:
    (tmp_path / "dog.0003.obj").mkdir()
    with pytest.raises(NotExportedError, match=r"dog.0003.obj could not be written: a folder is in the way"):
        export_stage(dog, tmp_path, "obj")
    assert [file.name for file in tmp_path.iterdir()] == ["dog.0003.obj"]


@pytest.mark.parametrize("form", [*STILL_FORMATS, "xdmf"])
def test_a_full_disk_leaves_the_earlier_files(form: str, dog: Path, tmp_path: Path) -> None:
    before = {file: file.read_bytes() for file in export_stage(dog, tmp_path, form)}
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(NotExportedError, match="could not be written: File too large"):
            export_stage(dog, tmp_path, form, frames=[1, 2])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == before


@pytest.mark.parametrize("form", ["ply", "vtu", "xdmf"])
def test_memory_does_not_grow_with_the_number_of_frames(form: str, tmp_path: Path) -> None:
    stage = write_stage(sculpture(rings=1250), frames(24, rings=1250), tmp_path).files[0]
    export_stage(stage, tmp_path / "first", form, frames=[1])
    peaks = {3: [], 24: []}
    # The interpreter's table of names may grow meanwhile, by 2 MB, but not in both of two goes.
    for count, found in 2 * [*peaks.items()]:
        tracemalloc.start()
        export_stage(stage, tmp_path / str(count), form, frames=range(1, count + 1))
        found.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    # A frame has 240 kB of points; what XDMF says of a frame in its text is 10 kB.
    assert min(peaks[24]) < min(peaks[3]) + 400_000


def test_a_stage_that_is_damaged_between_its_frames_is_refused_and_leaves_nothing(
    dog: Path, tmp_path: Path
) -> None:
    shutil.copytree(dog.parent, tmp_path / "dog")
    samples = tmp_path / "dog" / "payload" / "draft_sim.usdc"
    data = bytearray(samples.read_bytes())
    third = len(data) // 3
    data[third : third + 400] = b"\xff" * 400
    samples.write_bytes(data)
    with pytest.raises(MeshFileError, match=r"dog.usda (is damaged and cannot be read|is not whole)"):
        export_stage(tmp_path / "dog" / "dog.usda", tmp_path / "out", "ply")
    assert list((tmp_path / "out").glob("*")) == []


def test_a_format_that_there_is_not_and_frames_between_frames_are_refused(tmp_path):
    file = write_stage(sculpture(), frames(2), tmp_path).files[0]
    with pytest.raises(ValueError, match='unknown format "stl"'):
        export_stage(file, tmp_path / "out", "stl")
    with pytest.raises(TypeError, match="float"):
        export_stage(file, tmp_path / "out", "obj", frames=[1.5])
    assert len(export_stage(file, tmp_path / "out", "obj", frames=np.arange(1, 3))) == 2
