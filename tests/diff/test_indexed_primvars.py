"""Primvars are compared by what each element gets: whether by indices or not does not count."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.diff import differences

Colors = list[tuple[float, float, float]]
BLACK, GREY, WHITE = (0.0, 0.0, 0.0), (0.5, 0.5, 0.5), (1.0, 1.0, 1.0)


def painted(colors: Colors, indices: dict[float | None, list[int]] | None = None, size: int = 1) -> Usd.Stage:
    """Three corners of a triangle, painted plainly or by indices at time codes (None: by default)."""
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/sail")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    color = mesh.CreateDisplayColorPrimvar("vertex", size)
    color.Set(colors)
    for time, chosen in (indices or {}).items():
        color.CreateIndicesAttr().Set(chosen, Usd.TimeCode.Default() if time is None else time)
    return stage


def told(one: Usd.Stage, other: Usd.Stage, tolerance: float = 0.0) -> list[str]:
    """What differs, the same from either side."""
    found = [*differences(one, other, tolerance=tolerance)]
    assert len([*differences(other, one, tolerance=tolerance)]) == len(found)
    return [text.removeprefix("/sail.primvars:displayColor: ") for text in found]


def test_colours_by_indices_are_the_same_as_plain_ones() -> None:
    plain, indexed = painted([BLACK, WHITE, BLACK]), painted([WHITE, BLACK], {None: [1, 0, 1]})
    assert told(plain, indexed) == []
    assert told(painted([GREY, BLACK, WHITE], {None: [1, 2, 1]}), indexed) == []


def test_several_numbers_may_make_an_element() -> None:
    plain = painted([BLACK, WHITE, GREY, GREY, BLACK, WHITE], size=2)
    assert told(plain, painted([GREY, GREY, BLACK, WHITE], {None: [1, 0, 1]}, size=2)) == []


def test_another_index_is_another_colour_within_its_tolerance() -> None:
    ramp: Colors = [BLACK, GREY, WHITE]
    one, other = (
        painted(ramp, {None: [0, 1, 2], 1: [0, 1, 2], 2: chosen}) for chosen in ([0, 1, 2], [1, 1, 2])
    )
    assert told(one, other) == ["differ by up to 0.5 at 2; at 1 of 2 time codes"]
    assert told(one, other, tolerance=0.6) == []


def test_times_of_the_indices_are_times_of_the_colours() -> None:
    one, other = (
        painted([BLACK, WHITE], {None: [0, 1, 0], 1: [0, 1, 0], code: [1, 1, 1]}) for code in (2, 3)
    )
    (times,) = told(one, other)
    assert times == "times of the samples differ: 2 and 2 samples, 2 only in the first stage"


@pytest.mark.parametrize("lost", [[0, 1, 9], [0, -1, 0]])
def test_indices_that_lead_nowhere_are_a_difference_even_from_others_that_do(lost: list[int]) -> None:
    ramp: Colors = [BLACK, WHITE]
    assert told(painted(ramp, {None: [0, 1, 0]}), painted(ramp, {None: lost})) == [
        "no value in the second stage"
    ]
    assert told(painted(ramp, {None: lost}), painted(ramp, {None: lost})) == []
    assert told(painted(ramp, {None: [7, 7, 7]}), painted(ramp, {None: lost})) == ["3 of 3 values differ"]


def test_indices_without_values_are_compared_as_any_attribute(tmp_path: Path) -> None:
    stages = []
    for name, indices in (("one", "1, 1"), ("other", "1, 2")):
        file = tmp_path / f"{name}.usda"
        file.write_text(f'#usda 1.0\ndef Scope "a" {{\n int[] primvars:x:indices = [{indices}]\n}}\n')
        stages.append(Usd.Stage.Open(str(file)))
    assert [*differences(*stages)] == ["/a.primvars:x:indices: 1 of 2 values differ"]
