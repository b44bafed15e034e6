"""A run that goes wrong is stopped in the frame in which it does, with the place, the cause and the remedy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import warp as wp

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.checks import BatchCheck, SculptureCheck, stretch_limits, travel_limit
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.frame_arrays import Extent, FrameArrays, Place
from balloon_usd.solver.kernels.arrays.shared import Balloons, Checks, Mesh, State
from balloon_usd.solver.remedy import steadier
from tests.solver.suspect_kernels import check_vertices

RECIPE = """\
format: 1
name: snake
units: cm
balloons: {main: {size: 260, length: 16, tail: 5}}
steps:
  - bubbles: {nose: 8, middle: 10}
  - rest: tail
"""
AIR = "format: 1\nname: air\nunits: cm\nballoons: {main: {size: 260, capsule: 20}}\nsteps: [wait: 1]\n"


class Scene:
    """A check and a frame in which all is well."""

    def __init__(self, physics=""):
        self.plan = plan_of(Recipe.parse(RECIPE + physics))
        self.meshes = tuple(mesh_of(strip, detail_named("draft")) for strip in self.plan.strips.values())
        self.check = SculptureCheck(self.plan, self.meshes, 24.0, 100)
        mesh, one = self.meshes[0], np.ones(3, dtype=np.float32)
        ones = np.ones(len(mesh.points), dtype=np.float32)
        self.frame = Frame(1, (mesh.points,), (ones,), 1000.0 * one, 1e-4 * one, "hold")

    def of(self, bubble):
        """One vertex of a bubble."""
        planned = next(b for b in self.plan.bubbles if b.name == bubble)
        along = self.meshes[0].along
        return int(np.argmin(np.abs(along - 0.5 * (planned.rest_start + planned.rest_end))))

    def with_points(self, bubble, value):
        points = self.frame.points[0].copy()
        points[self.of(bubble)] = value
        return replace(self.frame, points=(points,))


@pytest.fixture
def scene():
    return Scene()


def test_a_good_frame_has_no_failure(scene):
    assert scene.check.failure(scene.frame) is None
    assert scene.check.failure(scene.frame) is None


def test_a_wall_that_is_no_number_is_found_in_its_bubble(scene):
    cause = scene.check.failure(scene.with_points("middle", np.nan))
    assert cause.startswith("middle has flown apart: 1 of ")
    assert "substeps: 200" in cause


def test_a_balloon_that_is_wholly_lost_is_told_where_it_was_stretched_most(scene):
    scene.frame.stretch[0][scene.of("nose")] = 6.0
    scene.check.failure(scene.frame)
    lost = replace(scene.frame, points=(np.full_like(scene.frame.points[0], np.nan),))
    assert scene.check.failure(lost).startswith("nose has flown apart")


def test_a_balloon_that_is_lost_in_the_first_frame_is_told_by_its_name(scene):
    lost = replace(scene.frame, points=(np.full_like(scene.frame.points[0], np.inf),))
    assert scene.check.failure(lost).startswith("balloon main has flown apart")


def test_a_stretch_that_is_no_number_is_found_too(scene):
    scene.frame.stretch[0][scene.of("tail")] = np.nan
    assert scene.check.failure(scene.frame).startswith("tail has flown apart")


def test_gas_that_is_no_number_is_found_too(scene):
    scene.frame.volume[1] = np.nan
    assert scene.check.failure(scene.frame).startswith("the gas of middle is no number any more")


def test_what_is_too_fast_is_found_in_its_bubble(scene):
    scene.check.failure(scene.frame)
    there = scene.frame.points[0][scene.of("middle")] + np.float32([0, 0, 0.5])
    cause = scene.check.failure(scene.with_points("middle", there))
    assert cause.startswith("a part of middle moves at 12.0 m/s, faster than hands can move it")


def test_what_is_beyond_measure_has_flown_apart(scene):
    scene.check.failure(scene.frame)
    assert scene.check.failure(scene.with_points("nose", 1e20)).startswith("nose has flown apart;")


def test_a_bubble_that_sucks_has_turned_inside_out(scene):
    scene.frame.pressure[1] = -3e4
    assert scene.check.failure(scene.frame).startswith("middle has turned inside out (-30 kPa in ")


def test_what_is_folded_in_an_open_tube_has_not_turned_inside_out(scene):
    scene.frame.volume[1] = -1e-6
    assert scene.check.failure(scene.frame) is None


def test_a_bubble_without_volume_has_turned_inside_out(scene):
    scene.frame.volume[1], scene.frame.pressure[1] = -1e-6, 2000.0
    assert " kPa in -1.0 cm3): make it longer" in scene.check.failure(scene.frame)


def test_a_burst_stops_the_run_where_that_is_asked_for():
    scene = Scene("physics: {burst: stop}\n")
    burst(scene.frame, scene.of("nose"))
    assert scene.check.failure(scene.frame).startswith("nose bursts: its wall has ")


def test_one_vertex_in_a_crease_does_not_burst_a_balloon():
    scene = Scene("physics: {burst: stop}\n")
    scene.frame.stretch[0][scene.of("nose")] = 9.0
    assert scene.check.failure(scene.frame) is None


def lose_a_vertex(frame, vertex):
    frame.points[0][vertex] = np.nan


def lose_a_stretch(frame, vertex):
    frame.stretch[0][vertex] = -np.inf


def lose_gas(frame, _):
    frame.volume[1] = np.nan


def lose_more_gas(frame, _):
    frame.volume[2] = -np.inf


def throw(frame, vertex):
    frame.points[0][vertex] -= np.float32([0, 0.3, 0])


def explode(frame, vertex):
    frame.points[0][vertex] = 1e30


def turn_inside_out(frame, _):
    frame.pressure[2] = -2.1e4


def burst(frame, vertex):
    """Stretch the wall around a vertex."""
    frame.stretch[0][max(vertex - 60, 0) : vertex + 60] = 12.0


WRONG = [lose_a_vertex, lose_a_stretch, lose_gas, lose_more_gas, throw, explode, turn_inside_out, burst]


def arrays_of(frames):
    """What several sculptures of one balloon each show together."""
    points, stretch = ([getattr(f, name)[0] for f in frames] for name in ("points", "stretch"))
    gas = ([getattr(f, name) for f in frames] for name in ("pressure", "volume"))
    return FrameArrays(*(np.concatenate(arrays) for arrays in (points, stretch, *gas)))


def copied(frame):
    return replace(
        frame,
        points=(frame.points[0].copy(),),
        stretch=(frame.stretch[0].copy(),),
        pressure=frame.pressure.copy(),
        volume=frame.volume.copy(),
    )


def batch_check_over(scenes):
    """Who looks at several sculptures that lie one after another."""
    places, before = [], Extent(0, 0)
    for scene in scenes:
        own = Extent(len(scene.frame.points[0]), len(scene.frame.volume))
        places.append(Place((slice(0, own.vertices),), slice(0, own.bubbles)).after(before))
        before = Extent.of([before, own])
    return BatchCheck([s.plan for s in scenes], [s.meshes for s in scenes], places, 24.0, 100)


class Looks:
    """Looks at several sculptures of one balloon each, one after another."""

    def __init__(self, scenes):
        self.checks = batch_check_over(scenes)
        count = len(scenes)
        self.most = stretch_limits([s.plan for s in scenes], [range(k, k + 1) for k in range(count)])
        balloon = np.repeat(np.arange(count), [len(s.frame.points[0]) for s in scenes])
        self.balloon = wp.array(balloon, dtype=int, device="cpu")
        points = np.concatenate([s.frame.points[0] for s in scenes])
        self.shown = wp.array(points, dtype=wp.vec3, device="cpu")

    def causes(self, frames):
        """What is wrong with each sculpture."""
        arrays, worlds = arrays_of(frames), np.arange(len(frames), dtype=np.int32)
        mesh, balloons, checks, state = Mesh(), Balloons(), Checks(), State()
        mesh.vertex_balloon, balloons.balloon_world = self.balloon, wp.array(worlds, device="cpu")
        checks.stretch, checks.x_checked = wp.array(arrays.stretch, device="cpu"), self.shown
        checks.stretch_limit = wp.array(self.most, dtype=float, device="cpu")
        checks.suspects = wp.zeros(len(frames), dtype=int, device="cpu")
        state.x = wp.array(arrays.points, dtype=wp.vec3, device="cpu")
        given = [travel_limit(1.0 / 24.0), mesh, balloons, checks, state]
        wp.launch(check_vertices, len(arrays.points), inputs=given, device="cpu")
        found = self.checks.suspicious(arrays, checks.suspects.numpy())
        return [self.checks.failure(k) if k in found else None for k in range(len(frames))]


@pytest.mark.parametrize("spoil", WRONG)
@pytest.mark.parametrize("bubble", ["nose", "tail"])
def test_a_look_at_all_sculptures_finds_the_one_in_which_something_is_wrong(spoil, bubble):
    scenes = [Scene("physics: {burst: stop}\n") for _ in range(3)]
    looks = Looks(scenes)
    frames = [copied(s.frame) for s in scenes]
    assert looks.causes(frames) == [None] * 3
    frames = [copied(frame) for frame in frames]
    spoil(frames[1], scenes[1].of(bubble))
    scenes[1].check.failure(scenes[1].frame)
    cause = scenes[1].check.failure(frames[1])
    assert looks.causes(frames) == [None, cause, None]
    assert cause is not None
    # What has failed is nobody else's failure in the frames that follow.
    frames = [copied(frame) for frame in frames]
    assert looks.causes(frames)[::2] == [None, None]


def test_a_first_frame_that_is_no_number_is_found_among_others():
    scenes = [Scene() for _ in range(2)]
    frames = [copied(s.frame) for s in scenes]
    frames[0].points[0][:] = np.inf
    lost, well = Looks(scenes).causes(frames)
    assert lost.startswith("balloon main has flown apart")
    assert well is None


@pytest.mark.parametrize(
    ("text", "substeps", "words"),
    [
        (RECIPE, 100, "{substeps: 200} (100 now) or a longer step (seconds)"),
        (RECIPE, 2000, "the hands are too quick"),
        (
            RECIPE + "physics: {mass_scaling: none, substeps: 1950}\n",
            1950,
            "{substeps: 2000} or {mass_scaling",
        ),
        (
            AIR + "physics: {model: kosaka, kosaka: {push: 500, ks: 10}}\n",
            6,
            "leave out ks, push under physics",
        ),
        (AIR + "physics: {model: kosaka, substeps: 60}\n", 60, "leave out physics: substeps"),
        (AIR + "physics: {model: kosaka, gravity: 0.5}\n", 6, "{gravity: 0}"),
        (AIR + "physics: {model: kosaka}\n", 6, "too quick for its air"),
    ],
)
def test_the_remedy_is_the_setting_that_helps(text, substeps, words):
    assert words in steadier(Recipe.parse(text), substeps)


def test_a_failure_says_frame_time_step_and_cause():
    failed = SimulationFailed("pinch: nose", 1.25, "nose has flown apart", 31)
    assert str(failed) == "at 1.25 s (frame 31), pinch: nose: nose has flown apart"
    assert (failed.frame, SimulationFailed("hold", 1.0, "x").frame) == (31, None)
