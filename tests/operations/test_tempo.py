"""How fast hands twist, by tempo."""

import numpy as np
import pytest

from balloon_usd.operations.moves import Gather, Spin, TurnFold
from balloon_usd.operations.tempo import PACES, eased
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

HEAD = """
format: 1
name: head
units: cm
{tempo}
balloons: {{main: {{size: 260, tail: 10}}}}
steps:
  - bubbles: {{nose: 10, left_ear: 10, right_ear: 10}}{turns}
  - lock: [left_ear, right_ear]{seconds}
physics: {{model: {model}}}
"""
LOOPS = """
format: 1
name: loops
units: cm
balloons: {main: {size: 260, tail: 10}}
steps:
  - bubbles: {heart: 5}
  - loop: {left: 22}
  - loop: {right: 22}
"""


def head(tempo="", turns="", seconds="", model="latex"):
    text = HEAD.format(tempo=tempo, turns=turns, seconds=seconds, model=model)
    return plan(Recipe.parse(text)).choreography.moves


def fastest(move, fps=24.0):
    """Largest angle of a turn from frame to frame, degrees."""
    shares = np.arange(0.0, move.seconds + 1.0 / fps, 1.0 / fps) / move.seconds
    return 360.0 * move.turns * np.diff([eased(share) for share in shares]).max()


def turning(moves):
    return [move for move in moves if isinstance(move, Spin | TurnFold)]


def test_a_turn_begins_and_ends_at_rest_and_is_even_between():
    progress = np.array([eased(share) for share in np.linspace(-0.5, 1.5, 401)])
    assert (progress[0], progress[-1]) == (0.0, 1.0)
    steps = np.diff(progress)
    assert (steps >= 0.0).all()
    assert progress + progress[::-1] == pytest.approx(1.0)
    assert np.abs(np.diff(steps)).max() < 0.05 * steps.max()


@pytest.mark.parametrize("tempo", PACES)
@pytest.mark.parametrize("turns", [0.5, 1.0, 3.0, 10.0])
def test_no_frame_sees_more_of_a_turn_than_the_tempo_allows(tempo, turns):
    degrees = {"calm": 40.0, "brisk": 60.0, "show": 20.0}[tempo]
    moves = turning(head(f"tempo: {tempo}", f"\n    turns: {turns}"))
    assert [type(move) for move in moves] == [Spin, Spin, Spin, TurnFold]
    assert max(map(fastest, moves)) == pytest.approx(degrees, rel=0.02 if turns > 0.5 else 0.1)
    assert max(map(fastest, moves)) <= degrees * 1.0001


def test_three_turns_take_as_long_as_by_hand():
    assert [move.seconds for move in turning(head())] == pytest.approx([1.5] * 4)


def test_a_loop_does_not_turn_through_another_that_hangs_at_its_joint():
    moves = plan(Recipe.parse(LOOPS)).choreography.moves
    assert [move.text for move in moves if isinstance(move, TurnFold)] == ["loop twist: left"]


def test_hands_go_slower_at_show_and_faster_when_brisk():
    show, calm, brisk = (
        next(move.seconds for move in head(f"tempo: {tempo}") if isinstance(move, Gather))
        for tempo in ("show", "calm", "brisk")
    )
    assert brisk < calm < show


def test_the_seconds_of_a_step_rule():
    moves = head(seconds="\n    seconds: 10")
    of_lock = [move for move in moves if move.step == 1]
    assert of_lock[-1].end - of_lock[0].start == pytest.approx(10.0)


def test_another_tempo_is_refused_with_those_there_are():
    with pytest.raises(RecipeError, match="calm, brisk"):
        head("tempo: quick")


def test_a_model_whose_joints_freeze_has_no_tempo():
    with pytest.raises(RecipeError, match="tempo: makes no sense with model kosaka"):
        head("tempo: brisk", model="kosaka")
