"""What is printed as a remedy, taken literally, makes the recipe work."""

from __future__ import annotations

import re

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError


def text_of(size: str, filling: str, lengths: list[float]) -> str:
    bubbles = ", ".join(f"b{k}: {length:.2f}" for k, length in enumerate(lengths))
    balloon = f"balloons: {{main: {{size: {size}, color: red, {filling}}}}}"
    return f"format: 1\nname: chain\nunits: cm\n{balloon}\nsteps:\n  - bubbles: {{{bubbles}}}\n"


def remedied(told: str, size: str, filling: str, lengths: list[float]) -> str:
    """The recipe as the message says."""
    if found := re.search(r"expected a tail of at most ([\d.]+) cm", told):
        return text_of(size, f"tail: {found[1]}", lengths)
    if found := re.search(r"expected inflated: at least ([\d.]+) cm", told):
        return text_of(size, f"inflated: {found[1]}", lengths)
    found = re.search(r"bubbles shorter by ([\d.]+) cm in all", told)
    assert found is not None, told
    share = 1.0 - float(found[1]) / sum(lengths)
    return text_of(size, filling, [share * length for length in lengths])


@pytest.mark.parametrize(
    ("size", "filling", "lengths"),
    [
        ("260", "tail: 17", 11 * [10.0]),
        ("260", "tail: 25", 6 * [10.0]),
        ("260", "tail: 1", 14 * [10.0]),
        ("260", "tail: 1", 20 * [10.0]),
        ("260", "inflated: 70", 4 * [22.0]),
        ("260", "inflated: 120", 13 * [10.0]),
        ("260", "inflated: 120", 20 * [10.0]),
        ("160", "tail: 5", [30.0, 3.0, 90.0, 40.0]),
        ("350", "inflated: 70", 40 * [3.0]),
    ],
)
def test_bubbles_that_do_not_fit_do_so_as_is_told(size: str, filling: str, lengths: list[float]) -> None:
    with pytest.raises(RecipeError, match="does not fit") as error:
        plan(Recipe.parse(text_of(size, filling, lengths)))
    assert plan(Recipe.parse(remedied(str(error.value), size, filling, lengths))).bubbles


def test_a_balloon_told_by_its_inflated_length_is_answered_so() -> None:
    with pytest.raises(RecipeError, match=r"expected inflated: at least [\d.]+ cm$"):
        plan(Recipe.parse(text_of("260", "inflated: 120", 13 * [10.0])))
