"""Plans of the particle model: balloons start blown up, joints freeze, and nothing unwinds or bursts."""

from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.operations.moves import Inflate, LetGo, Pinch, Spin
from balloon_usd.plan import plan, plan_json, plan_text
from balloon_usd.recipe import Recipe

RECIPES = sorted((Path(__file__).parents[2] / "recipes" / "kosaka").glob("*.yaml"))
TUBE = """
balloons: {{a: {{size: 260, {}}}}}
steps: [{{bubbles: {{b: 8, c: 2}}}}]
physics: {{model: kosaka}}
"""


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_every_recipe_of_the_thesis_plans_without_cautions(path):
    figure = plan(Recipe.load(path))
    assert figure.recipe.physics.model == "kosaka"
    assert figure.cautions == ()


def test_the_experiments_of_the_thesis_are_shipped():
    titles = {path.stem for path in RECIPES}
    assert titles >= {"diffusion", "press", "bubble", "bubbles", "bend", "loop", "lock", "dog"}


def test_balloons_start_blown_up_and_their_air_spreads(planned):
    first, *others = planned(TUBE.format("tail: 10")).choreography.moves
    assert (first.start, first.seconds, first.text) == (0.0, 1.5, "air spreads")
    assert not any(isinstance(move, Inflate) for move in others)
    assert others[0].start == pytest.approx(1.5)


def test_joints_are_pinched_but_not_turned(planned):
    moves = planned(TUBE.format("tail: 10")).choreography.moves
    kinds = [type(move) for move in moves[1:-2]]
    assert kinds == [Pinch, LetGo, Pinch, LetGo]
    assert Spin not in kinds


def test_frozen_joints_do_not_unwind_and_short_bubbles_do_not_harden(planned):
    figure = planned(TUBE.format("tail: 10"))
    assert figure.cautions == ()
    assert not any(joint["springs_back"] for joint in plan_json(figure)["graph"]["joints"])


def test_a_tail_that_is_too_short_is_still_named(planned):
    assert [caution.what for caution in planned(TUBE.format("tail: 0.5")).cautions] == [
        "a runs out of tail at the twist that ends b"
    ]


def test_particles_have_no_pressure_in_pascal(planned):
    text = plan_text(planned(TUBE.format("tail: 10")))
    assert "model kosaka: springs and air particles" in text
    assert "leave 10 cm flat: 2.23 L\n" in text
    assert "kPa" not in text
