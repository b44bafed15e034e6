"""A tulip of latex: the wall of the first bubble is turned inside, where the gas keeps the knot."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.operations.moves import Weld
from balloon_usd.operations.tulip import Tulip
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import NO_NECK, walls_of
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.simulation import simulate_many

EVERY = 4
"""Frames from one count of crossings to the next."""


class Inverted:
    """A tulip that is run: points, gas and pressures of every frame, and crossings of some."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        (weld,) = (move for move in self.plan.choreography.moves if isinstance(move, Weld))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        self.mesh = meshes[0]
        self.walls = walls_of(self.plan, meshes)
        counter = CrossingCounter(self.walls, 100)
        self.points, self.gas, self.pressure, self.crossings = [], [], [], []
        fps = round(self.plan.recipe.fps)
        self.welded = round(weld.start * fps) + 1
        for (frame,) in simulation.frames():
            self.points.append(frame.points[0].astype(float))
            self.gas.append(simulation.model.scene.amount.numpy().copy())
            self.pressure.append(frame.pressure.astype(float))
            if frame.time_code % EVERY == 0:
                found = counter.count(frame.points)
                self.crossings.append(found.count + found.in_necks)
        end = self.plan.table.ends("flower")[1]
        self.neck = self.mesh.ring_at(self.plan.table.rings[end].along)
        self.knot = self.mesh.ring_at(0.0)

    def ring(self, ring, at=-1):
        """Vertices of a ring of the mesh in a frame, (around, 3), m."""
        first = int(self.mesh.ring_start[ring])
        return self.points[at][first : first + self.mesh.around]

    def knot_to_neck(self, at=-1):
        """How far the neck is from the knot in a frame, (3,), m."""
        return self.ring(self.neck, at).mean(axis=0) - self.ring(self.knot, at).mean(axis=0)


@pytest.fixture(scope="module")
def tulip():
    return Inverted(Tulip.example + "physics: {hold: 2}\n")


def test_the_knot_lies_at_the_far_end_of_its_bubble_and_stays_there_when_hands_let_go(tulip):
    assert np.linalg.norm(tulip.knot_to_neck(100)) > 0.06
    assert np.linalg.norm(tulip.knot_to_neck()) < 0.006
    assert np.linalg.norm(tulip.knot_to_neck() - tulip.knot_to_neck(-24)) < 1e-4


def test_what_was_outside_beside_the_knot_faces_the_axis_of_the_tunnel(tulip):
    def outward(at):
        quads = tulip.mesh.quads
        rows = quads[(tulip.mesh.along[quads] > 0.0).all(axis=1)][: 2 * tulip.mesh.around]
        a, b, c, d = (tulip.points[at][rows[:, k]] for k in range(4))
        axis = tulip.ring(tulip.knot, at).mean(axis=0)
        away = 0.25 * (a + b + c + d) - axis
        away[:, 0] = 0.0
        return float(np.sign(np.einsum("ij,ij->i", np.cross(c - a, d - b), away)).mean())

    assert outward(tulip.welded - 50) > 0.9
    assert outward(-1) < -0.5


def test_no_wall_goes_through_another_and_the_knot_is_not_left_out_of_the_count(tulip):
    assert sum(tulip.crossings) == 0
    beside = np.abs(tulip.mesh.along) < 1e-4
    assert set(tulip.walls.neck[: len(beside)][beside]) == {NO_NECK}


def test_it_keeps_its_gas_and_is_no_harder_than_an_ear(tulip):
    sealed = tulip.gas[tulip.welded]
    assert tulip.gas[-1] == pytest.approx(sealed, rel=1e-6)
    assert 7000.0 < tulip.pressure[-1][0] < 10000.0


def test_it_does_not_flutter(tulip):
    head = np.array(tulip.pressure[tulip.welded :])[:, 0]
    assert np.abs(np.diff(head, 2)).mean() < 50.0
    assert np.linalg.norm(tulip.points[-1] - tulip.points[-24], axis=1).max() < 1e-3


def test_with_one_turn_the_gas_pushes_the_knot_out_and_head_and_stem_are_one_tube():
    slipped = Inverted(Tulip.example.replace("flower: 7}", "flower: 6}\n    turns: 1"))
    assert np.linalg.norm(slipped.knot_to_neck(slipped.welded)) < 0.006
    assert slipped.knot_to_neck()[0] > 0.04
    assert sum(slipped.crossings) == 0
    assert slipped.pressure[-1] == pytest.approx(slipped.pressure[-1].mean(), rel=0.01)


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        ("tulip: {flower: 7.5}", None),
        ("tulip: {flower: 3.6}", None),
        ("tulip: {flower: 3}", "3 cm of a 260 are too short for a tulip, the knot has no room in it"),
        ("tulip: {flower: 5}\n    seconds: 1", "1 s are too short a time to press a knot through"),
        ("tulip: {flower: 8}", "8 cm of a 260 are too long for a tulip, what is turned inside is slack"),
        ("bubbles: {a: 5}\n  - tulip: {flower: 5}", '"flower" is not the first bubble of "main", "a" is'),
        ("tulip: {flower: 5, more: 5}", '"more" is not the first bubble of "main", "flower" is'),
        ("tulip: {flower: 5}\n    point: up", "makes no sense with tulip"),
        (
            "tulip: {flower: 5}\n  - rest: b\n  - push: {bubble: b, through: [flower]}",
            "flower (5 cm) has no hole, expected a loop or a fold, or bubbles of a lock",
        ),
    ],
)
def test_what_cannot_be_a_tulip_is_refused_with_the_reason(steps, told):
    text = Tulip.example.replace("tulip: {flower: 7}\n  - rest: stem", steps)
    if told is None:
        plan(Recipe.parse(text))
        return
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text))
    assert told in str(caught.value)
