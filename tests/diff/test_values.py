"""Two values: NaN is NaN, floats have a tolerance, all else must be the same."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pxr import Gf, Sdf, Vt

from balloon_usd.diff.tolerance import Allowed
from balloon_usd.diff.values import alike, gap_between, same_bits

EXACTLY = Allowed()
FLOATS = st.floats(width=32, allow_nan=True, allow_infinity=True)
ROWS = arrays(np.float32, 5, elements=FLOATS)


@given(values=ROWS)
def test_a_value_is_the_same_as_itself(values: np.ndarray) -> None:
    assert same_bits(values, values.copy())
    assert gap_between(values, values.copy(), EXACTLY) is None


@given(one=ROWS, other=ROWS, absolute=st.floats(0, 10), relative=st.floats(0, 0.5))
def test_which_comes_first_changes_no_verdict(
    one: np.ndarray, other: np.ndarray, absolute: float, relative: float
) -> None:
    allowed = Allowed(absolute, relative)
    there, back = gap_between(one, other, allowed), gap_between(other, one, allowed)
    assert (there is None) == (back is None)
    if there and back:
        assert there.by == back.by


@given(one=st.floats(-1e6, 1e6), by=st.floats(0, 1e3), allowed=st.floats(0, 1e3))
def test_an_absolute_tolerance_is_a_distance(one: float, by: float, allowed: float) -> None:
    assert (gap_between(one, one + by, Allowed(allowed)) is None) == (abs(one + by - one) <= allowed)


@pytest.mark.parametrize(
    ("one", "other", "text"),
    [
        (1.0, 1.5, "1 and 1.5"),
        ([1.0, math.nan], [1.0, math.nan], None),
        ([1.0, math.nan], [1.0, 2.0], "1 and 0 values are NaN"),
        ([math.inf, 1.0], [math.inf, 1.0], None),
        ([math.inf, 1.0], [-math.inf, 1.0], "differ by up to inf"),
        ([-0.0, 1.0], [0.0, 1.0], None),
        ([1.0, 2.0, 4.0], [1.0, 2.5, 4.25], "differ by up to 0.5"),
        ([1.0, 2.0], [1.0, 2.0, 3.0], "2 and 3 values"),
    ],
)
def test_floats_are_compared_by_number(one: object, other: object, text: str | None) -> None:
    if isinstance(one, list):
        one, other = np.array(one), np.array(other)
    gap = gap_between(one, other, EXACTLY)
    assert (gap.text if gap else None) == text


def test_infinity_is_near_no_number_whatever_is_allowed() -> None:
    assert gap_between(np.array([math.inf, 0]), np.array([1e30, 0]), Allowed(1e30, 10.0)) is not None


def test_half_floats_do_not_overflow() -> None:
    one, other = (Vt.HalfArray([x, 0.0]) for x in (60000.0, -60000.0))
    gap = gap_between(one, other, EXACTLY)
    assert gap is not None
    assert gap.by == 120_000.0


@pytest.mark.parametrize(
    ("one", "other", "text"),
    [
        (Vt.IntArray([1, 2, 3]), Vt.IntArray([1, 5, 4]), "2 of 3 values differ"),
        (Vt.TokenArray(["a", "b"]), Vt.TokenArray(["a", "c"]), "values differ"),
        (Gf.Quatf(1, 0, 0, 0), Gf.Quatf(1, 0, 0, 0.5), "differ by up to 0.5"),
        (Gf.Matrix4d(1.0), Gf.Matrix4d(2.0), "differ by up to 1"),
        (True, False, "values differ"),
        ("left", "right", "values differ"),
        (None, 1.0, "no value in the first stage"),
        ("left", None, "no value in the second stage"),
        (Sdf.AssetPath("./a.png"), Sdf.AssetPath("./b.png"), "values differ"),
    ],
)
def test_everything_else_must_be_the_same(one: object, other: object, text: str) -> None:
    gap = gap_between(one, other, Allowed(0.25, 0.25))
    assert gap is not None
    assert gap.text == text
    assert gap_between(one, one, EXACTLY) is None


def test_a_file_is_the_same_wherever_it_lies() -> None:
    assert alike(Sdf.AssetPath("./a.png", "/one/a.png"), Sdf.AssetPath("./a.png", "/other/a.png"))
    assert alike([Sdf.AssetPath("./a.png", "/one/a.png")], [Sdf.AssetPath("./a.png", "/other/a.png")])


def test_metadata_may_be_nested() -> None:
    assert alike({"a": {"b": [1.0, math.nan]}}, {"a": {"b": [1.0, math.nan]}})
    assert not alike({"a": {"b": 1}}, {"a": {"b": 2}})
    assert not alike({"a": 1}, {"b": 1})
    assert not alike([1], [1, 2])
    assert not alike(1, True)
