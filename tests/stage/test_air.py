from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade

from balloon_usd.stage import AirDescription, StageDescription, write_stage
from balloon_usd.stage.cluster_color import CLUSTER_COLORS
from tests.stage.capsule import WIDTH, AirFrame, Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

AIR = "/capsule/geo/render/main_air"
PARTICLES = 24


def air_of(stage: Usd.Stage) -> UsdGeom.Points:
    return UsdGeom.Points.Get(stage, AIR)


def primvar(stage: Usd.Stage, name: str) -> UsdGeom.Primvar:
    return UsdGeom.PrimvarsAPI(air_of(stage)).GetPrimvar(name)


def with_clusters(clusters: list[list[int]]) -> Iterator[AirFrame]:
    """A frame for each list; its numbers are shared out among the particles."""
    for frame, numbers in zip(Capsule().frames(len(clusters)), clusters, strict=True):
        cluster = np.resize(np.array(numbers, dtype=np.int32), PARTICLES)
        yield replace(frame, cluster=(cluster,))


def written(folder: Path, clusters: list[list[int]]) -> Usd.Stage:
    return Usd.Stage.Open(str(write_stage(Capsule().describe(), with_clusters(clusters), folder).files[0]))


def test_every_sample_is_the_frame_bit_for_bit(capsule: Usd.Stage) -> None:
    for frame in Capsule().frames(8):
        assert np.array_equal(air_of(capsule).GetPointsAttr().Get(frame.time_code), frame.air[0])
        assert np.array_equal(primvar(capsule, "cluster").Get(frame.time_code), frame.cluster[0])


def test_a_still_viewer_sees_the_last_frame(capsule: Usd.Stage) -> None:
    *_, last = Capsule().frames(8)
    assert np.array_equal(air_of(capsule).GetPointsAttr().Get(), last.air[0])
    assert np.array_equal(primvar(capsule, "cluster").Get(), last.cluster[0])
    assert np.array_equal(primvar(capsule, "displayColor").Get(), CLUSTER_COLORS[last.cluster[0]])


def test_particles_have_one_width_and_numbers_that_stay(capsule: Usd.Stage) -> None:
    air = air_of(capsule)
    assert list(air.GetWidthsAttr().Get()) == [pytest.approx(WIDTH)] * len(air.GetIdsAttr().Get())
    assert air.GetWidthsInterpolation() == "vertex"
    assert list(air.GetIdsAttr().Get()) == list(range(PARTICLES))
    assert str(air.GetIdsAttr().GetTypeName()) == "int64[]"
    assert not air.GetIdsAttr().GetNumTimeSamples() + air.GetWidthsAttr().GetNumTimeSamples()


def test_the_extent_holds_the_balls_and_not_only_their_centres(capsule: Usd.Stage) -> None:
    low, high = np.asarray(air_of(capsule).GetExtentAttr().Get(3))
    points = np.asarray(air_of(capsule).GetPointsAttr().Get(3))
    assert np.allclose(low, points.min(axis=0) - WIDTH / 2, atol=1e-7)
    assert np.allclose(high, points.max(axis=0) + WIDTH / 2, atol=1e-7)


def test_clusters_are_sampled_only_where_they_change(capsule: Usd.Stage) -> None:
    assert air_of(capsule).GetPointsAttr().GetTimeSamples() == [*range(1, 9)]
    assert primvar(capsule, "cluster").GetAttr().GetTimeSamples() == [1, 5]
    assert primvar(capsule, "displayColor").GetAttr().GetTimeSamples() == [1, 4, 5]
    assert {primvar(capsule, name).GetInterpolation() for name in ("cluster", "displayColor")} == {"vertex"}


def test_colours_jump_with_the_clusters_at_every_whole_time_code(capsule: Usd.Stage) -> None:
    for time in range(1, 9):
        cluster = np.asarray(primvar(capsule, "cluster").Get(time))
        # Readers blend: equal colours may come back with a rounding error.
        found = np.asarray(primvar(capsule, "displayColor").Get(time))
        assert np.allclose(found, CLUSTER_COLORS[cluster], atol=1e-6), time


@pytest.mark.parametrize(
    ("clusters", "numbers", "colors"),
    [
        ([[0]] * 4, [], []),
        ([[1], [0], [0], [0]], [1, 2], [1, 2]),
        ([[0], [0], [1], [0, 1]], [1, 3, 4], [1, 2, 3, 4]),
        ([[0], [1], [1], [1], [1], [0]], [1, 2, 6], [1, 2, 5, 6]),
    ],
    ids=["never", "at once", "twice in a row", "after a while"],
)
def test_each_change_brings_a_sample_and_the_old_colours_one_before(
    clusters: list[list[int]], numbers: list[int], colors: list[int], tmp_path: Path
) -> None:
    stage = written(tmp_path, clusters)
    assert primvar(stage, "cluster").GetAttr().GetTimeSamples() == numbers
    assert primvar(stage, "displayColor").GetAttr().GetTimeSamples() == colors
    for time, expected in enumerate(clusters, 1):
        row = np.resize(np.array(expected), PARTICLES)
        assert np.array_equal(primvar(stage, "cluster").Get(time), row)
        assert np.allclose(primvar(stage, "displayColor").Get(time), CLUSTER_COLORS[row], atol=1e-6)


def test_a_sender_may_reuse_the_array_of_clusters(tmp_path: Path) -> None:
    def reused() -> Iterator[AirFrame]:
        cluster = np.zeros(PARTICLES, dtype=np.int32)
        for frame in Capsule().frames(3):
            cluster[:] = frame.time_code % 2
            yield replace(frame, cluster=(cluster,))

    stage = Usd.Stage.Open(str(write_stage(Capsule().describe(), reused(), tmp_path).files[0]))
    assert [primvar(stage, "cluster").Get(time)[0] for time in (1, 2, 3)] == [1, 0, 1]


def test_the_first_clusters_are_blue_and_all_are_far_apart() -> None:
    red, green, blue = CLUSTER_COLORS[0]
    assert blue > 5 * max(red, green)
    gaps = np.linalg.norm(CLUSTER_COLORS[:, None] ** 0.45 - CLUSTER_COLORS[None] ** 0.45, axis=2)
    assert gaps[np.triu_indices(len(gaps), 1)].min() > 0.25


def test_more_clusters_than_colours_begin_anew(tmp_path: Path) -> None:
    count = len(CLUSTER_COLORS) + 2
    names = tuple(f"bubble_{number}" for number in range(count))
    (mesh,) = Capsule().describe().meshes
    mesh = replace(mesh, bubble_names=names)
    frame = next(Capsule().frames(1))
    per_bubble = np.ones(count, dtype=np.float32)
    last = np.full(PARTICLES, count - 1, dtype=np.int32)
    frame = replace(frame, pressure=per_bubble, volume=per_bubble, cluster=(last,))
    description = Capsule().describe(meshes=(mesh,), bubble_names=names)
    stage = Usd.Stage.Open(str(write_stage(description, [frame], tmp_path).files[0]))
    assert np.allclose(primvar(stage, "displayColor").Get()[0], CLUSTER_COLORS[1])


def test_particles_take_their_colour_from_their_material_too(capsule: Usd.Stage) -> None:
    material, _ = UsdShade.MaterialBindingAPI(air_of(capsule)).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0]
    (source,), _ = surface.GetInput("diffuseColor").GetConnectedSources()
    reader = UsdShade.Shader(source.source.GetPrim())
    assert reader.GetShaderId() == "UsdPrimvarReader_float3"
    assert reader.GetInput("varname").Get() == "displayColor"


def test_the_room_includes_air_that_leaks(tmp_path: Path) -> None:
    def leaking() -> Iterator[AirFrame]:
        for frame in Capsule().frames(2):
            frame.air[0][0] = (0.3, 0.0, 0.0)
            yield frame

    written = write_stage(Capsule().describe(), leaking(), tmp_path)
    assert written.extent[1][0] == pytest.approx(0.3 + WIDTH / 2)


def test_two_balloons_have_two_airs(tmp_path: Path) -> None:
    description = Capsule().describe(
        airs=(AirDescription("low", 24, WIDTH), AirDescription("high", 24, 0.001))
    )
    doubled = (
        replace(f, air=(f.air[0], f.air[0] + np.float32(0.01)), cluster=f.cluster * 2)
        for f in Capsule().frames(2)
    )
    stage = Usd.Stage.Open(str(write_stage(description, doubled, tmp_path).files[0]))
    low, high = (UsdGeom.Points.Get(stage, f"/capsule/geo/render/{name}") for name in ("low", "high"))
    gap = np.asarray(high.GetPointsAttr().Get(2)) - np.asarray(low.GetPointsAttr().Get(2))
    assert np.allclose(gap, 0.01, atol=1e-6)
    assert high.GetWidthsAttr().Get()[0] == pytest.approx(0.001)


def test_frames_need_no_air_where_none_is_described(tmp_path: Path) -> None:
    description: StageDescription = sculpture()
    assert description.airs == ()
    assert not hasattr(next(frames(1)), "air")
    stage = Usd.Stage.Open(str(write_stage(description, frames(2), tmp_path).files[0]))
    assert not [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Points)]
    assert "thesis" not in stage.GetDefaultPrim().GetVariantSet("look").GetVariantNames()
    assert not list(tmp_path.rglob("*.png"))
