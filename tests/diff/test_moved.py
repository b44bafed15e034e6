"""What moved, how far, where and when: in the world, in metres, whatever a stage's own units and axes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, Vt

from balloon_usd.diff import Allowed, Difference, Tolerances, compare_files
from balloon_usd.stage import write_stage
from tests.stage.tubes import AROUND, frames, sculpture

MAIN = "/dog/geo/render/main"
Change = Callable[[Callable[[Usd.Stage], object]], Path]


def move_vertex(vertex: int, by: tuple[float, float, float], time: float = 5) -> Callable[[Usd.Stage], None]:
    def move(stage: Usd.Stage) -> None:
        attribute = UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr()
        points = np.array(attribute.Get(time))
        points[vertex] += np.array(by, dtype=np.float32)
        attribute.Set(Vt.Vec3fArray.FromNumpy(points), time)

    return move


def moved(one: Path, other: Path, **how: object) -> list[Difference]:
    return [found for found in compare_files(one, other, **how).differences if found.movement]


def test_a_stage_is_the_same_as_itself(written: Path) -> None:
    assert compare_files(written / "dog", written / "dog", variants=True).same
    assert compare_files(written / "dog.usdc", written / "dog.usdc").same


def test_one_moved_vertex_is_told_with_prim_bubble_time_code_and_distance(
    written: Path, changed: Change
) -> None:
    vertex = 3 * AROUND + 2
    other = changed(move_vertex(vertex, (0, 0, 0.003)))
    (told,) = moved(written / "dog.usdc", other)
    assert told.prim == MAIN
    assert told.text.startswith(f"left_ear moved 3 mm at 5 (largest, vertex {vertex}), rms ")
    assert told.text.endswith("; at 1 of 12 time codes")
    movement = told.movement
    assert movement is not None
    assert movement.bubble == "left_ear"
    assert movement.worst.distance == pytest.approx(0.003, rel=1e-3)
    assert movement.worst.time_code == 5.0
    (points,) = [found for found in compare_files(written / "dog.usdc", other).differences if found.name]
    assert (points.name, points.by) == ("points", pytest.approx(0.003, rel=1e-3))


def test_a_vertex_between_bubbles_is_told_of_both_and_of_the_whole(written: Path, changed: Change) -> None:
    other = changed(move_vertex(2 * AROUND, (0.001, 0, 0)))
    names = [told.movement.bubble for told in moved(written / "dog.usdc", other) if told.movement]
    assert names == ["", "nose", "left_ear"]


def test_the_worst_and_the_first_time_code_are_told(written: Path, changed: Change) -> None:
    def three_times(stage: Usd.Stage) -> None:
        for time, by in ((4, 0.001), (7, 0.004), (9, 0.002)):
            move_vertex(30, (0, by, 0), time)(stage)

    (told,) = moved(written / "dog.usdc", changed(three_times))
    assert "moved 4 mm at 7 (" in told.text
    assert told.text.endswith("; at 3 of 12 time codes, first at 4")
    assert told.spread is not None
    assert (told.spread.first, told.spread.worst, told.spread.last) == (4, 7, 9)


def test_a_bubble_that_grew_is_told_with_its_volume(tmp_path: Path) -> None:
    grown = list(frames(3))
    for frame in grown:
        frame.points[0][:, 1:] *= np.float32(1.1)
    write_stage(sculpture(), frames(3), tmp_path / "one")
    write_stage(sculpture(), iter(grown), tmp_path / "other")
    told = {
        d.movement.bubble: d.movement for d in moved(tmp_path / "one" / "dog", tmp_path / "other" / "dog")
    }
    for bubble in ("", "nose", "left_ear", "right_ear"):
        assert told[bubble].worst.growth == pytest.approx(0.21, abs=1e-4)


def test_what_is_within_the_tolerance_is_not_told(written: Path, changed: Change) -> None:
    def twice(stage: Usd.Stage) -> None:
        move_vertex(10, (0, 0, 5e-5))(stage)
        move_vertex(30, (0, 0, 5e-3))(stage)

    other = changed(twice)
    fine = Tolerances(named={"points": Allowed(1e-4)})
    names = [
        told.movement.bubble for told in moved(written / "dog.usdc", other, tolerances=fine) if told.movement
    ]
    assert names == ["left_ear"]
    assert compare_files(
        written / "dog.usdc", other, tolerances=Tolerances(named={"points": Allowed(6e-3)})
    ).same


def test_all_points_together_may_be_beyond_what_each_may(written: Path, changed: Change) -> None:
    def all_of_them(stage: Usd.Stage) -> None:
        for vertex in range(50):
            move_vertex(vertex, (0, 0, 5e-4))(stage)

    other = changed(all_of_them)
    each = {"points": Allowed(1e-3)}
    assert compare_files(written / "dog.usdc", other, tolerances=Tolerances(named=each, rms=6e-4)).same
    (told,) = compare_files(
        written / "dog.usdc", other, tolerances=Tolerances(named=each, rms=1e-4)
    ).differences
    assert told.text.startswith("main moved 0.5 mm at 5 (")
    assert told.text.endswith("at 5, beyond 0.1 mm")


def test_not_a_number_is_told_of_the_attribute_and_is_no_distance(written: Path, changed: Change) -> None:
    told = compare_files(written / "dog.usdc", changed(move_vertex(3, (float("nan"), 0, 0)))).differences
    assert [str(found) for found in told] == [
        f"{MAIN}.points: 0 and 1 values are NaN at 5; at 1 of 12 time codes"
    ]


def test_other_vertices_are_a_difference_and_volume_and_extent_are_still_compared(
    written: Path, tmp_path: Path
) -> None:
    write_stage(sculpture(rings=9), frames(12, rings=9), tmp_path, flat=True)
    told = [
        d for d in compare_files(written / "dog.usdc", tmp_path / "dog.usdc").differences if d.prim == MAIN
    ]
    assert told[0].text == "58 and 74 vertices, 56 and 72 faces"
    extents = {d.movement.bubble: d for d in told if d.movement}
    assert extents.keys() == {"", "nose", "left_ear", "right_ear"}
    assert extents[""].text.startswith("main: extents ")
    assert ", volume +" in extents[""].text
    assert extents[""].movement.worst.rms is None


def box(file: Path, *, up: str, unit: float, heights: dict[int, float]) -> Path:
    """A box one metre wide that an Xform lifts, as other software writes it."""
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    stage.SetTimeCodesPerSecond(30)
    xform = UsdGeom.Xform.Define(stage, "/world/crate")
    lift = xform.AddTranslateOp()
    for time, height in heights.items():
        lift.Set(Gf.Vec3d(0, height / unit, 0) if up == "Y" else Gf.Vec3d(0, 0, height / unit), time)
    mesh = UsdGeom.Mesh.Define(stage, "/world/crate/box")
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float32)
    if up == "Y":
        corners = corners[:, [0, 2, 1]] * np.array([1, 1, -1], dtype=np.float32)
    mesh.CreatePointsAttr(corners / np.float32(unit))
    mesh.CreateFaceVertexCountsAttr([4] * 6)
    mesh.CreateFaceVertexIndicesAttr([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    stage.GetRootLayer().Save()
    return file


def test_a_mesh_that_a_transform_moves_is_measured_in_the_world(tmp_path: Path) -> None:
    lifted = {1: 0.0, 10: 0.25}
    one = box(tmp_path / "one.usda", up="Y", unit=0.01, heights=lifted)
    other = box(tmp_path / "other.usda", up="Y", unit=0.01, heights={**lifted, 10: 0.27})
    found = [str(difference) for difference in compare_files(one, other).differences]
    assert found == [
        "/world/crate.xformOp:translate: differ by up to 2 at 10; at 1 of 2 time codes",
        "/world/crate/box: box moved 20 mm at 10 (largest, vertex 0), rms 20 mm; at 1 of 2 time codes",
    ]


def test_other_units_and_axes_are_a_difference_that_moves_nothing(tmp_path: Path) -> None:
    heights = {1: 0.0, 10: 0.5}
    metres = box(tmp_path / "metres.usda", up="Z", unit=1.0, heights=heights)
    other = box(tmp_path / "centimetres.usda", up="Y", unit=0.01, heights=heights)
    found = compare_files(metres, other).differences
    assert [str(difference) for difference in found if not difference.prim] == [
        "metersPerUnit: 1 and 0.01",
        "upAxis: Z and Y",
    ]
    assert [difference for difference in found if difference.movement] == []


def test_faces_that_change_in_time_are_compared_as_they_are_then(tmp_path: Path) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    for file, lift in zip(files, (0.0, 0.25), strict=True):
        stage = Usd.Stage.CreateNew(str(file))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        mesh = UsdGeom.Mesh.Define(stage, "/sheet")
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, lift)]
        for time, count in ((1, 3), (2, 4)):
            mesh.CreatePointsAttr().Set(corners[:count], time)
            mesh.CreateFaceVertexCountsAttr().Set([count], time)
            mesh.CreateFaceVertexIndicesAttr().Set(list(range(count)), time)
        stage.GetRootLayer().Save()
    found = [str(difference) for difference in compare_files(*files).differences]
    assert found[0] == "/sheet: sheet moved 250 mm at 2 (largest, vertex 3), rms 125 mm; at 1 of 2 time codes"
    assert [difference.name for difference in compare_files(*files).differences[1:]] == ["points"]


def test_points_that_come_and_go_are_told_by_number(tmp_path: Path) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    for file, counts in zip(files, ((2, 3, 4), (2, 3, 5)), strict=True):
        stage = Usd.Stage.CreateNew(str(file))
        dust = UsdGeom.Points.Define(stage, "/dust")
        for time, count in enumerate(counts, start=1):
            dust.CreatePointsAttr().Set([(n, 0, 0) for n in range(count)], time)
        stage.GetRootLayer().Save()
    found = [str(difference) for difference in compare_files(*files).differences]
    assert found == [
        "/dust: 4 and 5 vertices",
        "/dust: dust: extents 10 mm apart at 3",
        "/dust.points: 4 and 5 values at 3; at 1 of 3 time codes",
    ]
