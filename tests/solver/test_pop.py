"""A popped bubble of latex: it tears, its gas is gone, its neighbours keep theirs, and its rags are flat."""

from __future__ import annotations

from functools import cache
from itertools import islice

import numpy as np
import pytest

from balloon_usd.operations.moves import SetDown
from balloon_usd.operations.pop import Pop
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.simulation import simulate_many

NAMES = ("before", "first", "gap", "second", "beyond")
ONE = """
format: 1
name: p
units: cm
balloons: {{main: {{size: 260, length: {length}, tail: 6}}}}
steps: {steps}
physics: {{hold: 0.5}}
"""


class Popped:
    """The example of the operation, with the gas of all bubbles and the place of their joints in each frame."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        self.simulation = simulate_many([self.plan], device="cpu")
        self.at = [bubble.name for bubble in self.plan.bubbles].index("gap")
        model = self.simulation.model
        self.gas, self.pressure, self.volume, self.apart, self.points = [], [], [], [], []
        self.began = None
        for (frame,) in self.simulation.frames():
            if self.began is None and frame.doing.startswith("pop"):
                self.began = len(self.gas)
            self.gas.append(model.scene.amount.numpy()[model.layout.bubbles])
            self.pressure.append(float(frame.pressure[self.at]))
            self.volume.append(float(frame.volume[self.at]))
            self.points.append(frame.points[0].copy())
            ends = [model.performers[0].sculpture.joints[ring] for ring in self.plan.table.ends("gap")]
            middle = model.scene.ring_middle.numpy()[ends]
            self.apart.append(float(np.linalg.norm(middle[1] - middle[0])))
        self.stretch = frame.stretch[0].copy()

    @property
    def rims(self):
        """Vertices of the rims of its two rags."""
        rings = self.simulation.model.performers[0].sculpture.severed["gap"].stub.rings
        return rings[0], rings[-1]

    @property
    def ends(self):
        """Vertices of its two joints."""
        sculpture = self.simulation.model.performers[0].sculpture
        first, around = sculpture.hands.rings
        joints = [sculpture.joints[ring] for ring in self.plan.table.ends("gap")]
        return [np.arange(first[joint], first[joint] + around[joint]) for joint in joints]

    @property
    def shut(self):
        """Number of the last frame before the pop."""
        return self.began - 1


@pytest.fixture(scope="module")
def popped():
    return Popped(Pop.example + "physics: {hold: 0.5}\n")


def test_the_gas_of_a_popped_bubble_is_gone_within_an_eighth_of_a_second(popped):
    assert popped.pressure[popped.shut] > 7.0e3
    # It begins and ends between frames.
    assert popped.pressure[popped.shut + 4] == 0.0
    assert popped.gas[-1][popped.at] == 0.0


def test_its_neighbours_keep_all_of_theirs(popped):
    others = [k for k in range(len(NAMES)) if k != popped.at]
    assert popped.gas[-1][others] == pytest.approx(popped.gas[popped.shut][others], rel=1e-6)


def test_its_rags_snap_back_in_one_frame_to_half_of_its_rubber_when_flat(popped):
    rest = popped.plan.bubbles[popped.at].rest_length
    after = popped.points[popped.began :]
    reach = np.array(
        [
            [np.linalg.norm(points[rim].mean(axis=0) - points[ring].mean(axis=0)) for points in after]
            for rim, ring in zip(popped.rims, popped.ends, strict=True)
        ]
    )
    # Before, each half was drawn to one and a half times the rubber of the whole bubble.
    assert (reach[:, 0] < 0.5 * rest).all()
    assert (np.median(reach, axis=1) < 0.4 * rest).all()
    assert (reach < 0.6 * rest).all()


def test_what_is_open_holds_no_gas(popped):
    assert popped.volume[popped.shut] == pytest.approx(popped.plan.bubbles[popped.at].volume, rel=0.05)
    assert set(popped.volume[popped.began :]) == {0.0}


def test_ears_that_it_kept_apart_spring_to_the_bubbles_behind_them(popped):
    # Nothing holds the two parts together any more.
    assert popped.apart[popped.shut] == pytest.approx(popped.plan.bubbles[popped.at].length, rel=0.1)
    assert popped.apart[-1] > 1.4 * popped.apart[popped.shut]


def test_what_is_gone_is_a_thread_that_no_picture_shows(popped):
    torn = popped.simulation.model.performers[0].sculpture.severed["gap"].stub
    last = popped.points[-1]
    for ring in torn.rings[1:-1]:
        assert np.linalg.norm(last[ring] - last[ring].mean(axis=0), axis=1).max() < 3.0e-5
    quads = popped.simulation.meshes[0][0].quads
    for points in popped.points[popped.began :]:
        corners = points[quads].astype(float)
        halves = [np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])]
        halves.append(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 0]))
        assert np.linalg.norm(np.concatenate(halves), axis=1).min() > 2.0e-12


def test_what_hangs_on_it_jumps_and_comes_to_rest(popped):
    ways = [np.abs(now - before).max() for before, now in zip(popped.points, popped.points[1:], strict=False)]
    fps = popped.plan.recipe.fps
    assert max(ways[popped.shut : popped.shut + 12]) * fps > 0.3
    assert ways[-1] * fps < 2.0e-3


def test_no_wall_goes_through_another_and_no_vertex_is_lost(popped):
    counter = CrossingCounter(walls_of(popped.plan, popped.simulation.meshes[0]), 100)
    for points in popped.points[popped.shut :: 6]:
        assert counter.count((points,)).count == 0
    assert {len(points) for points in popped.points} == {len(popped.points[0])}


def last_frame(text):
    """Return the simulation of a recipe, its plan and its last frame."""
    planned = plan(Recipe.parse(text))
    simulation = simulate_many([planned], device="cpu")
    for (frame,) in simulation.frames():
        last = frame
    return simulation, planned, last


def test_the_rest_of_a_balloon_can_be_popped_and_hangs_limp():
    steps = "[{bubbles: {before: 5}}, {ear: {ear: 3}}, {rest: beyond}, {pop: beyond}]"
    _, planned, last = last_frame(ONE.format(length=13, steps=steps))
    assert last.pressure[2] == 0.0
    assert last.pressure[0] == pytest.approx(planned.bubbles[0].pressure, rel=0.05)
    assert last.volume[2] < 0.05 * planned.bubbles[2].volume


@pytest.mark.parametrize(
    ("steps", "popped"),
    [
        ("[{bubbles: {a: 4}}, {ear: {e: 3}}, {pop: a}]", "a"),
        ("[{bubbles: {a: 5}}, {loop: {l: 16}}, {pop: l}]", "l"),
    ],
)
def test_limp_rubber_may_turn_inside_out(steps, popped):
    _, planned, last = last_frame(ONE.format(length=17, steps=steps))
    assert isinstance(last, Frame)
    assert last.time_code == planned.frame_count
    assert last.pressure[[bubble.name for bubble in planned.bubbles].index(popped)] == 0.0


class Posed:
    """The example of the operation in a pose: its last frame, and the crossings while hands carry its parts and after."""

    def __init__(self, pose):
        self.plan = plan(Recipe.parse(f"{Pop.example}pose: {pose}\nphysics: {{hold: 0.5}}\n"))
        self.simulation = simulate_many([self.plan], device="cpu")
        self.sculpture = self.simulation.model.performers[0].sculpture
        counter = CrossingCounter(walls_of(self.plan, self.simulation.meshes[0]), 100)
        begin = next(move.start for move in self.plan.choreography.moves if isinstance(move, SetDown))
        self.crossings = []
        for (frame,) in self.simulation.frames():
            if frame.time_code > begin * self.plan.recipe.fps and frame.time_code % 2:
                self.crossings.append(counter.count(frame.points).count)
            self.last = frame

    @property
    def parts(self):
        """Where the vertices of each of its parts are, (V, 3), m."""
        return [self.last.points[0][part] for part in self.sculpture.parts]


@cache
def posed(pose):
    return Posed(pose)


STAND, HANG, DROP = "stand", "hang", "drop\nheight: 30"


def test_each_part_of_a_figure_that_comes_apart_stands_by_itself_and_beside_the_other():
    standing = posed(STAND)
    parts = standing.sculpture.parts
    assert len(parts) == 2
    assert sorted(np.concatenate(parts).tolist()) == list(range(len(standing.last.points[0])))
    first, second = standing.parts
    # Under its weight rubber is pressed into the ground by some hundredths of a millimetre.
    assert abs(float(first[:, 2].min())) < 1.0e-3
    assert abs(float(second[:, 2].min())) < 1.0e-3
    assert first[:, 0].max() < second[:, 0].min() or second[:, 0].max() < first[:, 0].min()
    quality = QualityWatch(standing.plan, standing.simulation.meshes[0])
    quality.add(standing.last)
    assert quality.data()["lean"]["verdict"] == "none"


@pytest.mark.parametrize("pose", [STAND, HANG, DROP], ids=["stand", "hang", "drop"])
def test_parts_that_hands_carry_to_their_places_do_not_go_through_each_other(pose):
    assert len(posed(pose).crossings) > 30
    assert not any(posed(pose).crossings)


def test_each_part_hangs_on_a_thread_of_its_own():
    hanging = posed(HANG)
    first, around = hanging.sculpture.hands.rings
    for part in hanging.sculpture.parts:
        # Vertices are denser in a rag than in a bubble: their mean is not where the weight is.
        centre = hanging.sculpture.centre(hanging.last.points[0].astype(np.float64), part)
        joints = hanging.sculpture.outer_joints(part)
        own = [np.arange(first[joint], first[joint] + around[joint]) for joint in joints]
        middles = np.array([hanging.last.points[0][ring].mean(axis=0) for ring in own])
        # One of its joints is where the thread ends, and its centre hangs below that.
        thread = middles[np.abs(middles[:, 2]).argmin()]
        assert thread[2] == pytest.approx(0.0, abs=1e-4)
        assert np.linalg.norm((centre - thread)[:2]) < 0.001
        assert centre[2] < -0.01


def test_parts_that_are_dropped_fall_each_by_itself():
    lows = [float(part[:, 2].min()) for part in posed(DROP).parts]
    assert np.abs(lows).max() < 1.0e-3


def test_a_bubble_at_a_knot_that_is_tied_tears_too_and_a_ring_of_which_one_is_popped_stays_one():
    steps = "[{bubbles: {a: 5}}, {ear: {e: 3}}, {bubbles: {b: 5}}, {ear: {f: 3}}, {tie: {end: a.start, to: f.end}}, {pop: a}]"
    simulation, planned, last = last_frame(ONE.format(length=17, steps=steps))
    assert planned.bubbles[0].tears
    assert len(simulation.model.performers[0].sculpture.parts) == 1
    assert CrossingCounter(walls_of(planned, simulation.meshes[0]), 1).count(last.points).count == 0


def test_rags_may_fly_faster_than_hands_move_anything():
    """An ear of which the whole wall is stretched."""
    text = "format: 1\nname: p\nunits: cm\nballoons: {main: {size: 350, length: 24, tail: 8}}\nsteps:\n"
    text += "  - bubbles: {a: 8}\n  - ear: {e: 5}\n  - ear: {f: 5}\n  - bubbles: {b: 8}\n  - ear: {g: 5}\n  - pop: f\n"
    planned = plan(Recipe.parse(text + "physics: {hold: 0.5}\n"))
    simulation = simulate_many([planned], device="cpu")
    summary = RunSummary(planned, simulation.meshes[0])
    for (frame,) in simulation.frames():
        summary.add(frame)
        last = frame
    assert last.time_code == planned.frame_count
    assert last.volume[[bubble.name for bubble in planned.bubbles].index("f")] == 0.0
    # And what they are stretched meanwhile bursts nothing.
    assert summary.wall_load.load < 1.0


def test_a_figure_with_a_pop_has_the_same_bits_alone_and_beside_others(popped):
    at = popped.plan.frame_count - 1
    other = plan(Recipe.parse(ONE.format(length=10, steps="[{bubbles: {a: 4}}, {ear: {e: 3}}, {pop: a}]")))
    both = simulate_many([other, popped.plan], device="cpu").frames()
    beside = next(frames[-1] for frames in islice(both, at, at + 1))
    assert popped.points[-1].tobytes() == beside.points[0].tobytes()
    assert popped.stretch.tobytes() == beside.stretch[0].tobytes()
