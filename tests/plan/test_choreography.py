"""The steps of a recipe as hand moves in time."""

from __future__ import annotations

import math

import pytest

from balloon_usd.operations.moves import Bend, Gather, Inflate, LetGo, Pinch, Spin, Weld
from balloon_usd.plan import plan
from balloon_usd.recipe import RecipeBuilder, RecipeError


def moves(build):
    builder = RecipeBuilder("thing").balloon("main", size="260", color="red", tail=0.12)
    return plan(build(builder).build()).choreography


def dog_head(builder):
    builder = builder.bubbles(nose=0.1, left_ear=0.1, right_ear=0.1)
    return builder.lock("left_ear", "right_ear", point="up").rest("tail")


def kinds(choreography, kind):
    return [move for move in choreography.moves if isinstance(move, kind)]


def test_a_balloon_is_inflated_before_it_is_pinched():
    made = moves(dog_head)
    assert kinds(made, Inflate)[0].end <= kinds(made, Pinch)[0].start


def test_every_bubble_but_the_last_is_pinched_and_twisted_once():
    made = moves(dog_head)
    assert len(kinds(made, Pinch)) == 3
    assert [move.turns for move in kinds(made, Spin)] == [3.0, 3.0, 3.0]


def test_moves_follow_each_other_without_overlap():
    made = moves(dog_head)
    working = [move for move in made.moves if move.seconds > 0.0]
    for before, after in zip(working, working[1:], strict=False):
        assert after.start == pytest.approx(before.end)
    assert made.seconds == pytest.approx(working[-1].end)


def test_a_lock_gathers_its_chain_to_the_side_it_points_to_and_welds_its_ends():
    made = moves(dog_head)
    (gather,) = kinds(made, Gather)
    (weld,) = kinds(made, Weld)
    assert gather.point == (0.0, 0.0, 1.0)
    assert len(gather.corners) == 3
    assert len(gather.cheeks) == 2
    assert weld.rings == (gather.corners[0], gather.corners[-1])
    assert weld.start == pytest.approx(gather.end)


def test_a_loop_is_led_by_rings_inside_it():
    made = moves(lambda b: b.bubbles(nose=0.05).loop(ear=0.2).rest("tail"))
    (gather,) = kinds(made, Gather)
    assert len(gather.corners) == 2 + 7


def test_the_hands_let_go_at_the_end_and_the_pose_is_held_for_two_seconds():
    made = moves(dog_head)
    (last,) = (move for move in kinds(made, LetGo) if move.for_good)
    assert made.taken_up - last.start == pytest.approx(2.0)


@pytest.mark.parametrize(("hold", "shown"), [(None, 4.1), (0.5, 0.5), (0.0, 0.0)])
def test_twists_that_nothing_holds_are_given_the_time_to_unwind_if_the_recipe_gives_none(hold, shown):
    def chain(builder):
        builder = builder.bubbles(nose=0.1, body=0.1).rest("tail")
        return builder if hold is None else builder.physics(hold=hold)

    made = moves(chain)
    (last,) = (move for move in kinds(made, LetGo) if move.for_good)
    assert made.seconds - last.start == pytest.approx(shown)


def test_a_step_takes_the_seconds_that_the_recipe_gives_it():
    def slow(builder):
        return builder.bubbles(nose=0.1, body=0.1, seconds=7.0).rest("tail")

    made = moves(slow)
    of_step = [move for move in made.moves if move.step == 0]
    assert max(m.end for m in of_step) - min(m.start for m in of_step) == pytest.approx(7.0)


def test_a_bend_leads_a_bubble_by_its_angle():
    made = moves(lambda b: b.bubbles(neck=0.2, body=0.1).bend(neck=60, point="up").rest("tail"))
    (bend,) = kinds(made, Bend)
    assert bend.angle == pytest.approx(math.radians(60.0))


def test_the_tip_of_a_balloon_cannot_be_locked():
    with pytest.raises(RecipeError, match="tip of its balloon"):
        moves(lambda b: b.bubbles(nose=0.1, body=0.1).rest("tail").lock(joints=["nose.start", "tail.end"]))
