"""Long sides of rings: what cannot lie straight between its joints is told, a pair and a handy ring are not."""

from __future__ import annotations

import pytest

NET = """
balloons: {a: {size: 260, tail: 15}, b: {size: 260, tail: 8}}
steps:
  - bubbles: {p: 8, q: 8, r: 8}
    balloon: a
  - lock: [p, q, r]
  - bubbles: {s: %s, t: 8}
    balloon: b
  - lock: {joints: [p.start, s.start]}
  - lock: {joints: [q.start, t.end]}
"""


def said(figure) -> list[str]:
    return [caution.what for caution in figure.cautions if "is longer than" in caution.what]


def triangle(first: float, second: float, third: float) -> str:
    return (
        "balloons: {a: {size: 260, tail: 12}}\n"
        f"steps: [{{bubbles: {{b: {first}, c: {second}, d: {third}}}}}, {{lock: [b, c, d]}}]"
    )


def test_a_side_longer_than_both_others_together_is_told_with_what_would_fit(planned):
    figure = planned(triangle(30, 6, 7))
    (caution,) = [each for each in figure.cautions if "is longer than" in each.what]
    assert caution.step == 0
    assert caution.what == "b (30 cm) is longer than c and d together (13 cm)"
    assert "bows out" in caution.why
    assert caution.remedy == "make it 13 cm long, or the others longer"
    assert said(planned(triangle(13, 6, 7))) == []


@pytest.mark.parametrize("sides", [(10, 5, 10), (12, 6, 6), (13, 6, 6), (8, 8, 8)])
def test_a_triangle_that_closes_and_one_that_is_drawn_a_little_are_a_design(planned, sides):
    assert said(planned(triangle(*sides))) == []


def test_a_long_side_of_a_net_of_several_balloons_is_told(planned):
    assert said(planned(NET % 8)) == []
    assert said(planned(NET % 40)) == ["s (40 cm) is longer than p and t together (16 cm)"]


def test_a_pair_and_a_loop_are_no_sides_of_a_ring(planned):
    figure = planned(
        "balloons: {a: {size: 260, tail: 10}}\nsteps: [{bubbles: {b: 20, c: 5}}, {lock: [b, c]}]"
    )
    assert said(figure) == []
    assert said(planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [{loop: {b: 20}}]")) == []
