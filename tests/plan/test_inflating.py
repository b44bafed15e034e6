"""Balloons that are blown up by a step of their own, when and as fast as it says."""

from __future__ import annotations

import math
import re
from itertools import product

import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.operations.moves import PUSHING, Inflate, Pinch
from balloon_usd.operations.score import STROKE_SECONDS
from balloon_usd.plan import plan, plan_json, plan_text
from balloon_usd.plan.pumping import pumped
from balloon_usd.recipe import Recipe, RecipeError

HEAD = "format: 1\nname: several\nunits: cm\n"
FILLED = (
    "size: 260, length: 20, tail: 6",
    "size: 160, length: 15, inflated: 30",
    "size: 350, length: 12, tail: 3",
    "size: 646, length: 30, inflated: 60",
)
"""Of four balloons called a, b, c and d."""


def recipe_of(balloons: str, steps: list[str], more: str = "") -> Recipe:
    entries = ", ".join(f"{name}: {{{FILLED[ord(name) - ord('a')]}}}" for name in balloons)
    return Recipe.parse(f"{HEAD}balloons: {{{entries}}}\nsteps: [{', '.join(steps)}]\n{more}", file="f.yaml")


def bubble(balloon: str) -> str:
    return f"{{bubbles: {{{balloon}1: 8}}, balloon: {balloon}}}"


def pumps(recipe: Recipe) -> dict[str, Inflate]:
    return {move.balloon: move for move in plan(recipe).choreography.moves if isinstance(move, Inflate)}


def refusals(*steps: str, balloons: str = "ab", more: str = "") -> list[str]:
    with pytest.raises(RecipeError) as error:
        plan(recipe_of(balloons, list(steps), more))
    return [str(problem) for problem in error.value.problems]


@pytest.mark.parametrize("balloons", ["ab", "abc", "abcd"])
def test_any_of_two_to_four_balloons_are_blown_up_later_each_in_the_time_it_takes_at_the_beginning(balloons):
    usual = pumps(recipe_of(balloons, [bubble(each) for each in balloons]))
    assert {move.start for move in usual.values()} == {0.0}
    for later in product((False, True), repeat=len(balloons)):
        steps, blown_later = [], {}
        for name, is_later in zip(balloons, later, strict=True):
            if is_later:
                blown_later[name] = len(steps)
                steps.append(f"inflate: {name}")
            steps.append(bubble(name))
        made = plan(recipe_of(balloons, [f"{{{s}}}" if s[0] != "{" else s for s in steps]))
        moves = {move.balloon: move for move in made.choreography.moves if isinstance(move, Inflate)}
        for name, move in moves.items():
            assert move.seconds == usual[name].seconds
            assert move.step == blown_later.get(name, -1)
            assert (move.start == 0.0) == (name not in blown_later or (all(later) and name == balloons[0]))
            pinch = next(
                m
                for m in made.choreography.moves
                if isinstance(m, Pinch) and made.table.rings[m.ring].balloon == name
            )
            assert move.end < pinch.start


def test_a_step_blows_up_several_balloons_at_the_same_time_in_the_seconds_that_it_says():
    found = pumps(recipe_of("abc", [bubble("a"), "{inflate: [c, b], seconds: 2.5}", bubble("c")]))
    assert found["b"].start == found["c"].start > found["a"].end
    assert (found["b"].seconds, found["c"].seconds) == (2.5, 2.5)


@pytest.mark.parametrize("strokes", [1, 4, 40])
def test_a_stroke_takes_its_time_and_a_pump_that_is_drawn_back_brings_nothing(strokes):
    steady = pumps(recipe_of("b", ["{inflate: b}"]))["b"]
    by_hand = pumps(recipe_of("b", [f"{{inflate: b, strokes: {strokes}}}"]))["b"]
    assert (steady.strokes, by_hand.strokes) == (None, strokes)
    assert by_hand.seconds == pytest.approx(max(steady.seconds / PUSHING, strokes * STROKE_SECONDS))
    hurried = pumps(recipe_of("b", [f"{{inflate: b, strokes: {strokes}, seconds: 30}}"]))["b"]
    assert hurried.seconds == 30.0


def test_a_pump_is_not_worked_faster_than_a_hand_can():
    (line,) = refusals("{inflate: a, strokes: 10, seconds: 3}")
    told = "3 s are too short a time to work the pump 10 times, expected at least 3.5 s"
    assert line.endswith(f"steps[0].seconds: {told}")
    assert plan(recipe_of("a", ["{inflate: a, strokes: 10, seconds: 3.5}"]))


def test_the_plan_tells_how_much_air_each_stroke_brings():
    made = plan(recipe_of("ab", ["{inflate: a, strokes: 5}", "{inflate: b}"]))
    budget, size = made.budgets["a"], made.strips["a"].size
    air = (ATMOSPHERE + budget.pressure) * budget.volume / ATMOSPHERE - math.pi * size.radius**2 * size.length
    pumping = pumped(made, "a")
    assert (pumping.strokes, pumping.air) == (5, pytest.approx(air / 5))
    assert pumped(made, "b") is None
    told = {balloon["name"]: balloon["pumping"] for balloon in plan_json(made)["balloons"]}
    assert told == {"a": {"strokes": 5, "air": pumping.air}, "b": None}
    (line,) = (line for line in plan_text(made).splitlines() if "stroke" in line)
    assert line == f"  5 strokes of a pump, {1e6 * pumping.air:.0f} mL of air each"


def test_nothing_is_awaited_at_the_beginning_where_every_balloon_has_a_step():
    made = plan(recipe_of("a", ["{wait: 1}", "{inflate: a}"]))
    assert [move.text for move in made.choreography.moves[:2]] == ["wait", "inflate: a"]


def test_a_recipe_with_the_step_is_written_back_as_it_was():
    recipe = recipe_of("abc", ["{inflate: a, seconds: 1.5}", "{inflate: [b, c], note: both}"])
    assert "  - inflate: a\n    seconds: 1.5\n  - inflate: [b, c]\n    note: both\n" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()) == recipe


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("inflate: e", 'inflate: unknown balloon "e", expected one of a, b'),
        ("inflate: [a, a]", 'balloon "a" is blown up at steps[0].inflate[0], expected each balloon once'),
        ("inflate: []", "inflate: is empty, expected at least one entry"),
        ("inflate: a, strokes: 0", "0 is out of range, expected 1 to 100 strokes, the nearest is 1"),
        ("inflate: a, strokes: 2.5", "2.5 is no whole number, expected 1 to 100 strokes"),
        ("inflate: 7", "7 does not fit, expected a balloon, or a list such as [red, blue]"),
        (
            "inflate: a, balloon: a",
            "balloon: makes no sense with inflate, expected one of strokes, seconds, note",
        ),
    ],
)
def test_what_is_blown_up_is_one_or_several_balloons_that_are_there(step, told):
    (line,) = refusals(f"{{{step}}}")
    assert line.endswith(told)


def test_a_balloon_is_blown_up_once():
    (line,) = refusals("{inflate: b}", bubble("b"), "{inflate: [a, b]}")
    assert line.endswith('balloon "b" is blown up at steps[0].inflate, expected each balloon once')


@pytest.mark.parametrize(
    "step",
    [
        bubble("b"),
        "{loop: {b1: 20}, balloon: b}",
        "{rest: b1, balloon: b}",
        "{bend: {b_rest: 60}}",
        "{press: {bubble: b_rest, depth: 1}}",
    ],
)
def test_no_step_works_on_a_balloon_before_it_is_blown_up_and_the_other_order_works(step):
    (line,) = refusals(step, "{inflate: b}")
    told = 'balloon "b" is flat until steps[1].inflate blows it up: expected this step after that one'
    assert line.endswith(f"steps[0]: {told}")
    assert plan(recipe_of("ab", ["{inflate: b}", step]))


def test_work_on_a_flat_balloon_is_told_once():
    found = refusals("{bubbles: {x: 5, y: 6}, balloon: b}", "{lock: [x, y]}", "{inflate: b}")
    assert len(found) == 1


def test_balloons_of_model_kosaka_start_blown_up():
    text = f"{HEAD}balloons: {{a: {{size: 260, capsule: 20}}}}\nsteps: [{{inflate: a}}]\n"
    with pytest.raises(
        RecipeError, match=r"inflate: makes no sense with model kosaka.*expected no such step"
    ):
        plan(Recipe.parse(f"{text}physics: {{model: kosaka}}\n"))


@pytest.mark.parametrize(("fps", "seconds"), [(24, 0.2), (10, 0.5), (7, 0.8), (3, 1.2), (1, 5), (25, 0.23)])
@pytest.mark.parametrize("remedy", ["seconds", "fps"])
def test_too_few_frames_are_told_at_the_step_with_what_is_enough(fps, seconds, remedy):
    steps = [bubble("a"), "{{inflate: b, seconds: {}}}"]
    text = "fps: {}\n"
    # At 1 frame/s balloon a has too few frames, too: it has a step of its own.
    steps = ["{inflate: a, seconds: 60}", *steps]
    (line,) = refusals(*steps[:2], steps[2].format(seconds), more=text.format(fps))
    found = re.search(r"steps\[2\]\.seconds: .*seconds: ([\d.]+), or at least ([\d.]+) frames/s$", line)
    assert found is not None, line
    if remedy == "seconds":
        seconds = float(found[1])
    else:
        fps = float(found[2])
    assert plan(recipe_of("ab", [*steps[:2], steps[2].format(seconds)], text.format(fps)))


def test_a_step_without_seconds_that_has_too_few_frames_is_told_what_it_can_say():
    (line,) = refusals("{inflate: [a, b], seconds: 6}", "{inflate: c}", balloons="abc", more="fps: 1\n")
    found = re.search(r"steps\[1\]: .*expected seconds: (\d+), or", line)
    assert found is not None, line
    steps = ["{inflate: [a, b], seconds: 6}", f"{{inflate: c, seconds: {found[1]}}}"]
    assert plan(recipe_of("abc", steps, "fps: 1\n"))
