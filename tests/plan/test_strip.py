"""Strips: where every bubble lies along the inflated and the flat tube."""

from __future__ import annotations

from itertools import pairwise

import pytest

from balloon_usd.balloon.bubble_shape import bubble_of_length
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.recipe import RecipeError

CM = 0.01


def problem_of(planned, body: str) -> str:
    with pytest.raises(RecipeError) as caught:
        planned(body)
    return str(caught.value)


def test_the_thesis_dog_takes_283_millimetres_of_flat_rubber(dog):
    assert dog.strips["main"].bubbles[-2].rest_end == pytest.approx(0.283, abs=0.5e-3)


def test_bubbles_lie_end_to_end_from_the_knot_to_the_tip(dog):
    strip = dog.strips["main"]
    assert (strip.bubbles[0].start, strip.bubbles[0].rest_start) == (0.0, 0.0)
    for before, after in pairwise(strip.bubbles):
        assert (after.start, after.rest_start) == (before.end, before.rest_end)
    assert strip.bubbles[-1].rest_end == strip.size.length
    assert strip.bubbles[-2].end == pytest.approx(100 * CM)


def test_every_bubble_takes_the_rubber_and_gas_of_its_shape(dog):
    strip = dog.strips["main"]
    for bubble in strip.bubbles[:-1]:
        shape = bubble_of_length(strip.size, strip.rubber, bubble.length)
        assert bubble.rest_length == pytest.approx(shape.rest_length)
        assert bubble.volume == pytest.approx(shape.volume)


def test_a_ball_takes_more_rubber_than_a_copy_of_a_longer_bubble_and_lies_at_its_own_pressure(planned):
    strip = planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [bubbles: {b: 2, c: 1, d: 9}]").strips["a"]
    soft, hard, long, _ = strip.bubbles
    assert soft.rest_length / CM == pytest.approx(1.305, abs=2e-3)
    assert soft.volume == pytest.approx(6.7e-6, rel=5e-3)
    assert hard.rest_length / CM == pytest.approx(0.919, abs=2e-3)
    assert [soft.pressure, hard.pressure, long.pressure] == pytest.approx([7134.0, 14265.0, 7134.5], rel=1e-3)


def test_the_tail_that_balls_fill_is_that_of_their_rubber_and_gas(planned):
    balls = ", ".join(f"b{k}: 1.3" for k in range(5))
    budget = planned(f"balloons: {{a: {{size: 260, tail: 10}}}}\nsteps: [bubbles: {{{balls}}}]").budgets["a"]
    shape = bubble_of_length(size_named("260"), rubber_named(), 1.3 * CM)
    gained = 8.379e-6 / 1e-3
    used = 5.0 * (8.462e-6 / 1e-3 * shape.rest_length - shape.volume) / gained
    assert budget.tail_used == pytest.approx(used, rel=2e-3)


def test_no_gas_is_lost(dog):
    assert sum(bubble.volume for bubble in dog.bubbles) == pytest.approx(dog.budgets["main"].volume)


def test_kinds_and_steps_follow_the_recipe(planned):
    strip = planned("""
        balloons: {a: {size: 260, tail: 12}}
        steps:
          - bubbles: {head: 6}
          - wait: 1
          - loop: {left: 20, right: 20}
          - fold: {wing: 12}
          - ear: {knob: 3}
          - rest: blade
        """).strips["a"]
    made = [(bubble.name, bubble.kind, bubble.step) for bubble in strip.bubbles]
    assert made == [
        ("head", "bubble", 0),
        ("left", "loop", 2),
        ("right", "loop", 2),
        ("wing", "fold", 3),
        ("knob", "ear", 4),
        ("blade", "rest", 5),
    ]


def test_a_balloon_without_a_rest_step_ends_in_a_bubble_named_after_it(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 12}, b: {size: 160, tail: 12}}
        steps:
          - {bubbles: {a_rest: 6}, balloon: a}
          - {bubbles: {c: 6}, balloon: b}
        """)
    assert [bubble.name for bubble in figure.bubbles] == ["a_rest", "a_rest_", "c", "b_rest"]
    assert figure.strips["a"].bubbles[-1].step == 2


def test_an_inflated_length_is_a_tail_in_other_words(planned):
    body = "balloons: {{a: {{size: 260, {}}}}}\nsteps: [{{bubbles: {{c: 6}}}}]"
    tail = planned(body.format("tail: 10")).budgets["a"]
    again = planned(body.format(f"inflated: {tail.inflated_length / CM}")).strips["a"]
    assert again.tail == pytest.approx(10 * CM)


def test_the_nominal_length_of_a_size_counts_as_full(planned):
    strip = planned('balloons: {a: {size: 260, inflated: "60 in"}}\nsteps: [{bubbles: {c: 6}}]').strips["a"]
    assert strip.tail == 0.0


def test_dimensions_of_a_brand_replace_those_of_the_size(planned):
    strip = planned("""
        balloons: {a: {size: 260, tail: 10, length: 28.2}}
        steps: [{bubbles: {c: 6}}]
        """).strips["a"]
    assert strip.bubbles[-1].rest_end == pytest.approx(28.2 * CM)


def test_a_tail_longer_than_the_balloon_is_refused_at_its_place(planned):
    text = problem_of(planned, "balloons:\n  a: {size: 260, tail: 40}\nsteps: [{bubbles: {c: 6}}]")
    assert text.startswith("figure.yaml:5:")
    assert "balloons.a.tail: a tail of 40 cm leaves nothing of a 260, expected at most 35.2 cm" in text


def test_more_than_a_full_balloon_is_refused_with_the_full_length(planned):
    text = problem_of(planned, "balloons: {a: {size: 260, inflated: 200}}\nsteps: [{bubbles: {c: 6}}]")
    assert "balloons.a.inflated: 200 cm is more than a full 260, expected at most 152.1 cm" in text


def test_a_bubble_beyond_the_gas_is_refused_with_the_tail_that_would_do(planned):
    text = problem_of(planned, """
        balloons: {a: {size: 260, tail: 25}}
        steps:
          - bubbles: {b: 20}
          - bubbles: {c: 20, d: 20, e: 5}
        """)  # fmt: skip
    assert 'steps[1].bubbles.d: "d" of 20 cm does not fit' in text
    assert "expected a tail of at most 22.4 cm" in text


def test_the_tail_that_would_do_does(planned):
    body = "balloons: {{a: {{size: 260, tail: {}}}}}\nsteps: [{{bubbles: {{b: 20, c: 20, d: 20, e: 5}}}}]"
    with pytest.raises(RecipeError):
        planned(body.format(22.5))
    assert planned(body.format(22.4)).strips["a"].bubbles[-1].length < 2 * CM


def test_bubbles_longer_than_the_balloon_are_refused_with_the_excess(planned):
    text = problem_of(planned, """
        balloons: {a: {size: 260, tail: 3}}
        steps: [{bubbles: {b: 80, c: 90, d: 90}}]
        """)  # fmt: skip
    assert "steps[0].bubbles.c" in text
    assert "expected bubbles shorter by" in text


def test_all_balloons_that_do_not_fit_are_reported_at_once(planned):
    text = problem_of(planned, """
        balloons: {a: {size: 260, tail: 40}, b: {size: 160, inflated: 300}}
        steps: [{bubbles: {c: 6}, balloon: a}]
        """)  # fmt: skip
    assert len(text.splitlines()) == 2


@pytest.mark.parametrize("rubber", ["neo-hooke", "mooney-rivlin"])
def test_a_rubber_without_bulged_phase_is_refused(planned, rubber):
    text = problem_of(planned, f"""
        balloons: {{a: {{size: 260, tail: 10}}}}
        steps: [{{bubbles: {{c: 6}}}}]
        physics: {{rubber: {rubber}}}
        """)  # fmt: skip
    assert "physics.rubber" in text
    assert "no bulged phase" in text


def test_softening_reaches_the_strip_and_shapes_do_not_depend_on_it(planned):
    body = """
        balloons: {{a: {{size: 260, tail: 10}}}}
        steps: [{{bubbles: {{c: 6}}}}]
        physics: {{softening: {}}}
        """
    soft, hard = planned(body.format("true")).strips["a"], planned(body.format("false")).strips["a"]
    assert soft.rubber.softening is not None
    assert hard.rubber.softening is None
    assert soft.bubbles == hard.bubbles


@pytest.mark.parametrize("length", ["1e-300", "0.01", "0.2"])
def test_a_bubble_that_is_shorter_than_a_neck_is_wide_is_refused(planned, length):
    body = f"balloons: {{main: {{size: 260, tail: 8}}}}\nsteps: [bubbles: {{a: 8, b: {length}}}]\n"
    told = "steps[0].bubbles.b: is shorter than a neck of a 260 is wide, expected 0.3 cm or more"
    assert told in problem_of(planned, body)
