"""The quality of a figure: each measure, its verdict, and how it is told."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.wound_neck import holding_friction
from balloon_usd.operations.moves import LetGo
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.quality.joints import hang_together, joints_of
from balloon_usd.quality.line import quality_line
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.ranking import worst_first
from balloon_usd.quality.symmetry import mirrored
from balloon_usd.quality.watch import QualityWatch, counted_over_time
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from tests.quality.ears import EARS, points_of

RECIPES = Path(__file__).parents[2] / "recipes"


@pytest.fixture(scope="module")
def figure():
    """A plan and its meshes."""
    plan = plan_of(Recipe.parse(EARS, file="ears.yaml"))
    return plan, [mesh_of(strip, detail_named("draft")) for strip in plan.strips.values()]


def as_planned(plan, meshes, code, **changes):
    """A frame in which everything is as the plan says."""
    around = np.pi / meshes[0].around
    polygon = np.tan(around) / around
    volume = np.array([bubble.volume * polygon for bubble in plan.bubbles], dtype=np.float32)
    pressure = np.array([bubble.pressure for bubble in plan.bubbles], dtype=np.float32)
    frame = Frame(code, (points_of(plan, meshes),), (np.ones(1, dtype=np.float32),), pressure, volume, "hold")
    return replace(frame, **changes)


def quality_of(figure, change=lambda frame: frame):
    """The quality of a figure that is as planned in every frame, but for what is changed in it."""
    watch = QualityWatch(*figure)
    for code in range(1, figure[0].frame_count + 1):
        watch.add(change(as_planned(*figure, code)))
    return watch.data()


@pytest.fixture(scope="module")
def still(figure):
    return quality_of(figure)


def test_every_measure_has_a_value_a_unit_a_limit_and_a_verdict(still):
    assert list(still) == ["verdict", "off", *MEASURES]
    for key, measure in MEASURES.items():
        assert {"value", "unit", "limit", "verdict"} <= set(still[key])
        assert (still[key]["unit"], still[key]["limit"]) == (measure.unit, measure.limit)
    assert json.loads(json.dumps(still, allow_nan=False)) == still


def test_gas_as_planned_is_good_and_what_a_bubble_lacks_is_told_by_its_name(figure, still):
    assert still["gas"]["value"] < 1e-4

    def leaky(frame):
        volume = frame.volume.copy()
        volume[3] *= 0.7
        return replace(frame, volume=volume)

    gas = quality_of(figure, leaky)["gas"]
    assert gas["value"] == pytest.approx(0.3, abs=1e-3)
    assert gas["each"]["neck"] == pytest.approx(-0.3, abs=1e-3)
    assert (gas["worst"], gas["verdict"]) == ("neck", "off")


def test_the_tail_is_measured_after_each_twist(figure, still):
    assert list(still["tail"]["each"]) == ["nose", "left_ear", "right_ear", "neck"]
    lost = 1e-2 * np.pi * 0.025**2

    def leaky(frame):
        volume = frame.volume.copy()
        volume[4] -= lost
        return replace(frame, volume=volume)

    before, after = still["tail"]["each"], quality_of(figure, leaky)["tail"]["each"]
    # The same gas is missing behind every twist, so the tail is longer by the same.
    longer = [after[name] - before[name] for name in before]
    assert min(longer) > 1e-3
    assert longer == pytest.approx([longer[0]] * 4, abs=3e-4)


def test_what_rests_is_calm_and_has_not_crept(still):
    assert (still["speed"]["value"], still["creep"]["value"]) == (0.0, 0.0)


def test_the_speed_is_that_of_the_last_half_second(figure):
    plan, fps = figure[0], figure[0].recipe.fps
    late = plan.frame_count - round(0.5 * fps)

    def moves(frame):
        # What is faster before does not count.
        early, way = min(frame.time_code, late), max(frame.time_code - late, 0)
        return replace(frame, points=(frame.points[0] + np.float32([0.1 * early, 0.002 * way, 0]),))

    assert quality_of(figure, moves)["speed"]["value"] == pytest.approx(0.002 * fps, rel=1e-3)


def test_the_creep_is_the_way_since_the_hands_let_go_and_the_second_half_of_it_is_told(figure):
    plan = figure[0]
    let_go = next(m.start for m in plan.choreography.moves if isinstance(m, LetGo) and m.for_good)
    code = 1 + round(let_go * plan.recipe.fps)
    half = (code + 1 + int(plan.choreography.taken_up * plan.recipe.fps)) // 2

    def creeps(frame):
        far = (
            0.1 * (frame.time_code >= code)
            + 0.002 * (frame.time_code > code)
            + 0.001 * (frame.time_code > half)
        )
        return replace(frame, points=(frame.points[0] + np.float32([0, 0, far]),))

    creep = quality_of(figure, creeps)["creep"]
    assert creep["value"] == pytest.approx(0.003, rel=1e-3)
    assert creep["second_half"] == pytest.approx(0.001, rel=1e-3)
    assert creep["verdict"] == "good"


def test_a_figure_that_comes_undone_has_no_creep_and_what_came_undone_is_told(figure, still):
    creep = quality_of(figure, lambda frame: replace(frame, undone=("neck.end",)))["creep"]
    assert (creep["value"], creep["verdict"], creep["undone"]) == (None, "none", ["neck.end"])
    assert "comes undone (neck.end)" in quality_line({**still, "creep": creep})


def test_bubbles_that_share_their_gas_across_a_joint_that_came_undone_are_left_out(figure):
    def joined(frame):
        volume = frame.volume.copy()
        volume[0] *= 0.5
        return replace(frame, volume=volume, undone=("nose.end",))

    gas = quality_of(figure, joined)["gas"]
    assert gas["verdict"] == "good"
    assert {"nose", "left_ear"}.isdisjoint(gas["each"])


def test_what_is_squeezed_has_its_gas_and_tells_how_much_smaller_it_is(figure, still):
    assert still["squeezed"]["value"] < 1e-3

    def pressed(frame):
        volume, pressure = frame.volume.copy(), frame.pressure.copy()
        pressure[3] = 1.5 * (ATMOSPHERE + pressure[3]) - ATMOSPHERE
        volume[3] /= 1.5
        return replace(frame, volume=volume, pressure=pressure)

    quality = quality_of(figure, pressed)
    assert quality["gas"]["value"] < 1e-3
    assert quality["squeezed"]["each"]["neck"] == pytest.approx(1.0 / 3.0, abs=1e-3)
    assert (quality["squeezed"]["worst"], quality["squeezed"]["verdict"]) == ("neck", "off")
    assert "neck squeezed by 33 %" in quality_line(quality)


def test_the_joints_that_are_meant_to_hold_are_those_of_the_finished_piece_that_do_not_untwist(figure):
    joints = {joint.name: joint.holds for joint in joints_of(figure[0])}
    assert joints == {"nose.start": False, "nose.end": True, "left_ear.end": True, "neck.end": False}
    assert [str(loose.end) for loose in figure[0].loose] == ["neck.end"]


def test_joints_hold_where_necks_are_closed_and_together(figure, still):
    joints = still["joints"]
    assert (joints["held"], joints["meant"], joints["lost"], joints["verdict"]) == (2, 2, [], "good")


def test_an_open_neck_a_parted_joint_and_what_the_simulation_tells_of_are_lost(figure):
    (mesh,), plan = figure[1], figure[0]
    tip = mesh.along > plan.bubbles[2].rest_end - 1e-6
    open_here = np.abs(mesh.along - plan.bubbles[1].rest_end) < 1e-4

    def opened(frame):
        wide = mesh.points * np.float32([0, 1, 1]) * 4.0
        return replace(frame, points=(frame.points[0] + open_here[:, None] * wide,))

    def parted(frame):
        return replace(frame, points=(frame.points[0] + tip[:, None] * np.float32([0.02, 0, 0]),))

    assert quality_of(figure, opened)["joints"]["lost"] == ["left_ear.end"]
    assert quality_of(figure, parted)["joints"]["lost"] == ["nose.end"]
    told = quality_of(figure, lambda frame: replace(frame, undone=("left_ear.end", "neck.end")))["joints"]
    assert (told["lost"], told["undone"]) == (["left_ear.end"], ["left_ear.end", "neck.end"])


def by_joint(quality):
    """What has become of every joint, by its name."""
    return {each["joint"]: each for each in quality["joints"]["each"]}


def test_every_joint_says_whether_it_held_and_with_how_much_friction(still):
    each = by_joint(still)
    assert list(each) == ["nose.end", "left_ear.end", "neck.end"]
    assert [joint["meant"] for joint in each.values()] == [True, True, False]
    assert each["nose.end"]["ends"] == ["nose.end", "left_ear.start", "right_ear.end", "neck.start"]
    assert each["nose.end"]["margin"] == pytest.approx(0.8 / holding_friction(3.0), abs=0.01)
    assert each["left_ear.end"]["margin"] is None
    assert {name: joint["bears"] for name, joint in each.items()} == {
        "nose.end": pytest.approx(0.8 * 3.75),
        "left_ear.end": None,
        "neck.end": None,
    }
    for joint in each.values():
        assert (joint["held"], joint["undone_at"]) == (True, None)
        assert (joint["slip"], joint["turn"]) == (0.0, 0.0)


def test_a_joint_says_the_largest_force_of_its_friction_from_the_let_go_on(figure):
    plan = figure[0]
    code = 1 + round(plan.choreography.let_go * plan.recipe.fps)

    def pulled(frame):
        force = np.zeros((len(plan.bubbles), 2), dtype=np.float32)
        force[2, 1], force[3, 1] = 1.25, 2.5
        if frame.time_code < code:
            force[0, 1] = 3.0
        return replace(frame, joint_force=force)

    each = by_joint(quality_of(figure, pulled))
    assert (each["nose.end"]["force"], each["left_ear.end"]["force"]) == (1.25, None)


def test_a_joint_says_how_far_its_necks_and_its_bubbles_have_given_way(figure):
    (mesh,), plan = figure[1], figure[0]
    code = 1 + round(plan.choreography.let_go * plan.recipe.fps)
    behind = mesh.along > plan.bubbles[3].rest_start - 1e-6
    beside = behind & (mesh.along > plan.bubbles[3].rest_start + 1e-4)

    def gives_way(frame):
        if frame.time_code <= code:
            return frame
        away = behind[:, None] * np.float32([0.004, 0, 0]) + beside[:, None] * np.float32([0, 0.01, 0])
        return replace(frame, points=(frame.points[0] + away,))

    before, after = (by_joint(quality_of(figure, change)) for change in (lambda frame: frame, gives_way))
    assert after["nose.end"]["held"]
    assert after["nose.end"]["slip"] == pytest.approx(0.004, abs=2e-3)
    assert after["nose.end"]["turn"] > 5.0
    assert after["left_ear.end"] == before["left_ear.end"]


def test_a_joint_says_when_it_came_undone_and_the_whole_figure_may_move(figure):
    plan = figure[0]
    code = 1 + round(plan.choreography.let_go * plan.recipe.fps)

    def undone(frame):
        late = frame.time_code - code
        moved = replace(frame, points=(frame.points[0] + np.float32([0.1 * max(late, 0), 0, 0]),))
        return replace(moved, undone=("neck.end",)) if late >= 7 else moved

    each = by_joint(quality_of(figure, undone))
    assert not each["neck.end"]["held"]
    assert each["neck.end"]["undone_at"] == pytest.approx((code + 6) / plan.recipe.fps, abs=1e-3)
    assert each["nose.end"]["held"]
    assert each["nose.end"]["turn"] == pytest.approx(0.0, abs=0.01)


def test_necks_that_part_come_undone_when_they_do_even_if_nothing_tells_it(figure):
    (mesh,), plan = figure[1], figure[0]
    tip = mesh.along > plan.bubbles[2].rest_end - 1e-6
    code = 1 + round((plan.choreography.let_go + 1.0) * plan.recipe.fps)

    def parted(frame):
        far = np.float32([0.02 if frame.time_code >= code else 0.0, 0, 0])
        return replace(frame, points=(frame.points[0] + tip[:, None] * far,))

    each = by_joint(quality_of(figure, parted))
    assert each["nose.end"]["undone_at"] == pytest.approx((code - 1) / plan.recipe.fps, abs=0.51)


def kept(figure, wanted, undone):
    """What is told of joints that must hold and have not, where some come undone in frame 25, after 1 s."""
    plan, meshes = figure
    recipe = Recipe.parse(EARS + (f"must_hold: {wanted}\n" if wanted else ""))
    watch = QualityWatch(plan_of(recipe), meshes)
    for code in range(1, plan.frame_count + 1):
        watch.add(as_planned(plan, meshes, code, undone=undone if code >= 25 else ()))
    return list(watch.unkept())


def test_joints_that_must_hold_as_planned_are_those_that_are_meant_to(figure):
    assert kept(figure, "planned", ()) == []
    assert kept(figure, "planned", ("left_ear.end",)) == ["left_ear.end came undone at 1.0 s"]
    # The twist behind the neck is let go.
    assert kept(figure, "planned", ("neck.end",)) == []
    # A lock that slips as planned is none of these.
    assert kept(figure, "planned", ("nose.end = right_ear.end",)) == []


def test_a_recipe_says_which_joints_must_hold(figure):
    both = ("left_ear.end", "neck.end")
    assert kept(figure, "none", both) == []
    assert kept(figure, "", both) == kept(figure, "all", both)
    assert kept(figure, "all", both) == ["left_ear.end came undone at 1.0 s", "neck.end came undone at 1.0 s"]
    assert kept(figure, "[tail.start]", both) == ["tail.start came undone at 1.0 s"]
    assert kept(figure, "[neck.start]", both) == []
    slipped = ("nose.end = right_ear.end",)
    assert kept(figure, "[left_ear.start]", slipped) == ["left_ear.start came undone at 1.0 s"]


def test_necks_in_a_rowhang_together_and_a_gap_parts_them():
    row = np.linspace([0.0, 0.0, 0.0], [0.05, 0.0, 0.0], 6)
    assert hang_together(row[[3, 0, 5, 1, 4, 2]], 0.011)
    assert not hang_together(row[[0, 1, 2, 4, 5]], 0.011)


def test_walls_that_cross_are_told_with_their_bubbles_and_depth(figure, still):
    (mesh,), plan = figure[1], figure[0]
    tail = mesh.along > plan.bubbles[3].rest_end + 0.01
    assert still["crossings"]["value"] == still["depth"]["value"] == 0

    def through(frame):
        moved = frame.points[0].copy()
        nose = np.flatnonzero(np.abs(mesh.along - 0.5 * plan.bubbles[0].rest_end) < 0.004)
        moved[tail] += moved[nose].mean(axis=0) - moved[tail].mean(axis=0) + np.float32([0, 0.0005, 0.0003])
        return replace(frame, points=(moved,))

    quality = quality_of(figure, through)
    crossings = quality["crossings"]
    assert crossings["value"] == sum(each["count"] for each in crossings["bubbles"]) > 0
    assert crossings["bubbles"][0]["pair"] == ["nose", "tail"]
    assert 0.0 < quality["depth"]["value"] < 0.002


def test_walls_that_cross_within_one_neck_are_told_apart(figure, still):
    (mesh,), plan = figure[1], figure[0]
    assert still["crossings"]["in_necks"] == 0
    neck = np.abs(mesh.along - plan.bubbles[1].rest_end) < 1e-5
    crumple = np.random.default_rng(1).uniform(-1.5e-3, 1.5e-3, (int(neck.sum()), 3))

    def crumpled(frame):
        moved = frame.points[0].copy()
        moved[neck] += crumple.astype(np.float32)
        return replace(frame, points=(moved,))

    crossings = quality_of(figure, crumpled)["crossings"]
    assert crossings["in_necks"] > 10
    assert (crossings["value"], crossings["verdict"]) == (0, "good")


@pytest.mark.parametrize(("drawn", "verdict"), [(0.0, "good"), (0.03, "off")])
def test_rubber_of_a_neck_that_is_blown_up_inside_its_bubble_is_told_with_its_joint(figure, drawn, verdict):
    """It goes through itself far from its joint."""
    (mesh,), plan = figure[1], figure[0]
    end = plan.bubbles[1].rest_end
    row = np.flatnonzero((mesh.along < end - 1e-5) & (mesh.along > end - plan.strips["main"].size.radius))
    ring = np.abs(mesh.along - end) < 1e-5
    crumple = np.random.default_rng(1).uniform(-3e-3, 3e-3, (len(row), 3)).astype(np.float32)

    def blown(frame):
        moved = frame.points[0].copy()
        moved[row] = moved[ring].mean(axis=0) + crumple - np.float32([drawn, 0.0, 0.0])
        return replace(frame, points=(moved,))

    quality = quality_of(figure, blown)
    necks = quality["necks"]
    assert quality["crossings"]["in_necks"] > 10
    assert necks["verdict"] == verdict
    assert necks["joint"] == f"{plan.bubbles[1].name}.end"
    assert necks["away"] == pytest.approx(drawn, abs=0.01)
    assert ("wall drawn in" in quality_line(quality)) == (drawn > 0.0)


def test_crossings_are_counted_twice_a_second_and_the_most_are_told_with_their_frame(figure):
    plan, meshes = figure
    codes = range(1, plan.frame_count + 1)
    counted = counted_over_time(plan, codes)
    assert counted[:3] == [1, 13, 25]
    assert counted[-1] == plan.frame_count
    watch = QualityWatch(plan, meshes, counted)
    for code in codes:
        frame = as_planned(plan, meshes, code)
        if code in (25, 26):
            # The end of the tail lies in its beginning.
            (x,) = (points[:, 0] for points in frame.points)
            frame.points[0][x > x.max() - 0.01] -= np.float32([0.02, 0.0005, 0.0003])
        watch.add(frame)
    crossings = watch.data()["crossings"]
    assert crossings["value"] == 0
    assert crossings["most"] > 20
    assert crossings["most_at"] == 25
    assert list(watch.crossings.frames) == sorted(set(counted))
    assert watch.crossings.facts(plan.frame_count) == {"crossings": 0}


def test_a_loop_of_two_ears_is_its_own_mirror_image_and_an_ear_that_is_turned_is_not(figure, still):
    assert still["symmetric_place"]["value"] < 1e-3
    assert still["symmetric_volume"]["value"] == 0.0
    assert still["symmetric_length"]["value"] < 0.01
    (mesh,), plan = figure[1], figure[0]
    right = (mesh.along > plan.bubbles[1].rest_end) & (mesh.along < plan.bubbles[2].rest_end)

    def turned(frame):
        moved = frame.points[0].copy()
        moved[right, 0] += 3.0 * moved[right, 2]
        return replace(frame, points=(moved,))

    assert quality_of(figure, turned)["symmetric_place"]["verdict"] == "off"


def test_pairs_have_one_mirror():
    line = np.linspace([0.0, 0.1, 0.0], [0.2, 0.2, 0.1], 9)
    image = line * [1, -1, 1]
    lower, lower_image = line - [0, 0, 0.3], image - [0, 0, 0.3]
    assert max(mirrored({"a": (line, image), "b": (lower, lower_image[::-1])}).values()) < 1e-12
    aside = mirrored({"a": (line, image), "b": (lower + [0, 0.02, 0], lower_image + [0, 0.02, 0])})
    assert min(aside.values()) > 0.01


def test_a_figure_whose_last_frame_was_not_seen_has_no_quality(figure):
    watch = QualityWatch(*figure)
    for code in range(1, figure[0].frame_count):
        watch.add(as_planned(*figure, code))
    assert watch.data() is None


@pytest.mark.parametrize(
    ("recipe", "nothing"),
    [
        # A balloon of it is not twisted.
        ("book/maple_nj", {"symmetric_volume", "symmetric_length", "symmetric_place"}),
        # Capsules have no tail, nothing holds their twists.
        (
            "kosaka/bubbles",
            {"tail", "joints", "squeezed", "symmetric_volume", "symmetric_length", "symmetric_place"},
        ),
        (
            "meshes/heart",
            {"tail", "joints", "squeezed", "symmetric_volume", "symmetric_length", "symmetric_place"},
        ),
    ],
)
def test_figures_of_any_kind_are_measured_in_what_they_have(recipe, nothing):
    plan = plan_of(Recipe.load(RECIPES / f"{recipe}.yaml"))
    meshes = [mesh_of(strip, detail_named("draft")) for strip in plan.strips.values()]
    watch = QualityWatch(plan, meshes)
    points = tuple(mesh.points + np.float32([0, 0.3 * k, 0]) for k, mesh in enumerate(meshes))
    volume = np.array([bubble.volume for bubble in plan.bubbles], dtype=np.float32)
    pressure = np.array([bubble.pressure or 0.0 for bubble in plan.bubbles], dtype=np.float32)
    for code in range(1, plan.frame_count + 1):
        watch.add(Frame(code, points, (), pressure, volume, "hold"))
    data = watch.data()
    # None of them is put on its feet.
    nothing |= {"lean", "passed", "unwound"}
    assert {key for key in MEASURES if data[key]["verdict"] == "none"} == nothing
    assert data["crossings"]["value"] == 0
    assert quality_line(data).startswith("gas within ")


def test_the_line_tells_all_and_names_what_is_worst(figure, still):
    line = quality_line(still)
    assert "calm (0.0 mm/s), stays (0.0 mm), 2 of 2 joints held, 0 crossings, symmetric to" in line
    assert line.startswith("gas within 0.0 %, tail ")

    def leaky(frame):
        return replace(frame, volume=0.5 * frame.volume, undone=("left_ear.end",))

    told = quality_line(quality_of(figure, leaky))
    assert told.startswith("gas 50.0 % off (")
    assert "1 of 2 joints held (left_ear.end not)" in told


def test_figures_are_sorted_by_what_went_wrong(still):
    def off(*keys, value=1.0):
        return {**still, "off": list(keys), **{key: {**still[key], "value": value} for key in keys}}

    figures = {
        "good": off(),
        "gas": off("gas", value=0.2),
        "worse gas": off("gas", value=0.4),
        "both": off("gas", "tail"),
    }
    order = worst_first(figures, figures.__getitem__)
    assert order == ["both", "worse gas", "gas", "good"]
    assert all(len(figures[a]["off"]) >= len(figures[b]["off"]) for a, b in pairwise(order))


@pytest.mark.parametrize(("degrees", "told"), [(3.0, "stands, leaning 3.0 degrees"), (70.0, "fell over")])
def test_a_figure_that_stands_tells_how_far_it_leans(degrees, told):
    plan = plan_of(Recipe.parse(EARS + "pose: stand\nfront: left\n"))
    meshes = [mesh_of(strip, detail_named("draft")) for strip in plan.strips.values()]
    angle = np.radians(degrees)
    facing = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    leaning = np.array(
        [[1.0, 0.0, 0.0], [0.0, np.cos(angle), -np.sin(angle)], [0.0, np.sin(angle), np.cos(angle)]]
    )

    def leans(frame):
        if frame.time_code < plan.frame_count:
            return frame
        turned = frame.points[0].astype(float) @ (leaning @ facing).T + [0.1, 0.2, 0.3]
        return replace(frame, points=(turned.astype(np.float32),))

    found = quality_of((plan, meshes), leans)
    assert found["lean"]["value"] == pytest.approx(degrees, abs=0.1)
    assert found["lean"]["verdict"] == ("good" if degrees < 15.0 else "off")
    assert told in quality_line(found)
    assert found["lean"]["feet"]
