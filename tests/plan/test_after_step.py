"""The plan as it stands after a step."""

from __future__ import annotations

import json

import pytest

from balloon_usd.plan import after_step, after_step_json, after_step_text, plan_json, plan_svg


def test_after_the_first_step_all_joints_are_free_to_spin(dog):
    graph = after_step(dog, 0).graph
    assert [edge.bubble for edge in graph.edges] == ["nose", "left_ear", "right_ear", "tail"]
    assert [graph.springs_back(joint.index) for joint in graph.joints] == [False, True, True, True, False]


def test_after_the_lock_its_ring_is_closed(dog):
    before, after = after_step(dog, 0).graph, after_step(dog, 1).graph
    assert (before.rings, after.rings) == (0, 1)
    assert sum(map(after.springs_back, range(len(after.joints)))) == 0


def test_after_the_last_step_the_graph_is_that_of_the_plan(dog):
    last = len(dog.recipe.steps) - 1
    assert after_step(dog, last).graph == dog.graph
    assert after_step(dog, last).left(dog.strips["main"]) is None


def test_each_twist_fills_some_of_the_flat_tail(dog):
    strip = dog.strips["main"]
    left = [after_step(dog, step).left(strip) for step in (0, 2, 4)]
    assert dog.strips["main"].tail > left[0].tail > left[1].tail > left[2].tail > 0.0
    assert left[0].length > left[1].length > left[2].length


def test_a_balloon_that_is_not_begun_is_not_shown(planned):
    plan = planned("""
        balloons: {a: {size: 260, tail: 10}, b: {size: 260, tail: 10}}
        steps:
          - bubbles: {one: 5}
            balloon: a
          - bubbles: {other: 5}
            balloon: b
        """)
    assert [strip.balloon for strip in after_step(plan, 0).strips] == ["a"]
    assert [strip.balloon for strip in after_step(plan, 1).strips] == ["a", "b"]


def test_the_rest_of_a_capsule_is_told_without_pressure(planned):
    plan = planned("""
        balloons: {a: {size: 260, capsule: 40}}
        physics: {model: kosaka}
        steps: [{bubbles: {one: 8}}]
        """)
    assert "\n  left: " in after_step_text(after_step(plan, 0))
    assert "kPa" not in after_step_text(after_step(plan, 0))


def test_the_text_tells_the_step_and_what_is_left(dog):
    text = after_step_text(after_step(dog, 1))
    assert "after step 2 of 7, lock: left_ear, right_ear" in text
    assert "blown up at 7.1 kPa" in text


def test_the_data_is_that_of_the_plan_with_the_step(dog):
    data = json.loads(json.dumps(after_step_json(after_step(dog, 6)), allow_nan=False))
    assert data["step"] == 6
    assert data["graph"] == json.loads(json.dumps(plan_json(dog)["graph"]))
    assert data["balloons"][0]["left"] is None


def test_a_caution_is_told_from_its_step_on(planned):
    plan = planned("""
        balloons: {a: {size: 260, tail: 10}}
        steps:
          - bubbles: {one: 8}
          - bubbles: {two: 8, three: 8}
            turns: 9
        """)
    (turns,) = [caution for caution in plan.cautions if "9 turns" in caution.what]
    assert turns not in after_step(plan, 0).cautions
    assert turns in after_step(plan, 1).cautions


def test_the_drawing_shows_what_is_made(dog):
    drawn = plan_svg(dog, after_step(dog, 0))
    assert "right_ear 10" in drawn
    assert "neck 7" not in drawn


def test_a_step_that_is_not_there_is_refused(dog):
    with pytest.raises(IndexError, match="figure has no step 8"):
        after_step(dog, 7)


def test_what_a_lock_of_too_few_turns_joins_is_held_by_hand_alone(planned):
    head = "balloons: {a: {size: 260, tail: 10}}\nsteps:\n- bubbles: {b: 8, c: 8, d: 8}\n- lock: [b, c, d]\n"
    weak, firm = (after_step(planned(f"{head}  turns: {turns}\n"), 1) for turns in (1, 3))
    assert weak.graph.rings == firm.graph.rings == 1
    assert [str(end) for end in weak.loose] == ["b.end", "c.end", "d.end"]
    assert firm.loose == ()
    assert "held by hand alone: b.end, c.end, d.end" in after_step_text(weak)


def test_nothing_untwists_where_joints_freeze(planned):
    plan = planned("""
        balloons: {a: {size: 260, capsule: 40}}
        physics: {model: kosaka}
        steps: [{bubbles: {one: 8}}]
        """)
    assert after_step(plan, 0).loose == ()
