"""Walls that pierce walls are counted in every frame of a stage, from the stage alone."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from balloon_usd.balloon.detail import detail_named
from balloon_usd.check import count_crossings, crossings_document, crossings_line
from balloon_usd.check.stage_walls import StageWalls
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import meshes_of
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.stage import write_stage
from balloon_usd.staging import describe_stage
from balloon_usd.staging import write_stage as write_plan
from tests.quality.ears import EARS, points_of
from tests.quality.surfaces import block
from tests.stage.tubes import frames, sculpture

RECIPES = Path(__file__).parents[2] / "recipes"


@pytest.fixture(scope="module")
def crossed(tmp_path_factory):
    """A stage of two tubes, one of which is down in the other in frame 3 only."""
    folder = tmp_path_factory.mktemp("crossed")
    moved = [
        replace(
            f, points=(f.points[0], f.points[1] - np.float32([0, 0.003, 0.085 if f.time_code == 3 else 0]))
        )
        for f in frames(5)
    ]
    return write_stage(sculpture(), moved, folder).files[0]


@pytest.fixture
def foreign(tmp_path):
    """A stage in centimetres with a small box of triangles in the side of a large one, and a lid apart.

    Four edges and the diagonals of four sides pierce the large side.
    """
    stage = Usd.Stage.CreateNew(str(tmp_path / "boxes.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(2)
    large, quads = block((0, 0, 0), 10.0)
    small, _ = block((0, 0, 0), 2.0)
    _mesh(stage, "/large", large, quads)
    triangles = np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])
    xform = UsdGeom.Xformable(_mesh(stage, "/small", small, triangles)).AddTranslateOp()
    xform.Set(Gf.Vec3d(9.7, 6.0, 1.0))
    _mesh(stage, "/lid", large + [20.0, 0.0, 0.0], quads[:5])
    stage.Save()
    return stage


def _mesh(stage, path, points, faces):
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(points.astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr(faces.ravel().astype(np.int32))
    return mesh


def name_of(stage):
    return stage.GetRootLayer().realPath


def test_a_crossing_in_one_frame_is_found_in_that_frame_with_its_bubbles(crossed):
    report = count_crossings(str(crossed))
    counts = [found.count for found in report.frames.values()]
    assert list(report.frames) == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert counts == [0, 0, counts[2], 0, 0]
    assert counts[2] > 20
    assert report.worst == 3.0
    assert 0.001 < report.depth[3.0] < 0.04
    assert report.depth[5.0] == 0.0
    assert {pair for pair, _ in report.pairs()} <= {
        (a, b) for a in ("nose", "left_ear", "right_ear") for b in ("stem", "petal")
    }
    line = crossings_line(report)
    assert f"{counts[2]} crossings in frame 3, the worst of 5 frames, 0 in the last one, " in line


def test_the_document_has_every_frame_and_a_fault_at_the_worst(crossed):
    report = count_crossings(str(crossed))
    (stage,) = json.loads(json.dumps(crossings_document(report), allow_nan=False))["stages"]
    assert (stage["result"], stage["kind"]) == ("faults", "asset")
    (fault,) = stage["faults"]
    assert (fault["by"], fault["rule"], fault["time_code"]) == ("balloon_usd", "crossings", 3.0)
    rows = stage["crossings"]
    assert rows["time_code"] == [1, 2, 3, 4, 5]
    assert (
        rows["count"][2] == rows["worst"]["count"] == sum(each["count"] for each in rows["worst"]["bubbles"])
    )
    assert rows["last"] == {"time_code": 5.0, "count": 0, "in_necks": 0, "depth": 0.0, "bubbles": []}


def test_meshes_of_other_software_are_counted_in_the_world_and_open_ones_left_out(foreign):
    report = count_crossings(name_of(foreign))
    assert report.frames[None].count == 8
    assert report.frames[None].pairs == {("large", "small"): 8}
    assert report.depth[None] == pytest.approx(0.003, rel=1e-3)
    assert report.left_out == ["/lid"]
    assert crossings_line(report).endswith(
        "8 crossings, 3.0 mm deep, large and small 8, 1 mesh left out that is not closed"
    )


def test_a_stage_without_a_closed_mesh_or_with_points_that_are_no_numbers_cannot_be_counted(foreign):
    points = UsdGeom.Mesh(foreign.GetPrimAtPath("/small")).GetPointsAttr()
    broken = np.array(points.Get())
    broken[3] = np.nan
    points.Set(broken)
    foreign.Save()
    assert "/small: some points are no numbers" in count_crossings(name_of(foreign)).unreadable
    for path in ("/small", "/large"):
        foreign.RemovePrim(path)
    foreign.Save()
    report = count_crossings(name_of(foreign))
    assert report.unreadable == f"{name_of(foreign)}: has no closed mesh"
    assert crossings_document(report)["stages"][0]["result"] == "unreadable"


def crumpled(plan, meshes):
    """The last frame of ears that are locked, with a crumpled neck and the tail across the nose."""
    (mesh,) = meshes
    points = points_of(plan, meshes)
    neck = np.abs(mesh.along - plan.bubbles[1].rest_end) < 1e-5
    points[neck] += np.random.default_rng(1).uniform(-1.5e-3, 1.5e-3, (int(neck.sum()), 3)).astype(np.float32)
    tail = mesh.along > plan.bubbles[3].rest_end + 0.01
    nose = np.abs(mesh.along - 0.5 * plan.bubbles[0].rest_end) < 0.004
    points[tail] += points[nose].mean(axis=0) - points[tail].mean(axis=0) + np.float32([0, 5e-4, 3e-4])
    bubbles = np.ones(len(plan.bubbles), dtype=np.float32)
    stretch = np.ones(len(points), dtype=np.float32)
    return Frame(plan.frame_count, (points,), (stretch,), bubbles, bubbles * 1e-4, "hold")


@pytest.mark.parametrize("mirror", ["", "mirror: true\n"], ids=["as made", "mirrored"])
def test_a_stage_alone_gives_the_numbers_of_its_run(mirror, tmp_path):
    plan = plan_of(Recipe.parse(EARS + mirror, file="ears.yaml"))
    meshes = meshes_of(plan, detail_named("draft"))
    last = crumpled(plan, meshes)
    stage = write_plan(plan, [last], tmp_path, detail="draft", flat=True).files[0]
    report = count_crossings(str(stage))
    found = CrossingCounter(walls_of(plan, meshes), 1).count(last.points)
    assert report.frames[report.last] == found
    assert min(found.count, found.in_necks) > 10


def test_a_lock_that_slips_in_the_end_is_one_joint_of_the_stage_as_long_as_hands_hold_it(tmp_path):
    plan = plan_of(Recipe.parse(EARS.replace("  - bubbles: {neck", "    turns: 1\n  - bubbles: {neck")))
    meshes = meshes_of(plan, detail_named("draft"))
    held = points_of(plan, meshes)
    # Both necks of the lock are crumpled, and pierce each other.
    for ring in plan.table.ends("left_ear")[0], plan.table.ends("right_ear")[1]:
        neck = np.abs(meshes[0].along - plan.table.rings[ring].along) < 1e-5
        held[neck] += np.random.default_rng(1).uniform(-3e-3, 3e-3, (int(neck.sum()), 3)).astype(np.float32)
    loose = np.float32([1.0, 0.4, 0.4]) * meshes[0].points
    bubbles, stretch = (np.ones(count, dtype=np.float32) for count in (len(plan.bubbles), len(held)))
    frames = [
        Frame(code, (points,), (stretch,), bubbles, bubbles * 1e-4, "hold")
        for code, points in enumerate((held, loose), start=1)
    ]
    stage = write_plan(plan, frames, tmp_path, detail="draft", flat=True).files[0]
    report = count_crossings(str(stage))
    walls = walls_of(plan, meshes)
    assert walls.slipping
    apart, together = (CrossingCounter(walls, 1).count((held,), neck) for neck in (None, walls.held()))
    assert apart.count > together.count
    assert report.frames[1] == together


@pytest.mark.parametrize("recipe", ["kosaka/bubbles", "book/maple_nj", "meshes/heart"])
def test_necks_are_found_in_tubes_and_capsules_and_shapes_have_none(recipe, tmp_path):
    plan = plan_of(Recipe.load(RECIPES / f"{recipe}.yaml"))
    meshes = meshes_of(plan, detail_named("draft"))
    airs = describe_stage(plan, meshes).airs
    bubbles = np.ones(len(plan.bubbles), dtype=np.float32)
    start = Frame(
        1,
        tuple(mesh.points for mesh in meshes),
        tuple(np.ones(len(mesh.points), dtype=np.float32) for mesh in meshes),
        bubbles,
        bubbles,
        "hold",
        air=tuple(np.zeros((air.count, 3), np.float32) for air in airs),
        cluster=tuple(np.zeros(air.count, np.int32) for air in airs),
    )
    file = write_plan(plan, [start], tmp_path, detail="draft", flat=True).files[0]
    walls, planned = StageWalls(Usd.Stage.Open(str(file))).walls, walls_of(plan, meshes)
    assert walls.quads.tolist() == planned.quads.tolist()
    named = [[each.names[bubble] for bubble in each.bubble_of_triangle] for each in (walls, planned)]
    assert named[0] == named[1]
    assert ((walls.neck >= 0) == (planned.neck >= 0)).all()
    beyond = [{tuple(side.vertices) for side in each.sides} for each in (walls, planned)]
    assert beyond[0] == beyond[1]
