"""Room about a joint: what can never meet there is refused, what will be crowded is cautioned."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from balloon_usd.recipe import RecipeError

if TYPE_CHECKING:
    from balloon_usd.plan import Plan


def row(kind: str, count: int, length: float, before: str = "head: 20") -> str:
    """Many bubbles of one kind in a row, which all close at one joint."""
    made = ", ".join(f"b{k}: {length}" for k in range(count))
    return (
        "balloons: {a: {size: 260, length: 200, tail: 20}}\n"
        f"steps:\n  - bubbles: {{{before}}}\n  - {kind}: {{{made}}}\n"
    )


def bunch(balloons: int, length: float) -> str:
    """Balloons that are tied to each other between two bubbles of each."""
    names = [f"n{k}" for k in range(balloons)]
    tubes = "\n".join(f"  {name}: {{size: 260, tail: 10}}" for name in names)
    made = "\n".join(
        f"  - bubbles: {{{name}_1: {length}, {name}_2: {length}}}\n    balloon: {name}" for name in names
    )
    joints = ", ".join(f"{name}_1.end" for name in names)
    return f"balloons:\n{tubes}\nsteps:\n{made}\n  - lock: {{joints: [{joints}]}}\n"


def crowds(figure: Plan) -> list[str]:
    return [caution.what for caution in figure.cautions if "crowd about one joint" in caution.what]


@pytest.mark.parametrize(
    ("kind", "count", "length"),
    [("loop", 12, 22), ("loop", 26, 22), ("fold", 12, 20), ("loop", 7, 8), ("ear", 3, 3), ("ear", 3, 4)],
)
def test_flowers_of_many_petals_and_a_few_ears_are_everyday(planned, kind, count, length):
    assert crowds(planned(row(kind, count, length))) == []


@pytest.mark.parametrize(("kind", "count", "length"), [("ear", 4, 3), ("loop", 12, 8), ("ear", 10, 3)])
def test_a_crowd_of_short_ones_is_told_with_how_many_have_room(planned, kind, count, length):
    figure = planned(row(kind, count, length))
    (caution,) = [each for each in figure.cautions if "crowd" in each.what]
    assert caution.what == f"{count} bubbles of at most {length} cm crowd about one joint"
    assert caution.step == 1
    assert "times the gas for which there is room" in caution.why
    found = re.match(r"let at most (\d+) of them meet", caution.remedy)
    assert found is not None
    assert crowds(planned(row(kind, int(found[1]), length))) == []


@pytest.mark.parametrize(("kind", "count", "length"), [("ear", 14, 3), ("ear", 30, 2), ("loop", 27, 8)])
def test_more_than_ever_have_room_are_refused_with_how_many_have(planned, kind, count, length):
    told = rf"figure\.yaml:7:5: steps\[1\]: {count} bubbles of at most {length} cm would meet in one joint, "
    with pytest.raises(RecipeError, match=told) as refused:
        planned(row(kind, count, length))
    found = re.search(r"there is room for (\d+), expected fewer", str(refused.value))
    assert found is not None
    assert planned(row(kind, int(found[1]), length))


def test_balls_of_many_balloons_have_no_room_about_one_joint(planned):
    assert crowds(planned(bunch(3, 3))) == []
    assert crowds(planned(bunch(8, 3))) == ["16 bubbles of at most 3 cm crowd about one joint"]
    with pytest.raises(RecipeError, match=r"steps\[14\]: 28 bubbles of at most 3 cm would meet in one joint"):
        planned(bunch(14, 3))


def test_the_first_step_with_too_many_is_told(planned):
    body = (
        row("ear", 10, 3) + "  - ear: {c: 3, d: 3, e: 3}\n  - ear: {f: 3, g: 3, h: 3}\n  - bubbles: {i: 8}\n"
    )
    with pytest.raises(RecipeError, match=r":9:5: steps\[3\]: "):
        planned(body)


def test_bubbles_between_part_a_crowd(planned):
    parted = ", ".join(f"{{ear: {{e{k}: 3}}}}, {{bubbles: {{b{k}: 5}}}}" for k in range(20))
    figure = planned(f"balloons: {{a: {{size: 260, length: 100, tail: 40}}}}\nsteps: [{parted}]")
    assert crowds(figure) == []
