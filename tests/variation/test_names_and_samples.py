from __future__ import annotations

from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.language.names import name
from balloon_usd.variation.naming import FEW, names_with_values, numbered_names
from balloon_usd.variation.sampling import draw, sweep


def test_a_sweep_goes_through_the_last_parameter_first():
    assert list(sweep([2, 3])) == [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2)]


def test_a_seed_draws_the_same_on_every_computer():
    assert draw([3, 6001], 4, 7) == [(0, 905), (1, 434), (1, 2194), (0, 3045)]


@given(st.lists(st.integers(1, 4), min_size=1, max_size=3), st.integers(1, 40), st.integers(0, 2**70))
def test_no_combination_is_drawn_again_before_all_are(counts, number, seed):
    drawn, every = draw(counts, number, seed), prod(counts)
    assert len(drawn) == number
    for start in range(0, number, every):
        part = drawn[start : start + every]
        assert len(set(part)) == len(part)
    assert all(0 <= at < count for row in drawn for at, count in zip(row, counts, strict=True))


def test_every_combination_of_a_large_sweep_is_drawn_at_last():
    assert sorted(draw([100, 10], 1000, 0)) == list(sweep([100, 10]))


def test_values_are_drawn_alike_often():
    drawn = draw([4, 10**9], 4000, 1)
    counts = [sum(row[0] == at for row in drawn) for at in range(4)]
    assert max(counts) - min(counts) < 150  # 5 standard deviations


@pytest.mark.parametrize(
    ("rows", "names"),
    [
        ([["red", 8], ["blue", 8.5]], ["dog_red_8", "dog_blue_8_5"]),
        ([["4 in"], ["#ff0000"]], ["dog_4_in", "dog_ff0000"]),
        ([[True], [False]], ["dog_true", "dog_false"]),
        ([[[1, 0, 0]], [[0, 1, 0]]], ["dog_1_0_0", "dog_0_1_0"]),
        ([[1], [-1]], ["dog_1", "dog_2"]),
        ([["Red"], ["red"]], ["dog_1", "dog_2"]),
        ([["blü"], ["red"]], ["dog_1", "dog_2"]),
        ([["x" * 25], ["red"]], ["dog_1", "dog_2"]),
        ([["!"], ["red"]], ["dog_1", "dog_2"]),
    ],
)
def test_few_variations_are_called_after_their_values_where_these_tell_them_apart(rows, names):
    assert names_with_values("dog", rows) == names


def test_many_variations_are_numbered_in_the_order_of_their_names():
    names = names_with_values("dog", [[number] for number in range(FEW + 1)])
    assert names[:2] == ["dog_001", "dog_002"]
    assert names == sorted(names)


bases = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,63}", fullmatch=True)
words = st.one_of(st.text(max_size=8), st.integers(), st.booleans(), st.floats(allow_nan=False))


@given(bases, st.lists(st.lists(words, min_size=2, max_size=2), min_size=1, max_size=12))
def test_names_are_those_of_recipes_and_unlike_also_without_capitals(base, rows):
    for names in (names_with_values(base, rows), numbered_names(base, len(rows))):
        assert len(names) == len(rows)
        assert all(name(each) == each for each in names)
        assert len({each.lower() for each in names} | {base.lower()}) == len(rows) + 1


def test_a_long_name_is_cut_and_is_never_that_of_the_recipe_itself():
    base = "x" * 62 + "_1"
    assert numbered_names(base, 1) == ["x" * 61 + "_01"]
