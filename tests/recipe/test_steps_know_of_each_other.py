"""What one step has done to bubbles, others know."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

HEAD = """
format: 1
name: figure
units: cm
balloons: {main: {size: 260, length: 40, tail: 12}}
steps:
"""
NOSE = "  - bubbles: {nose: 4, left: 6, right: 6}\n  - lock: [left, right]\n"
LOOP = "  - bubbles: {nose: 4}\n  - loop: {ring: 60}\n"
TWO = """
format: 1
name: two
units: cm
balloons:
  m: {size: 260, length: 34, tail: 9}
  n: {size: 260, length: 34, tail: 9}
steps:
  - {bubbles: {a: 8}, balloon: m}
  - ear: {one: 3}
    balloon: m
  - {bubbles: {r: 8, s: 8}, balloon: m}
  - {bubbles: {x: 8}, balloon: n}
  - lock: {joints: [r.start, x.start]}
  - lock: {joints: [r.end, x.end]}
"""


def refusal(*steps: str, head: str = HEAD) -> str:
    with pytest.raises(RecipeError) as found:
        plan(Recipe.parse(head + "".join(steps)))
    assert len(found.value.problems) == 1
    return found.value.problems[0].text


def cautions(*steps: str, head: str = HEAD) -> list[str]:
    return [caution.what for caution in plan(Recipe.parse(head + "".join(steps))).cautions]


@pytest.mark.parametrize(
    "through", ["push: {bubble: nose, through: [ring]}", "tuck: {bubble: nose, between: [ring]}"]
)
def test_nothing_goes_through_a_loop_whose_halves_are_wound(through: str) -> None:
    text = refusal(LOOP, "  - rest: tail\n  - spiral: {bubbles: [ring]}\n", f"  - {through}\n")
    assert (
        text == "ring is wound or plaited at steps[3].spiral.bubbles, expected bubbles with room between them"
    )


def test_what_holds_a_bubble_is_not_wound_round_itself() -> None:
    steps = "  - push: {bubble: nose, through: [left, right]}\n  - rest: tail\n"
    text = refusal(NOSE, steps, "  - spiral: {bubbles: [left, right], turns: 0.5}\n")
    assert text.startswith("step 3 pushes nose through left, right, which hold it: expected bubbles between")


@pytest.mark.parametrize(
    ("put", "turned", "told"),
    [
        ("push: {bubble: nose, through: [left, right]}", "nose: back", "nose would take nose away"),
        ("push: {bubble: nose, through: [left, right]}", "left: up", "left would take nose away"),
        ("thread: {bubble: tail, through: [left, right]}", "tail: up", "tail would take tail away"),
    ],
)
def test_what_goes_through_a_ring_is_not_turned_away_from_it(put: str, turned: str, told: str) -> None:
    rest = "  - rest: tail\n"
    made = (rest, f"  - {put}\n") if "tail" not in put else (f"  - {put}\n", rest)
    assert refusal(NOSE, *made, f"  - aim: {{{turned}}}\n").startswith(told)


def test_a_lock_that_divides_the_ring_of_a_bubble_is_told() -> None:
    put = "  - push: {bubble: nose, through: [left, right]}\n  - rest: tail\n"
    assert cautions(NOSE, put) == []
    (told,) = cautions(NOSE, put, "  - lock: {joints: [left.start, left.end]}\n")
    assert told == "nose is held no more once left and right are no ring"


def test_a_neighbour_behind_a_twist_that_slips_may_lose_its_gas_once_a_bubble_is_popped() -> None:
    steps = "  - bubbles: {a: 6}\n  - ear: {e: 3}\n    turns: TURNS\n  - bubbles: {gap: 6}\n  - ear: {f: 3}\n"
    steps += "  - rest: tail\n  - pop: gap\n"
    assert not any("lose gas" in told for told in cautions(steps.replace("TURNS", "3")))
    told = cautions(steps.replace("TURNS", "1"))
    assert "a and e may lose gas beside gap, which is popped" in told


def test_a_popped_bubble_is_no_pair_of_a_married_row() -> None:
    married = "  - {rest: m_end, balloon: m}\n  - pop: r\n  - marriage: {bubbles: {w: 8, v: 8}, to: [r, s]}\n"
    assert refusal(married + "    balloon: n\n", head=TWO).startswith(
        "r is popped, expected bubbles that have"
    )


def test_a_tip_is_tied_before_anything_is_twisted_to_it() -> None:
    steps = NOSE + "  - rest: tail\n  - lock: {joints: [tail.end, left.end]}\n"
    text = refusal(steps, "  - tie: {end: tail.end, to: right.end}\n")
    assert text == "tail.end is joined to others before its tip is closed, expected this step before that one"


def test_what_is_cut_off_is_no_end_of_a_balloon_any_more() -> None:
    steps = "  - bubbles: {a: 6}\n  - ear: {e: 3}\n  - bubbles: {b: 6}\n  - rest: tail\n  - cut: a\n"
    text = refusal(steps, "  - tie: {end: e.start, to: b.end}\n")
    assert text.startswith("e.start is no end of balloon main, expected the end of what a step rest names;")


def test_a_hoop_whose_ends_are_tied_has_a_hole() -> None:
    steps = "  - bubbles: {ring: 25}\n  - lock: {joints: [ring.start, ring.end]}\n  - ear: {nose: 4}\n"
    assert cautions(steps, "  - rest: tail\n  - tuck: {bubble: nose, between: [ring]}\n") == []


def test_popped_bubbles_take_no_room_about_a_joint() -> None:
    ears = "".join(f"  - ear: {{e{k}: 3}}\n" for k in range(7))
    pops = "".join(f"  - pop: e{k}\n" for k in range(1, 6))
    more = "".join(f"  - ear: {{f{k}: 3}}\n" for k in range(7))
    start = "  - bubbles: {nose: 4}\n"
    head = HEAD.replace("length: 40, tail: 12", "length: 60, tail: 25")
    assert "14 bubbles of at most 3 cm would meet" in refusal(start, ears, more, head=head)
    assert not any("e1" in told for told in cautions(start, ears, pops, more, "  - rest: tail\n", head=head))


def test_a_direction_is_of_use_where_a_lock_closes_a_chain_and_joins_another_balloon() -> None:
    lock = "  - lock: {joints: [a.start, a.end, x.end]}\n    point: left\n"
    head = TWO[: TWO.index("  - lock: {joints: [r.start")].replace("{a: 8}", "{z: 5, a: 30}")
    assert not any("changes nothing" in told for told in cautions(lock, head=head))


def test_nothing_but_a_row_hangs_on_the_end_of_a_bubble_that_is_wrapped_round_its_neck() -> None:
    row = "  - bubbles: {muzzle: 24, behind: 12}\n  - rest: nose\n"
    wrap = "  - wrap: {bubble: muzzle, neck: nose.start}\n"
    assert cautions(row, wrap) == []
    steps = "  - bubbles: {a: 12}\n" + row + "  - lock: {joints: [a.start, muzzle.end]}\n"
    assert refusal(steps, wrap) == "a hangs on muzzle.end, too, expected nothing but a row there"
