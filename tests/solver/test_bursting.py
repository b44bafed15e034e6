"""How near a wall is to bursting is measured over all of it, and quickly passed by where it is far from it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.tube_theory import closed_tube_state
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.bursting import NEAR, Bursting
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.run_summary import RunSummary

TUBE = """\
format: 1
name: tube
units: cm
balloons: {main: {size: 260, tail: 5}}
steps: [{bubbles: {nose: 40, middle: 40}}, {rest: tail}]
"""


class Blown:
    """A tube whose rings are as a closed tube of some hoop stretch, in the detail draft or finer."""

    def __init__(self, detail="draft"):
        self.plan = plan(Recipe.parse(TUBE))
        self.strip = self.plan.strips["main"]
        self.mesh = mesh_of(self.strip, detail_named(detail))
        self.bursting = Bursting(self.plan, (self.mesh,))

    def frame(self, hoop, here=slice(None)):
        """The tube at its Maxwell stretch, and some vertices of it at another hoop stretch."""
        stretch = np.full(len(self.mesh.points), 5.66, dtype=np.float32)
        stretch[here] = hoop
        state = closed_tube_state(self.strip.rubber, float(np.max(hoop)))
        points = (self.mesh.points * np.sqrt(state.a * state.b)).astype(np.float32)
        one = np.ones(3, dtype=np.float32)
        return Frame(1, (points,), (stretch,), 1e3 * one, 1e-4 * one, "hold")

    def near(self, frame):
        stretch = frame.stretch[0]
        return self.bursting.near(0, stretch, float(stretch.max()))


@pytest.fixture(scope="module")
def blown():
    return Blown()


@pytest.mark.parametrize(("hoop", "bursts"), [(5.66, False), (6.9, False), (7.1, True)])
@pytest.mark.parametrize("detail", ["draft", "full"])
def test_a_tube_stretched_alike_all_over_bursts_at_seven(hoop, bursts, detail):
    tube = Blown(detail)
    assert (tube.bursting.load(tube.frame(hoop)).load > 1.0) == bursts


def test_a_run_with_one_vertex_beyond_seven_does_not_burst(blown):
    summary = RunSummary(blown.plan, (blown.mesh,))
    summary.add(blown.frame(7.6, here=500))
    assert summary.highest_stretch == pytest.approx(7.6)
    assert not summary.bursts


def test_a_crease_that_is_led_out_of_another_wall_does_not_burst(blown):
    crease = slice(400, 800)
    calm = blown.frame(5.66)
    stretch = calm.stretch[0].copy()
    stretch[crease] = 12.0
    stretched = replace(calm, stretch=(stretch,))
    assert blown.bursting.load(stretched).load > 1.0
    slowness = np.zeros(len(blown.mesh.points), dtype=np.float32)
    slowness[crease] = 1.0
    led = replace(stretched, slowness=(slowness,))
    assert blown.bursting.load(led).load < 1.0
    summary = RunSummary(blown.plan, (blown.mesh,))
    summary.add(led)
    assert not summary.bursts
    assert summary.highest_stretch == pytest.approx(5.66)


def test_what_bursts_beside_a_crease_that_is_led_is_told(blown):
    slowness = np.zeros(len(blown.mesh.points), dtype=np.float32)
    slowness[400:800] = 1.0
    assert blown.bursting.load(replace(blown.frame(7.3), slowness=(slowness,))).load > 1.0


def test_a_run_that_once_bursts_is_told_with_its_bubble(blown):
    summary = RunSummary(blown.plan, (blown.mesh,))
    middle = np.flatnonzero(np.abs(blown.mesh.along - 0.5 * sum(_ends(blown))) < 0.04)
    summary.add(blown.frame(8.0, here=middle))
    summary.add(blown.frame(5.66))
    assert summary.bursts
    assert summary.wall_load.load > 1.0
    assert summary.wall_load.bubble == "middle"


def _ends(blown):
    bubble = blown.strip.bubbles[1]
    return bubble.rest_start, bubble.rest_end


def test_nothing_that_bursts_is_passed_by(blown):
    rng = np.random.default_rng(7)
    passed = 0
    for _ in range(200):
        start = rng.integers(len(blown.mesh.points))
        here = slice(start, start + rng.integers(1, 1500))
        frame = blown.frame(rng.uniform(6.0, 8.5), here)
        passed += not blown.near(frame)
        assert blown.near(frame) or blown.bursting.load(frame).load < 1.0
    assert passed > 20


def test_the_quick_load_is_the_load_where_it_matters(blown):
    for hoop in (6.9, 7.0, 7.5):
        frame = blown.frame(hoop)
        assert blown.bursting.load(frame, NEAR).load == pytest.approx(
            blown.bursting.load(frame).load, rel=1e-3
        )


def test_springs_do_not_burst():
    air = "format: 1\nname: air\nunits: cm\nballoons: {main: {size: 260, capsule: 20}}\nsteps: [wait: 1]\n"
    flat = plan(Recipe.parse(air + "physics: {model: kosaka}\n"))
    meshes = tuple(mesh_of(strip, detail_named("draft")) for strip in flat.strips.values())
    points = 20.0 * meshes[0].points
    high = np.full(len(points), 9.0, dtype=np.float32)
    frame = Frame(1, (points,), (high,), np.ones(1, np.float32), np.ones(1, np.float32), "hold")
    assert Bursting(flat, meshes).load(frame).load == 0.0
