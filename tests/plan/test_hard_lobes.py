"""Parts of a twisted round balloon that will be hard are told before anybody twists them."""

from __future__ import annotations

import re

import pytest

ROUND = (
    "balloons: {{one: {{size: {size}, inflated: {width}}}}}\nsteps: [{{bubbles: {{{lengths}}}}}, {{rest: z}}]"
)


def told(planned, size, width, lengths):
    """Cautions of hard parts of a round balloon of a width, cm, twisted into lengths and what is left."""
    found = planned(ROUND.format(size=size, width=width, lengths=lengths)).cautions
    return [caution for caution in found if "hard little ball" in caution.what]


def test_a_small_part_of_a_small_balloon_is_told_with_its_pressure(planned):
    (caution,) = told(planned, "R5", 6, "a: 2")
    assert caution.what == "a (2 cm) will be a hard little ball"
    assert caution.why == "so small a part of an R5 needs 13.3 kPa, where the balloon has 4.3"
    assert caution.step == 0


def test_a_part_as_long_as_the_remedy_is_not_hard_and_a_shorter_one_is(planned):
    (caution,) = told(planned, "R5", 6, "a: 2")
    least = float(re.fullmatch(r"make it ([\d.]+) cm or longer", caution.remedy)[1])
    assert not told(planned, "R5", 6, f"a: {least}")
    assert told(planned, "R5", 6, f"a: {least - 0.15}")


def test_the_remedy_of_a_later_part_counts_what_is_before_it(planned):
    first, second = told(planned, "R5", 5, "a: 1.8, b: 2.7")
    assert (first.what[0], second.what[0]) == ("a", "b")
    least = float(re.search(r"[\d.]+", second.remedy)[0])
    assert [each.what[0] for each in told(planned, "R5", 5, f"a: 1.8, b: {least}")] == ["a"]


def test_where_what_is_left_is_hard_the_bubble_before_it_is_to_be_shorter(planned):
    (caution,) = told(planned, "R5", 5, "a: 4.6")
    assert caution.what.startswith("z (2.4 cm)")
    assert caution.remedy == "make a shorter"


def test_where_all_parts_are_hard_there_are_too_many(planned):
    *_, last = told(planned, "R5", 4.5, "a: 2.2, b: 2.7")
    assert last.what[0] == "z"
    assert last.remedy == "twist fewer bubbles off"


@pytest.mark.parametrize(("size", "width", "length"), [("R5", 6, 3), ("R5", 10, 5), ("R11", 24, 12)])
def test_parts_of_usual_size_are_not_told(planned, size, width, length):
    assert told(planned, size, width, f"a: {length}") == []
