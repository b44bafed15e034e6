"""What holds when the hands let go for good: locks of enough turns, and the rings that they close."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.wound_neck import holding_friction
from balloon_usd.operations.moves import LetGo, Weld
from balloon_usd.plan import after_step, after_step_json, plan_json, plan_text

HEAD = "balloons: {a: {size: 260, tail: 10}}\nsteps:\n"
CHAIN = f"{HEAD}- bubbles: {{b: 8, c: 8, d: 8}}\n"


def loose_in(figure) -> list[str]:
    return [str(loose.end) for loose in figure.loose]


def test_every_joint_of_a_chain_is_loose(planned):
    assert loose_in(planned(CHAIN)) == ["b.end", "c.end", "d.end"]


def test_a_loose_joint_knows_what_turns_on_either_side(planned):
    middle = planned(CHAIN).loose[1]
    assert middle.before == {"b", "c"}
    assert middle.beyond == {"d", "a_rest"}


@pytest.mark.parametrize(
    ("turns", "loose"),
    [(0.5, ["b.end", "c.end", "d.end"]), (1, ["b.end", "c.end", "d.end"]), (2, []), (3, [])],
)
def test_a_lock_holds_from_two_turns_on(planned, turns, loose):
    figure = planned(f"{CHAIN}- lock: [b, c, d]\n  turns: {turns}\n")
    assert loose_in(figure) == loose


@pytest.mark.parametrize(
    ("friction", "turns", "holds"),
    [(0.0, 5, False), (0.05, 3, False), (0.3, 3, True), (0.3, 2, True), (0.2, 2, False), (3.0, 1.5, False)],
)
def test_a_lock_of_slippery_rubber_slips_and_more_turns_hold_it(planned, friction, turns, holds):
    figure = planned(f"physics: {{friction: {friction}}}\n{CHAIN}- lock: [b, c, d]\n  turns: {turns}\n")
    assert loose_in(figure) == ([] if holds else ["b.end", "c.end", "d.end"])
    assert (1 in figure.slipping) is not holds


def test_the_plan_says_how_many_times_the_friction_that_it_needs_a_lock_has(planned):
    figure = planned(f"physics: {{friction: 0.4}}\n{CHAIN}- lock: [b, c, d]\n  turns: 2\n")
    needed = holding_friction(2.0)
    margins = {joint["ends"][0]: joint["margin"] for joint in plan_json(figure)["graph"]["joints"]}
    assert margins == {
        "b.start": pytest.approx(0.4 / needed),
        "b.end": None,
        "c.end": None,
        "a_rest.end": None,
    }
    assert f"d.end = a_rest.start (held by {0.4 / needed:.1f} times the friction that it needs)" in plan_text(
        figure
    )
    before = after_step_json(after_step(figure, 0))["graph"]["joints"]
    assert {joint["margin"] for joint in before} == {None}


def test_a_lock_of_too_few_turns_has_no_friction_to_spare(planned):
    figure = planned(f"{CHAIN}- lock: [b, c, d]\n  turns: 1\n")
    assert plan_json(figure)["graph"]["joints"][0]["margin"] == 0.0


@pytest.mark.parametrize("friction", [0.05, 0.3, 0.8])
def test_a_lone_twist_comes_undone_at_any_friction(planned, friction):
    assert loose_in(planned(f"physics: {{friction: {friction}}}\n{CHAIN}")) == ["b.end", "c.end", "d.end"]


def test_half_a_turn_within_a_locked_ring_cannot_leave_it(planned):
    figure = planned(f"{HEAD}- bubbles: {{b: 8, c: 8, d: 8}}\n  turns: 0.5\n- lock: [b, c, d]\n")
    assert loose_in(figure) == []


def test_what_another_balloon_is_locked_to_turns_with_it(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 10}, o: {size: 260, tail: 10}}
        steps:
        - bubbles: {b: 8, c: 8}
          balloon: a
        - bubbles: {x: 8}
          balloon: o
        - lock: {joints: [c.end, x.end]}
        """)
    (loose,) = figure.loose
    assert str(loose.end) == "b.end"
    assert loose.before == {"b"}
    assert loose.beyond == {"c", "a_rest", "x", "o_rest"}


def test_hands_let_go_for_good_once_and_last(planned):
    moves = planned(f"{CHAIN}- wait: 1\n").choreography.moves
    for_good = [move for move in moves if isinstance(move, LetGo) and move.for_good]
    assert len(for_good) == 1
    assert for_good[0].start >= max(move.end for move in moves if move.text == "wait")


def test_a_weld_has_the_turns_of_its_step(planned):
    figure = planned(f"{CHAIN}- lock: [b, c, d]\n  turns: 4\n- ear: {{e: 3}}\n")
    assert [move.turns for move in figure.choreography.moves if isinstance(move, Weld)] == [4.0, 3.0]
