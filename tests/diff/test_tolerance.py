"""Tolerances: how they are written, and which attribute they hold for."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.diff import Allowed, Tolerances

AMOUNTS = st.floats(min_value=0.0, max_value=1e30, allow_nan=False)


@pytest.mark.parametrize(
    ("text", "absolute", "relative"),
    [
        ("1e-4", 1e-4, 0.0),
        ("0", 0.0, 0.0),
        (".5", 0.5, 0.0),
        ("2%", 0.0, 0.02),
        (" 5 + 2 % ", 5.0, 0.02),
        ("5+0.1%", 5.0, 0.001),
    ],
)
def test_a_tolerance_is_an_amount_a_share_or_both(text: str, absolute: float, relative: float) -> None:
    allowed = Allowed.parse(text)
    assert (allowed.absolute, allowed.relative) == pytest.approx((absolute, relative))


@pytest.mark.parametrize("text", ["", "%", "-1", "nan", "inf", "1e999", "2% + 5", "5 2%", "1e-4 m", "٣"])
def test_anything_else_is_refused_with_what_was_expected(text: str) -> None:
    with pytest.raises(ValueError, match="tolerance"):
        Allowed.parse(text)


@given(absolute=AMOUNTS, relative=AMOUNTS)
def test_what_is_written_is_read(absolute: float, relative: float) -> None:
    allowed = Allowed.parse(f"{absolute!r} + {relative!r}%")
    assert allowed.absolute == absolute
    assert allowed.relative == relative / 100.0


def test_a_name_may_leave_out_the_namespace() -> None:
    tolerances = Tolerances(Allowed(1.0), {"stretch": Allowed(2.0), "primvars:pressure": Allowed(3.0)})
    assert tolerances.of("primvars:stretch") == tolerances.of("stretch") == Allowed(2.0)
    assert tolerances.of("primvars:pressure") == Allowed(3.0)
    assert tolerances.of("balloon_usd:pressure") == tolerances.of("points") == Allowed(1.0)


def test_a_name_that_no_attribute_has_is_told_with_the_nearest() -> None:
    tolerances = Tolerances(
        named={"pionts": Allowed(1.0), "stretch": Allowed(1.0), "primvars:st": Allowed(1.0)}
    )
    known = {"points", "extent", "primvars:stretch", "primvars:st"}
    assert [*tolerances.unknown_names(known)] == ['unknown attribute "pionts", did you mean "points"?']
