"""Bends that lay a bubble where another one is are told; those that only turn a chain are not."""

from __future__ import annotations

import pytest


def onto(planned, lengths: str, *bends: tuple[str, float, str]) -> list[str]:
    steps = "".join(f", {{bend: {{{name}: {angle}}}, point: {point}}}" for name, angle, point in bends)
    figure = planned(f"balloons: {{a: {{size: 260, tail: 15}}}}\nsteps: [{{bubbles: {{{lengths}}}}}{steps}]")
    return [caution.what for caution in figure.cautions if "onto" in caution.what]


def test_two_half_turns_to_one_side_close_a_circle_on_what_hangs_on_it(planned):
    said = onto(planned, "b: 8, c: 8, d: 8", ("c", 180, "up"), ("d", 180, "up"))
    assert said == ["bends lay d onto b", "bends lay a_rest onto c"]


def test_two_ends_that_are_bent_back_over_one_bubble_to_one_side_meet(planned):
    bubbles = "b: 10, c: 10, d: 10, e: 10"
    assert "bends lay a_rest onto b" in onto(planned, bubbles, ("c", 180, "up"), ("e", 180, "up"))
    assert onto(planned, bubbles, ("c", 180, "up"), ("e", 180, "down")) == []


@pytest.mark.parametrize(
    "bends",
    [
        [("c", 180, "up")],
        [("c", 180, "up"), ("d", 180, "down")],
        [("c", 90, "up"), ("d", 90, "left")],
        [("b", 90, "up"), ("b", 90, "left")],
        [],
    ],
)
def test_chains_that_are_bent_otherwise_are_not_told(planned, bends):
    assert onto(planned, "b: 10, c: 10, d: 10", *bends) == []


def test_tiny_bubbles_beside_each_other_lie_in_none(planned):
    assert onto(planned, "b: 8, c: 1, d: 2, e: 2, f: 1", ("b", 10, "up")) == []


def test_it_is_told_at_the_bend_with_a_remedy(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 15}}
        steps: [{bubbles: {b: 10, c: 4, d: 10}}, {wait: 1}, {bend: {c: 180}}]
        """)
    (caution,) = [each for each in figure.cautions if "onto" in each.what]
    assert caution.step == 2
    assert caution.remedy == "bend them less, or to another point"
