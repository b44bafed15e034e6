"""Repeats and named values: what they stand for, and what is refused, with its place."""

from __future__ import annotations

import time

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.recipe.repeats import MOST_STEPS

HEAD = "format: 1\nname: d\nunits: cm\nballoons: {main: {size: 260, tail: 10}}\n"
"""Its steps begin in line 5."""


def problems(text):
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(HEAD + text)
    return [str(problem).removeprefix("<text>:") for problem in caught.value.problems]


def written(text):
    return Recipe.parse(HEAD + text).to_yaml().partition("steps:\n")[2]


def test_a_repeat_stands_for_its_steps_once_for_each_number():
    short = "steps:\n- repeat: {k: 3}\n  steps:\n  - bubbles: {b_<k>: = k + 1}\n  - bubbles: {c_<k>: 2}\n"
    long = "steps:\n" + "".join(
        f"- bubbles: {{b_{k}: {k + 1}}}\n- bubbles: {{c_{k}: 2}}\n" for k in (1, 2, 3)
    )
    assert Recipe.parse(HEAD + short) == Recipe.parse(HEAD + long)


def test_counters_count_from_where_they_are_told_or_take_their_values_from_lists():
    text = "steps:\n- repeat: {k: 2 to 3, side: [left, right]}\n  steps:\n  - loop: {<side>_<k>: 12}\n    point: <side>\n"
    assert written(text) == (
        "  - loop: {left_2: 12}\n    point: left\n  - loop: {right_3: 12}\n    point: right\n"
    )


def test_repeats_within_each_other_know_all_counters():
    text = (
        "steps:\n- repeat: {k: 2}\n  steps:\n  - repeat: {j: = k}\n    steps: [{bubbles: {b_<k>_<j>: 3}}]\n"
    )
    names = [bubble.name for bubble in plan(Recipe.parse(HEAD + text)).bubbles]
    assert names == ["b_1_1", "b_2_1", "b_2_2", "main_rest"]


def test_named_values_may_need_each_other_in_any_order():
    text = "let: {b: = 2 * a, a: 1.5, far: = b + 1 in}\nsteps: [{bubbles: {x: = b, y: = far}}]\n"
    assert written(text).startswith('  - bubbles: {x: 3, y: "0.0554 m"}') or "5.54" in written(text)


def test_a_balloon_is_repeated_with_its_color_and_its_steps():
    text = (
        "format: 1\nname: d\nunits: cm\nlet: {tail: 8}\n"
        "balloons:\n  <c>_one: {repeat: {c: [red, blue]}, size: 260, color: <c>, tail: = tail}\n"
        "steps:\n- repeat: {c: [red, blue]}\n  steps:\n  - {bubbles: {<c>: 9}, balloon: <c>_one}\n"
    )
    recipe = Recipe.parse(text)
    assert list(recipe.balloons) == ["red_one", "blue_one"]
    assert recipe.balloons["blue_one"].tail == pytest.approx(0.08)
    assert recipe.balloons["blue_one"].color != recipe.balloons["red_one"].color


def test_bubbles_may_be_called_like_keys_of_the_recipe():
    text = (
        "let: {note: 3}\nsteps: [{bubbles: {name: = note, title: 4, units: = note}, note: = as it stands}]\n"
    )
    recipe = Recipe.parse(HEAD + text)
    assert recipe.steps[0].lengths == pytest.approx({"name": 0.03, "title": 0.04, "units": 0.03})
    assert recipe.steps[0].note == "= as it stands"


def test_a_problem_in_a_repeat_stands_at_its_place_and_says_in_which_one():
    text = "steps:\n- repeat: {k: 2}\n  steps:\n  - bubbles: {b_<k>: 3}\n    seconds: = 50 * k\n"
    assert problems(text) == [
        "9:14: steps[1].seconds: 100 is out of range, expected 0.2 to 60 s, the nearest is 60 (with k = 2)"
    ]


def test_a_problem_of_the_plan_in_a_repeat_stands_at_its_place():
    text = "steps:\n- repeat: {k: 9}\n  steps:\n  - bubbles: {b_<k>: 30}\n"
    with pytest.raises(RecipeError, match=r"<text>:8:22: steps\[\d\]\.bubbles\.b_\d: .*\(with k = \d\)"):
        plan(Recipe.parse(HEAD + text))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("let: {a: = a}\n", "5:10: let.a: names itself: a -> a, expected a value that does not need itself"),
        (
            "let: {a: = b, b: = a}\n",
            "5:10: let.a: names itself: a -> b -> a, expected a value that does not need itself",
        ),
        ("let: 3\n", "5:6: let: 3 does not fit, expected entries such as {ear: 3}"),
        ("let: {a: [1]}\n", "5:7: let.a: [1] does not fit, expected a number, a length or a text"),
        ("let: {2a: 1}\n", '5:11: let.2a: "2a" is no name'),
    ],
)
def test_a_named_value_that_makes_no_sense_is_refused_at_its_place(text, told):
    assert problems(text + "steps: [{bubbles: {x: 3}}]\n")[0].replace('["2a"]', ".2a").startswith(told)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("{repeat: .inf, steps: [{bubbles: {x: 3}}]}", "5:18: steps[0].repeat: inf does not say how often"),
        ("{repeat: 0, steps: [{bubbles: {x: 3}}]}", "5:18: steps[0].repeat: 0 times, expected 1 to 500"),
        ("{repeat: 501, steps: [{bubbles: {x: 3}}]}", "5:18: steps[0].repeat: 501 times, expected 1 to 500"),
        ("{repeat: true, steps: [{bubbles: {x: 3}}]}", "5:18: steps[0].repeat: true does not say how often"),
        (
            "{repeat: {}, steps: [{bubbles: {x: 3}}]}",
            "5:10: steps[0].repeat: is empty, expected a number of times",
        ),
        ("{repeat: {k: []}, steps: [{bubbles: {x: 3}}]}", "5:19: steps[0].repeat.k: 0 values of a counter"),
        (
            "{repeat: {k: 3 to 2}, steps: [{bubbles: {x: 3}}]}",
            '5:22: steps[0].repeat.k: "3 to 2" is no range',
        ),
        (
            "{repeat: {k: 2, j: [a]}, steps: [{bubbles: {x: 3}}]}",
            "5:10: steps[0].repeat: counters differ in how many",
        ),
        ("{repeat: {k k: 2}, steps: [{bubbles: {x: 3}}]}", '5:24: steps[0].repeat["k k"]: "k k" is no name'),
        ("{repeat: = 3 * x, steps: [{bubbles: {x: 3}}]}", '5:18: steps[0].repeat: unknown name "x"'),
        ("{repeat: 3}", "5:9: steps[0].steps: is missing, expected a list of steps that are repeated"),
        ("{repeat: 3, steps: []}", "5:21: steps[0].steps: [] does not fit, expected a list of steps"),
        (
            "{repeat: 3, steps: [wait: 1], turns: 2}",
            "5:46: steps[0].turns: stands beside repeat, expected one of steps, note",
        ),
        ("{repeat: {k: 2}, steps: [{bubbles: {x_<j>: 3}}]}", 'bubbles["x_<j>"]: unknown name "j"'),
        (
            "{repeat: {k: 2}, steps: [{bubbles: {x_<k / 2>: 3}}]}",
            'bubbles["x_<k / 2>"]: <k / 2> is 0.5, expected',
        ),
        (
            "{repeat: {k: 2}, steps: [{bubbles: {x_<k>: 3, x_<k + 0>: 3}}]}",
            'the name "x_1" is there already, expected another one',
        ),
        ("{bubbles: {x: = 3 / 0}}", "5:23: steps[0].bubbles.x: 3 is divided by 0"),
        (
            "{repeat: 2, steps: [{bubbles: {x: 3}}]}",
            'bubble "x" was made at steps[0].bubbles.x, expected a new name',
        ),
    ],
)
def test_a_repeat_that_makes_no_sense_is_refused_at_its_place(text, told):
    assert told in problems(f"steps: [{text}]\n")[0]


def test_a_counter_has_a_name_of_its_own():
    text = "let: {k: 2}\nsteps: [{repeat: {k: 3}, steps: [{bubbles: {x_<k>: 3}}]}]\n"
    assert "has the name of a value or of another counter" in problems(text)[0]


def test_repeats_that_would_never_end_are_stopped_at_once():
    inner = "{bubbles: {x_<a>_<b>_<c>: 3}}"
    for counter in "cba":
        inner = f"{{repeat: {{{counter}: 500}}, steps: [{inner}]}}"
    begun = time.monotonic()
    assert f"more than {MOST_STEPS} steps when written out" in problems(f"steps: [{inner}]\n")[0]
    assert time.monotonic() - begun < 5.0


def test_named_values_that_grow_without_end_are_refused():
    text = ", ".join(["v0: 9e9", *(f"v{k + 1}: = v{k} * v{k}" for k in range(30))])
    assert "is too large" in problems(f"let: {{{text}}}\nsteps: [{{bubbles: {{x: = v30}}}}]\n")[0]


def test_what_is_wrong_in_the_file_is_told_together_with_formulas_that_are():
    told = problems("steps: [{bubbles: {x: = 3 / 0}, turns: 2.3}, {lock: [y]}, &a {wait: 1}]\n")
    assert len(told) == 4


def test_a_slip_in_let_or_repeat_gets_the_nearest_word():
    assert 'unknown key "lets", did you mean "let"?' in problems("lets: {a: 1}\nsteps: [{wait: 1}]\n")[0]
    assert any(
        'unknown key "repaet", did you mean "repeat"?' in each for each in problems("steps: [{repaet: 3}]\n")
    )


def test_a_long_chain_of_named_values_is_refused_and_a_short_one_is_not():
    def chain(links):
        named = ", ".join([*(f"v{k}: = v{k + 1}" for k in range(links)), f"v{links}: 3"])
        return f"let: {{{named}}}\nsteps: [{{bubbles: {{x: = v0}}}}]\n"

    assert Recipe.parse(HEAD + chain(40)).steps[0].lengths == pytest.approx({"x": 0.03})
    assert "needs a chain of more than 50 other values" in problems(chain(3000))[0]


@pytest.mark.parametrize(
    "inner",
    ["{repeat: 0, steps: [wait: 1]}", "{repeat: 3, steps: nothing}", "{repeat: 3, steps: []}", "{wait: = x}"],
)
def test_what_is_wrong_in_every_round_is_told_once_and_soon(inner):
    for counter in "cba":
        inner = f"{{repeat: {{{counter}: 500}}, steps: [{inner}]}}"
    begun = time.monotonic()
    assert len(problems(f"steps: [{inner}]\n")) == 1
    assert time.monotonic() - begun < 2.0


def test_repeats_of_no_steps_and_of_many_balloons_are_stopped():
    rows = "".join(f"  m{k}_<k>: {{repeat: {{k: 500}}, size: 260, tail: 30}}\n" for k in range(20))
    text = f"format: 1\nname: d\nunits: cm\nballoons:\n{rows}steps: [wait: 1]\n"
    with pytest.raises(RecipeError, match="more than 200 balloons when written out"):
        Recipe.parse(text)


def test_a_wrong_named_value_brings_no_second_message_where_it_is_used():
    assert len(problems("let: {x: [1, 2]}\nsteps: [{bubbles: {a: = x, b: = x}}]\n")) == 1


def test_joints_that_must_hold_may_be_told_by_named_values():
    text = "let: {n: 2}\nsteps:\n- {repeat: {k: = n}, steps: [{bubbles: {b_<k>: 4}}, {ear: {e_<k>: 3}}]}\nmust_hold: [e_<n>.start]\n"
    assert [str(end) for end in Recipe.parse(HEAD + text).must_hold] == ["e_2.start"]


def test_a_whole_number_written_with_a_point_counts():
    text = "steps:\n- repeat: {k: 2.0}\n  steps: [{bubbles: {b_<k>: 4}}]\n"
    assert len(Recipe.parse(HEAD + text).steps) == 2
