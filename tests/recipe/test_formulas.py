"""Formulas: arithmetic on numbers, quantities and named values."""

from __future__ import annotations

import pytest

from balloon_usd.language.formula import LONGEST_FORMULA, filled, value_of
from balloon_usd.language.quantities import metres

NAMES = {
    "ear": 3,
    "long": "4 in",
    "skin": "red",
    "half": 0.5,
    "soft": "20 %",
    "yes": True,
    "far": float("inf"),
}


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("= 3", 3),
        ("=3.0", 3),
        ("= 1 / 3 * 3", 1),
        ("= 1 / 3", 0.333333333333),
        ("= 2 + 3 * 4 - 6 / 2", 11),
        ("= (2 + 3) * 4", 20),
        ("= --2", 2),
        ("= -ear + 5", 2),
        ("= 1e2", 100),
        ("= 0.1 + 0.2", 0.3),
        ("= ear", 3),
        ("= half * ear", 1.5),
        ("= skin", "red"),
        ("= yes", True),
        ("= long", "4 in"),
        ("= long / 2", "2 in"),
        ("= 2 * long", "8 in"),
        ('= 4" / 2', '2 "'),
        ("= long / 2 in", 2),
        ("= 2 hands + 2 fingers", "2.5 hands"),
        ("= 1 m - 90 cm", "0.1 m"),
        ("= soft + 10", "30 %"),
        ("= 60 deg / 2", "30 deg"),
        ("= 2 min + 30", "2.5 min"),
        ("= 500 mN + 1", "1500 mN"),
    ],
)
def test_a_formula_gives_what_an_artist_reckons(formula, value):
    found = value_of(formula, NAMES, "cm")
    assert found == value
    assert type(found) is type(value)


def test_a_bare_length_in_a_sum_is_in_the_units_of_the_recipe():
    assert metres(value_of("= ear + 1 in", NAMES, "cm"), "cm") == pytest.approx(0.0554)
    assert metres(value_of("= ear + 1 in", NAMES, "mm"), "mm") == pytest.approx(0.0284)
    with pytest.raises(ValueError, match="3 has no unit in a sum of lengths"):
        value_of("= ear + 1 in", NAMES, None)


@pytest.mark.parametrize(
    ("formula", "text"),
    [
        ("=", "it ends too early, expected a number, a name or \\("),
        ("= 3 +", "it ends too early"),
        ("= (3", "it ends too early, expected \\)"),
        ("= 3)", '"\\)" does not fit there, expected the end of the formula'),
        ("= 3 4", '"4" does not fit there'),
        ("= 3 $ 4", "expected numbers, names, \\+ - \\* / and \\( \\)"),
        ("= eer", 'unknown name "eer", did you mean "ear"\\?'),
        ("= 2 ear", "expected 2 \\* ear"),
        ("= 2 yd", 'unknown unit "yd"'),
        ("= ear / 0", "3 is divided by 0"),
        ("= ear / (2 in - 2 in)", "3 is divided by 0 in"),
        ("= skin * 2", 'the text "red" stands in arithmetic'),
        ("= 2 + yes", "true or false stands in arithmetic"),
        ("= -skin", 'the text "red" stands in arithmetic'),
        ("= long * long", "4 in cannot be multiplied by 4 in"),
        ("= 2 in / 3 %", "2 in cannot be divided by 3 %"),
        ("= 2 in + 3 %", "2 in and 3 % cannot be added"),
        ("= 1e9 * 1e9", "1e\\+18 is too large"),
        ("= 1e999", "is too large"),
        ("= far", "far is inf, expected a finite number"),
        ("= " + "(" * 40 + "1" + ")" * 40, "nested deeper than 16"),
        ("= " + "-" * 40 + "1", "nested deeper than 16"),
        ("= " + "1+" * LONGEST_FORMULA + "1", "a formula of 402 characters"),
    ],
)
def test_a_formula_that_makes_no_sense_is_refused_with_what_was_expected(formula, text):
    with pytest.raises(ValueError, match=text):
        value_of(formula, NAMES, "cm")


def test_names_are_filled_with_whole_numbers_and_texts():
    assert filled("<skin>_ear_<ear + 1>", NAMES, None) == "red_ear_4"
    assert filled("ear", NAMES, None) == "ear"
    with pytest.raises(ValueError, match=r"<half> is 0\.5, expected a whole number or a text in a name"):
        filled("a_<half>", NAMES, None)
