from __future__ import annotations

import re
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from balloon_usd.recipe.writer import flow_text
from balloon_usd.variation.values import listed, read_values


def every(text):
    values = read_values(text)
    return [values.value(at) for at in range(values.count)]


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("red,blue", ["red", "blue"]),
        ("8", [8]),
        ("8, 0.5, 1e1", [8, 0.5, 10.0]),
        ("true,false,yes", [True, False, "yes"]),
        ('"8",8', ["8", 8]),
        ("4 in, '5 in'", ["4 in", "5 in"]),
        ('"a,b",c', ["a,b", "c"]),
        ("[1,0,0],[0, 1, 0]", [[1, 0, 0], [0, 1, 0]]),
        ("{nose: 10, neck: 7},{nose: 9}", [{"nose": 10, "neck": 7}, {"nose": 9}]),
        ("#ff0000, #00FF00,red", ["#ff0000", "#00FF00", "red"]),
        ('"#ff0000",red', ["#ff0000", "red"]),
        ("../a.obj,../b.obj", ["../a.obj", "../b.obj"]),
        ("8..14/2", [8, 10, 12, 14]),
        ("10 %..30 %/10 %", ["10 %", "20 %", "30 %"]),
        ("8..14/4", [8, 12]),
        ("0..0.3/0.1", [0, 0.1, 0.2, 0.3]),
        (" -1 .. 1 / .5 ", [-1, -0.5, 0, 0.5, 1]),
        ("4 in..6 in/0.5 in", ["4 in", "4.5 in", "5 in", "5.5 in", "6 in"]),
        ("4..5 in/1", ["4 in", "5 in"]),
        ('4"..5"/1', ['4 "', '5 "']),
        ("8..8/1", [8]),
    ],
)
def test_values_are_written_as_in_recipes(text, values):
    assert every(text) == values
    assert [type(value) for value in every(text)] == [type(value) for value in values]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no value, expected some such as red,blue or a range such as 8..14/2"),
        (" ", "no value, expected some"),
        ("red,,blue", "did not find expected node content"),
        ("~,red", "no value, expected one here"),
        ("red,red", '"red" stands twice, expected each value once'),
        ("8,8.0", '"8" stands twice, expected each value once'),
        ("14..8/2", "14..8/2 goes down, expected the lower end first"),
        ("8..14/0", "8..14/0 does not advance, expected a step above 0"),
        ("8..14/-2", "8..14/-2 does not advance, expected a step above 0"),
        ("8..8", "8..8 is one value, expected two ends that differ"),
        ("8 cm..9 in/1", "8 cm..9 in/1 has the units cm and in, expected one of them"),
        ("0..1e9/1", "0..1e9/1 has 1000000001 values, expected at most 100000"),
        ("0..1e99/1e-99", "has 1.00e+198 values, expected at most 100000"),
        ("8..", '"8.." is no range, expected one alone, such as 8..14/2'),
        ("..8", '"..8" is no range'),
        ("8..14/", '"8..14/" is no range'),
        ("8...14", "8...14 goes down"),
        ("1..2..3", '"1..2..3" is no range'),
        ("5,8..14/2", '"5,8..14/2" is no range, expected one alone'),
        ("8..1e400", '"8..1e400" is no range'),
        ("red #c", 'has a # that begins a comment, expected it in "quotes"'),
        ("*a", "YAML aliases are not allowed"),
        ("&a 1", "YAML anchors are not allowed"),
        ("!!str 1", "YAML tags are not allowed"),
        ("red]", "not valid YAML"),
        ("[1,0", "not valid YAML"),
        ("a\x07", "character U+0007 is not allowed"),
        ("\udc80", "character U+DC80 is not allowed"),
    ],
)
def test_what_is_no_value_is_told_in_one_line(text, said):
    with pytest.raises(ValueError, match=re.escape(said)) as raised:
        read_values(text)
    assert str(raised.value).isprintable()


@pytest.mark.parametrize(
    ("value", "read"),
    [
        ((1, 0, 0), [1, 0, 0]),
        (np.float64(0.1), 0.1),
        (np.int64(3), 3),
        ("8..14/2", "8..14/2"),
        (8.0, 8),
        ({"a": (1, 2)}, {"a": [1, 2]}),
    ],
)
def test_values_of_python_become_those_of_a_recipe(value, read):
    assert listed([value]).values == (read,)


@pytest.mark.parametrize(
    "value",
    [None, object(), {1: 2}, float("nan"), 10**400, b"x", {3}, [None]],
    ids=lambda value: str(value)[:9],
)
def test_values_that_no_recipe_holds_are_refused(value):
    with pytest.raises(ValueError, match="is no value of a recipe"):
        listed([value])


numbers = st.decimals(-1000, 1000, places=3)


@given(numbers, numbers, st.decimals(Decimal("0.001"), 1000, places=3))
def test_a_range_with_a_step_holds_exactly_the_numbers_that_are_written(low, high, step):
    assume(low <= high)
    assume((high - low) / step < 1000)
    values = every(f"{low}..{high}/{step}")
    assert values == [float(low + at * step) for at in range(len(values))]
    assert float(high - step) < values[-1] <= float(high)


@given(numbers, numbers)
def test_a_continuous_range_has_a_thousand_short_numbers_at_least(low, high):
    assume(low < high)
    values = read_values(f"{low}..{high}")
    assert values.continuous
    assert 1000 <= values.count <= 10_000
    assert values.value(0) == float(low)
    last = Decimal(flow_text(values.value(values.count - 1)))
    assert high - (high - low) / 1000 <= last <= high
    assert len(flow_text(values.value(values.count // 3))) <= 12


def test_a_continuous_range_says_which_step_it_could_have():
    assert read_values("8..14").with_step == "8..14/1"
    assert read_values("0.1 in..0.3 in").with_step == "0.1 in..0.3 in/0.1 in"
