"""Ends of balloons that are tied to joints: what is left of a tube ends at its front, and its flat tip is string."""

from __future__ import annotations

import re

import pytest

from balloon_usd.operations.moves import Bring, Gather, Spin, TurnFold, Weld
from balloon_usd.operations.score import HAND_SPEED
from balloon_usd.operations.tie import PLACES
from balloon_usd.plan.holding import slipping_steps
from balloon_usd.recipe import RecipeError

TUBE = """
balloons: {{main: {{size: 260, length: 24, tail: {tail}}}}}
physics: {{friction: {friction}}}
steps:
  - bubbles: {{a: 8, b: 4, c: 4}}
  - lock: [b, c]
  - rest: r
  - tie: {{end: {end}, to: {to}}}
"""

TWO = """
balloons: {main: {size: 260, length: 20, tail: 8}, other: {size: 260, length: 20, tail: 6}}
steps:
  - bubbles: {head: 8, body: 12}
    balloon: main
  - bubbles: {arm: 12}
    balloon: other
  - lock: {joints: [arm.start, head.end]}
  - rest: back
    balloon: main
  - rest: more
    balloon: other
  - wait: 1
  - tie: {end: more.end, to: head.end}
"""


def tied(planned, tail=8, end="r.end", to="r.start", friction=0.8, more=""):
    return planned(TUBE.format(tail=tail, end=end, to=to, friction=friction) + more)


def corners(figure):
    names = [ring.name for ring in figure.table.rings]
    return [
        [names[ring] for ring in move.corners if figure.table.rings[ring].joint]
        for move in figure.choreography.moves
        if isinstance(move, Gather)
    ]


def test_what_is_left_takes_all_the_gas_and_its_tip_is_flat(planned):
    strip, budget = tied(planned).strips["main"], tied(planned).budgets["main"]
    *bubbles, tip = strip.bubbles
    assert [bubble.name for bubble in strip.bubbles] == ["a", "b", "c", "r", "main_tip"]
    assert (tip.length, tip.rest_end) == (0.0, pytest.approx(0.24))
    assert sum(bubble.volume for bubble in strip.bubbles) == pytest.approx(budget.volume, rel=1e-9)
    assert tip.volume < 0.01 * bubbles[-1].volume
    assert budget.tail_left == pytest.approx(tip.rest_length)


def test_closing_the_front_takes_half_the_tail_of_a_twist(planned):
    budget = tied(planned).budgets["main"]
    before, after = (twist.tail_left for twist in budget.twists[-2:])
    assert before - after == pytest.approx(0.5 * budget.cost_per_twist, rel=0.1)


def test_hands_wind_the_tip_but_turn_nothing_that_hangs_on_it(planned):
    moves = [move for move in tied(planned).choreography.moves if move.step == 3]
    assert sum(isinstance(move, Spin) for move in moves) == 1
    assert sum(isinstance(move, Weld) for move in moves) == 1
    assert not any(isinstance(move, TurnFold) for move in moves)


def test_a_nozzle_is_a_string_already(planned):
    figure = tied(planned, end="a.start", to="b.end")
    assert [bubble.name for bubble in figure.strips["main"].bubbles] == ["a", "b", "c", "r"]
    assert not any(isinstance(move, Spin) and move.step == 3 for move in figure.choreography.moves)
    assert corners(figure)[-1] == ["main.knot", "a.end", "b.end"]


@pytest.mark.parametrize("friction", [0.0, 0.05, 0.8])
def test_a_knot_holds_at_any_friction(planned, friction):
    assert 3 not in slipping_steps(tied(planned, friction=friction).recipe)


@pytest.mark.parametrize("joint", ["a.end", "b.start", "c.end", "r.start"])
def test_a_joint_that_is_one_already_is_met_where_it_is_nearest(planned, joint):
    assert corners(tied(planned, to=joint))[-1] == ["c.end", "r.end"]


def test_rows_that_are_closed_hang_on_a_chain_and_are_no_part_of_it(planned):
    steps = "\n  - ear: {d: 3}\n  - bubbles: {e: 10, f: 10, g: 10}\n  - lock: {joints: [a.start, g.end]}\n"
    figure = planned(TUBE.split("  - rest", maxsplit=1)[0].format(tail=12, friction=0.8).rstrip() + steps)
    assert corners(figure)[-1] == ["main.knot", "a.end", "e.end", "f.end", "g.end"]


def test_a_bubble_longer_than_the_rest_of_its_ring_is_bent_round(planned):
    figure = tied(planned, to="a.start")
    (move,) = (move for move in figure.choreography.moves if isinstance(move, Gather) and move.step == 3)
    long = figure.table.guides("r")
    assert len(long) >= PLACES
    assert set(long) < set(move.corners)
    assert list(move.corners) == sorted(move.corners)
    assert not move.cheeks


def test_a_tip_of_another_balloon_is_brought_slowly_where_it_is_far(planned):
    figure = planned(TWO)
    (move,) = (move for move in figure.choreography.moves if isinstance(move, Bring) and move.step == 6)
    far = next(bubble.length for bubble in figure.bubbles if bubble.name == "more")
    assert move.seconds == pytest.approx(far / HAND_SPEED)


def test_a_lock_meets_it_there_too(planned):
    steps = "\n  - bubbles: {d: 20}\n  - lock: {joints: [a.end, d.end]}\n  - rest: r\n"
    figure = planned(TUBE.split("  - rest", maxsplit=1)[0].format(tail=8, friction=0.8).rstrip() + steps)
    assert corners(figure)[-1] == ["c.end", "d.end"]


def test_a_flat_tip_too_short_to_be_wound_is_refused_with_what_would_do(planned):
    with pytest.raises(
        RecipeError, match=r"tie\.end: only [\d.]+ cm of flat tail are left behind r"
    ) as caught:
        tied(planned, tail=4)
    longer = float(re.search(r"a longer tail of main, by ([\d.]+) cm$", str(caught.value))[1])
    assert tied(planned, tail=4 + longer)
    with pytest.raises(RecipeError, match="of flat tail are left behind r"):
        tied(planned, tail=4 + longer - 0.2)


def test_a_tail_that_is_used_up_before_is_told_as_none(planned):
    with pytest.raises(RecipeError, match=r"only 0 cm of flat tail are left behind r, .* tail of main"):
        tied(planned, tail=2)


REFUSED = {
    "the middle of a balloon": ({"end": "b.end", "to": "a.start"}, "b.end is no end of balloon main"),
    "a tip that is tied to": ({"end": "a.start", "to": "r.end"}, "tip of its balloon and cannot be twisted"),
    "one joint": ({"end": "r.end", "to": "r.end"}, "these joints are already one"),
    "no such bubble": ({"end": "q.end", "to": "a.end"}, 'unknown bubble "q"'),
    "a tip twice": (
        {"more": "  - tie: {end: r.end, to: b.end}"},
        r"steps\[4\]\.tie\.end: the tip of \"r\" was tied at steps\[3\]",
    ),
    "a ball of a tied tip": (
        {"more": "  - tail_ball: {r: 2.5}"},
        r"the tip of \"r\" was tied at steps\[3\]\.tie\.end, expected one that is free",
    ),
    "a bubble of its flat rubber": ({"more": "  - aim: {main_tip: up}"}, 'unknown bubble "main_tip"'),
    "a ring too small to be bent": ({"tail": 20.8}, r"steps\[3\]\.tie: closes r: [\d.]+ cm of a 260"),
}


@pytest.mark.parametrize(("given", "told"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_tied_is_refused(planned, given, told):
    with pytest.raises(RecipeError, match=told):
        tied(planned, **given)


OTHERS = {
    "a ball": ("  - tail_ball: {r: 2.5}", r"the tip of \"r\" is a ball since steps\[3\]\.tail_ball\.r"),
    "a threaded tube": ("  - thread: {bubble: r, through: [b, c]}", "expected thread or tie alone"),
    "a popped one": ("  - pop: r", r"\"r\" was popped at steps\[3\]\.pop"),
}


@pytest.mark.parametrize(("step", "told"), OTHERS.values(), ids=OTHERS)
def test_a_tip_that_is_no_string_any_more_is_not_tied(planned, step, told):
    made, tie = TUBE.format(tail=10, end="r.end", to="r.start", friction=0.8).split("  - tie")
    with pytest.raises(RecipeError, match=told):
        planned(f"{made}{step}\n  - tie{tie}")


def test_a_bubble_may_be_called_as_the_tip_would_be(planned):
    made = TUBE.format(tail=8, end="r.end", to="r.start", friction=0.8).replace("b: 4", "main_tip: 4")
    names = [
        bubble.name for bubble in planned(made.replace("[b, c]", "[main_tip, c]")).strips["main"].bubbles
    ]
    assert names == ["a", "main_tip", "c", "r", "main_tip_"]
