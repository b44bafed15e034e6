"""Limbs that hands turn about their joints: they point where the recipe says, and stay there by friction."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.operations.aim import Aim
from balloon_usd.operations.moves import Aim as AimMove
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.simulation import simulate_many

LOOP = """
format: 1
name: stick
units: cm
balloons:
  main: {size: 260, length: 18, tail: 5}
steps:
  - bubbles: {stalk: 9}
  - loop: {leaf: 26}
    point: left
  - rest: stem
"""


class Aimed:
    """Where the rings of a figure are at the let-go and in the end, and how often walls cross in the end."""

    def __init__(self, aims):
        self.plan = plan(Recipe.parse(LOOP + aims + "physics: {hold: 2}\n"))
        simulation = simulate_many([self.plan], device="cpu")
        ((mesh,),) = simulation.meshes
        counter = CrossingCounter(walls_of(self.plan, (mesh,)), 100)
        let_go = 1 + round(self.plan.choreography.let_go * self.plan.recipe.fps)
        for (frame,) in simulation.frames():
            if frame.time_code in (let_go, self.plan.frame_count):
                points = frame.points[0].astype(float)
                middles = points[mesh.ring_start[:, None] + np.arange(mesh.around)].mean(axis=1)
                places = np.array([middles[mesh.ring_at(ring.along)] for ring in self.plan.table.rings])
                if frame.time_code == let_go:
                    self.at_let_go = places
                self.points, self.places = points, places
        self.crossings = counter.count(frame.points).count

    def arms(self, places):
        """Where the rings of the loop are, from its joint, (N, 3), m."""
        return places[list(self.plan.table.guides("leaf"))] - places[self.plan.table.ends("leaf")[0]]

    @property
    def pointing(self):
        """Unit direction of the loop, (3,)."""
        middle = self.arms(self.places).mean(axis=0)
        return middle / np.linalg.norm(middle)


@pytest.fixture(scope="module")
def as_made():
    return Aimed("")


@pytest.fixture(scope="module")
def up():
    return Aimed("  - aim: {leaf: up}\n")


@pytest.fixture(scope="module")
def between():
    return Aimed("  - aim: {leaf: [left, up]}\n")


def degrees(one, other):
    return np.degrees(np.arccos(np.clip(one @ other, -1.0, 1.0)))


def test_a_limb_points_where_the_recipe_says_when_the_hands_are_gone(as_made, up, between):
    assert degrees(as_made.pointing, np.array([0.0, -1.0, 0.0])) < 25.0
    assert degrees(up.pointing, np.array([0.0, 0.0, 1.0])) < 12.0
    assert degrees(between.pointing, np.sqrt(0.5) * np.array([0.0, -1.0, 1.0])) < 12.0


def test_it_stays_there_and_no_wall_goes_through_another(up, between):
    for each in (up, between):
        assert np.linalg.norm(each.places - each.at_let_go, axis=1).max() < 3e-3
        assert each.crossings == 0


def test_a_limb_that_is_spun_points_as_said_and_its_loop_lies_across():
    figure = plan(Recipe.parse(LOOP + "  - aim: {leaf: up}\n    spin: 90\n"))
    (move,) = (move for move in figure.choreography.moves if isinstance(move, AimMove))
    simulation = simulate_many([figure], device="cpu")
    (meshes,) = simulation.meshes
    rings = [figure.table.ends("leaf")[0], *figure.table.guides("leaf")]
    corners = [RingCorners.of(figure, meshes, ring) for ring in rings]
    planes = []
    for (frame,) in simulation.frames():
        if frame.time_code in (round(move.start * figure.recipe.fps), round(move.end * figure.recipe.fps)):
            joint, *leaf = (ring.places(frame).mean(axis=0) for ring in corners)
            planes.append(np.linalg.svd(leaf - np.mean(leaf, axis=0))[2][2])
            points = np.mean(leaf, axis=0) - joint
        if len(planes) == 2:
            break
    assert abs(planes[0] @ planes[1]) < np.sin(np.radians(10.0))
    assert degrees(points / np.linalg.norm(points), np.array([0.0, 0.0, 1.0])) < 12.0


def test_a_spin_is_mirrored():
    spins = []
    for side in ("left", "right"):
        text = (
            LOOP.replace("point: left", f"point: {side}") + f"  - aim: {{leaf: [{side}, up]}}\n    spin: 30\n"
        )
        made = plan(Recipe.parse(text))
        spins.append(next(move.spin for move in made.choreography.moves if isinstance(move, AimMove)))
    assert spins == pytest.approx([np.radians(30.0), -np.radians(30.0)])


def test_what_is_made_to_the_right_is_the_mirror_image(between):
    text = LOOP.replace("point: left", "point: right")
    other = plan(Recipe.parse(text + "  - aim: {leaf: [right, up]}\nphysics: {hold: 2}\n"))
    assert other.mirrored
    one, mirrored = (
        next(move for move in each.choreography.moves if move.text == "aim: leaf")
        for each in (between.plan, other)
    )
    assert one.toward == pytest.approx(mirrored.toward)


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("aim: {leaf: up}", None),
        ("aim: {leaf: [up, back, left]}", None),
        ("aim: {stalk: [forward, up], leaf: up}", None),
        ("aim: {leaf: up}\n    spin: -90", None),
        ("aim: {leaf: up}\n    spin: 400", "spin"),
        ("aim: {leaf: up}\n    spin: round", "spin"),
        ("aim: {leaf: sideways}", 'unknown direction "sideways"'),
        ("aim: {leaf: upp}", 'unknown direction "upp", did you mean "up"?'),
        ("aim: {leaf: [up, down]}", "up and down cancel each other, expected one of"),
        ("aim: {leaf: []}", "is no direction, expected up, or a list such as [back, up]"),
        ("aim: {leef: up}", 'unknown bubble "leef", did you mean "leaf"?'),
        ("aim: {}", "is empty"),
        (
            "aim: {leaf: up, stalk: up}\n    seconds: 1",
            "are too short a time to turn leaf and stalk, expected at least",
        ),
        ("aim: {leaf: 30}", "30 is no direction, expected up, or a list such as [back, up]"),
    ],
)
def test_what_cannot_be_aimed_is_refused_with_the_reason(step, told):
    text = f"{LOOP}  - {step}\n"
    if told is None:
        assert plan(Recipe.parse(text)).cautions == ()
        return
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text))
    assert told in str(caught.value)


def test_what_hangs_on_no_joint_is_refused():
    ring = (
        "  - bubbles: {a: 6, b: 6, c: 6}\n  - rest: d\n  - lock: {joints: [a.start, d.start]}\n  - pop: d\n"
    )
    text = LOOP[: LOOP.index("  - bubbles")] + ring + "  - aim: {b: up}\n"
    with pytest.raises(
        RecipeError, match="no joint is there about which b could be turned against its figure"
    ):
        plan(Recipe.parse(text))


def test_the_example_of_the_page_is_planned_without_a_caution():
    assert plan(Recipe.parse(Aim.example)).cautions == ()
