"""Split ears: one chamber until fingers pinch it between its cheeks, then two balls on one joint."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.operations.moves import Halve
from balloon_usd.operations.split import Split
from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.watched import crossings

EVEN = Split.example
UNEVEN = EVEN.replace("left_toe: 3.5, right_toe: 3.5", "left_toe: 2.5, right_toe: 4")
TOES = slice(1, 3)
"""Both halves among the bubbles of these recipes."""


class Made:
    """A figure with a split ear, looked at in every frame."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        simulation = simulate_many([self.plan], detail="draft", device="cpu")
        (self.mesh,) = simulation.meshes[0]
        self.quality = QualityWatch(self.plan, [self.mesh], range(1, self.plan.frame_count + 1))
        self.frames = []
        for (frame,) in simulation.frames():
            self.frames.append(frame)
            self.quality.add(frame)
        halve = next(move for move in self.plan.choreography.moves if isinstance(move, Halve))
        self.halving = round(halve.start * self.plan.recipe.fps)
        """Number of the frame in which fingers begin to part the ear."""

    def gas(self, number):
        """Pressure times volume of both halves in a frame, J."""
        frame = self.frames[number]
        return (ATMOSPHERE + frame.pressure[TOES]) * frame.volume[TOES]

    def rings(self, begin, end):
        """Vertices of the rings between two unstressed distances from the knot (m) in the end, (N, around, 3), m."""
        first = self.mesh.ring_start[
            (self.mesh.ring_along >= begin - 1e-6) & (self.mesh.ring_along <= end + 1e-6)
        ]
        return self.frames[-1].points[0][first[:, None] + np.arange(self.mesh.around)].astype(float)


@pytest.fixture(scope="module", params=[EVEN, UNEVEN], ids=["even", "uneven"])
def made(request):
    return Made(request.param)


def test_both_halves_are_one_chamber_until_fingers_pinch_between_them(made):
    one, other = made.frames[made.halving - 1].pressure[TOES]
    assert one == other
    one, other = made.frames[-1].pressure[TOES]
    assert abs(one - other) > 10.0


def test_each_half_keeps_the_gas_of_the_plan_and_none_is_lost(made):
    wanted = np.array([(ATMOSPHERE + bubble.pressure) * bubble.volume for bubble in made.plan.bubbles[TOES]])
    now = made.gas(-1)
    assert now.sum() == pytest.approx(made.gas(made.halving - 1).sum(), rel=1e-4)
    assert now / now.sum() == pytest.approx(wanted / wanted.sum(), rel=1e-3)


def test_two_balls_sit_side_by_side_on_one_joint(made):
    necks = [bubble.rest_end for bubble in made.plan.bubbles[:3]]
    joint = [made.rings(neck, neck).mean(axis=(0, 1)) for neck in necks]
    assert max(np.linalg.norm(each - joint[0]) for each in joint) < 0.009
    balls = [made.rings(*ends).reshape(-1, 3) for ends in zip(necks, necks[1:], strict=False)]
    middles = [0.5 * (ball.min(axis=0) + ball.max(axis=0)) for ball in balls]
    radii = [0.5 * np.ptp(ball, axis=0).mean() for ball in balls]
    way = middles[1] - middles[0]
    # They press on each other.
    assert 0.5 * sum(radii) < np.linalg.norm(way) < 1.1 * sum(radii)


def test_both_are_about_as_hard_as_an_ear(made):
    assert (made.frames[-1].pressure[TOES] < 11.5e3).all()


def test_no_wall_goes_through_another_in_any_frame(made):
    assert not crossings(made.quality)
