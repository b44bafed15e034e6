"""Every shipped recipe comes out as a sculpture that one would accept from an artist's hands."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np

from balloon_usd.check import check_file, text_of
from balloon_usd.operations.moves import Weld
from tests.crossing import deepest_crossing

EXAMPLES = Path(__file__).parents[2] / "docs/examples"
DEEPEST = 1.0e-3
"""Deepest that a wall may lie inside another in the final frame, m."""
ON_RING = 1.0e-3
"""Unstressed distance from a joint up to which a vertex is on its ring, in R0: the next ring is far beyond."""
POSE_KEPT = 0.05
"""Largest change of a distance between two joints in the 2 s after the hands let go, share of the sculpture's size."""
SETTLED = 2.0e-3
"""Largest change of such a distance in the second of these seconds, m."""
TWINS_OFF = 0.006
"""Farthest that a leg or an ear of the dog may lie from the mirror image of the other, m."""
NECKS_APART = 0.012
"""Farthest that two necks of one twist may lie from each other, m."""


def distances(joints):
    return np.linalg.norm(joints[:, None] - joints[None], axis=2)


def on_necks(made):
    """Whether each vertex of a sculpture is on the ring of a closed neck."""
    found = []
    for strip, mesh in zip(made.plan.strips.values(), made.simulation.meshes[0], strict=True):
        necks = np.array([bubble.rest_end for bubble in strip.bubbles[:-1]])
        found.append((np.abs(mesh.along[:, None] - necks) < ON_RING * strip.size.radius).any(axis=1))
    return np.concatenate(found)


def deepest(made, asked):
    meshes = [mesh.quads for mesh in made.simulation.meshes[0]]
    return deepest_crossing(list(zip(made.last.points, meshes, strict=True)), asked)


def test_no_wall_passes_through_another_in_the_final_frame(made):
    crossing = deepest(made, ~on_necks(made))
    assert crossing.depth < DEEPEST, f"{crossing.depth * 1e3:.2f} mm at {crossing.place}"


def test_caps_close_over_necks_no_deeper_than_these_are_wide(made):
    crossing = deepest(made, on_necks(made))
    widest = 2.0 * max(body.neck_radius for body in made.simulation.model.scene.bodies)
    assert crossing.depth < widest, f"{crossing.depth * 1e3:.2f} mm at {crossing.place}"


def test_the_pose_is_kept_for_two_seconds_after_the_hands_let_go(made):
    start, end = distances(made.joints[0]), distances(made.joints[-1])
    assert len(made.joints) >= 2 * made.simulation.fps
    change = np.abs(end - start).max() / start.max()
    assert change < POSE_KEPT, f"a distance changes by {change:.1%} of the size"


def test_the_sculpture_has_come_to_rest_a_second_after_the_hands_let_go(made):
    one_second = int(made.simulation.fps)
    change = np.abs(distances(made.joints[-1]) - distances(made.joints[one_second])).max()
    assert change < SETTLED, f"a distance still changes by {change * 1e3:.1f} mm in a second"


def test_joints_that_are_twisted_into_one_lie_together(made):
    for move in made.plan.choreography.moves:
        if isinstance(move, Weld):
            necks = made.joints[-1][list(move.rings)]
            far = distances(necks).max()
            assert far < NECKS_APART, f"{move.text}: {far * 1e3:.1f} mm apart"


def test_every_bubble_is_full_and_none_has_burst(made):
    assert made.last.pressure.min() > 3.0e3, made.last.pressure
    load = made.summary.wall_load
    assert load.load < 0.95, f"{load.bubble} has {load.load:.0%} of the load at which it bursts"


def test_tails_are_as_planned_all_joints_hold_and_no_wall_lies_in_another(made):
    verdicts = {key: made.quality[key]["verdict"] for key in ("tail", "joints", "depth")}
    assert verdicts == {"tail": "good", "joints": "good", "depth": "good"}, made.quality


def test_twins_are_mirror_images_of_each_other(made):
    twins = made.quality["symmetric_place"]
    assert twins["verdict"] == "good", twins


def test_the_sides_of_the_dog_are_mirror_images_within_the_gap_between_its_necks(dog):
    # The two necks of a lock lie side by side, in no mirror.
    assert dog.quality["symmetric_place"]["value"] < TWINS_OFF


def test_the_figure_is_calm_in_the_end(made):
    assert made.quality["speed"]["verdict"] == "good", made.quality["speed"]


def test_every_balloon_has_flat_tail_left(made):
    for name, tail in made.summary.tails_left.items():
        assert tail > 0.0, name


def test_the_dog_uses_5_to_15_mm_of_flat_tail_for_every_twist(dog):
    twists = len(dog.plan.bubbles) - 1
    used = (dog.plan.strips["main"].tail - dog.summary.tails_left["main"]) / twists
    assert 5.0e-3 < used < 15.0e-3, f"{used * 1e3:.1f} mm"


def test_the_dog_stands_on_its_legs_with_ears_above_and_nose_before(dog):
    place = dict(zip([ring.name for ring in dog.plan.table.rings], dog.joints[-1], strict=True))
    neck, hips = place["neck.end"], place["body.end"]
    assert place["left_ear.end"][2] > neck[2] + 0.06
    assert place["left_foreleg.end"][2] < neck[2] - 0.08
    assert place["left_hindleg.end"][2] < hips[2] - 0.08
    assert place["main.knot"][0] < neck[0] - 0.08
    assert abs(place["left_foreleg.end"][2] - place["left_hindleg.end"][2]) < 0.05


def test_nothing_is_wrong_with_the_layers_that_the_examples_put_over_the_dog(dog):
    # One refers to another.
    files = [Path(shutil.copy(layer, dog.stage.parents[1])) for layer in EXAMPLES.glob("*.usda")]
    assert len(files) == 5
    for file in files:
        report = check_file(str(file))
        assert not report.unreadable
        assert report.faults == {}, text_of(report)


def test_nothing_is_wrong_with_its_stage_in_any_variant(made):
    shot = made.stage.parents[1] / f"{made.stage.stem}_shot.usda"
    for stage in (made.stage, shot):
        report = check_file(str(stage))
        assert not report.unreadable
        assert report.faults == {}, text_of(report)
        assert [name.split()[0] for name in report.validators] == ["usd-core", "usd-validation-nvidia"]
