"""The plan as text and as data."""

from __future__ import annotations

import json

from balloon_usd.plan import plan_json, plan_text


def test_the_text_names_every_bubble_joint_and_lock(dog):
    text = plan_text(dog)
    for bubble in dog.bubbles:
        assert f"  {bubble.name} " in text
    for joint in dog.graph.joints:
        assert str(joint) in text
    assert "step 2 locks left_ear.start, right_ear.end (joint 1)" in text


def test_the_text_tells_the_tail_and_how_far_to_blow(dog):
    text = plan_text(dog)
    assert "Classic dog (figure)\nafter Kosaka 2008, fig. 2.4\n" in text
    assert "blow up 110.7 cm, leave 10 cm flat" in text
    assert "9 twists use 8.3 cm of flat tail (about 0.9 cm each), 1.7 cm are left" in text
    assert text.endswith("no cautions\n")


def test_the_text_gives_every_caution_with_its_reason(planned):
    figure = planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [{ear: {b: 1.5}}]")
    text = plan_text(figure)
    assert "1 caution\n  step 1: b (1.5 cm) will be a hard little ball\n    because below 2 cm" in text
    assert "1 twist uses" in text


def test_the_data_survive_json(dog):
    data = plan_json(dog)
    assert json.loads(json.dumps(data, allow_nan=False)) == data


def test_the_data_hold_what_the_plan_holds(dog):
    data = plan_json(dog)
    (balloon,) = data["balloons"]
    assert data["format"] == 1
    assert data["recipe_sha256"] == dog.recipe.sha256
    assert [bubble["name"] for bubble in balloon["bubbles"]] == [bubble.name for bubble in dog.bubbles]
    assert balloon["budget"]["tail_left"] == dog.budgets["main"].tail_left
    assert len(data["graph"]["joints"]) == 8
    assert data["cautions"] == []


def test_a_plan_is_the_same_every_time(planned, dog):
    assert plan_json(planned("""
        title: Classic dog
        balloons: {main: {size: 260, color: red, tail: 10}}
        steps: [{loop: {b: 20}}]
        """)) == plan_json(planned("""
        title: Classic dog
        balloons: {main: {size: 260, color: red, tail: 10}}
        steps: [{loop: {b: 20}}]
        """))  # fmt: skip
