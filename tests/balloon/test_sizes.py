"""Balloon sizes."""

from __future__ import annotations

import math

import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import SIZES, size_named
from balloon_usd.balloon.tube_theory import maxwell_state

INCH = 0.0254
TUBES = [size for size in SIZES if size.neck is None]
ROUNDS = [size for size in SIZES if size.neck is not None]
WIDER = {False: 5.0, True: 4.1}
"""How many times as wide as flat a full round balloon is, or a heart."""


@pytest.mark.parametrize("size", TUBES, ids=lambda size: size.name)
def test_every_size_inflates_to_the_inches_of_its_name(size):
    bulged = maxwell_state(rubber_named("ogden")).bulged
    assert 2.0 * bulged.a * size.radius / INCH == pytest.approx(int(size.name[0]), rel=0.01)
    assert bulged.b * size.length / INCH == pytest.approx(int(size.name[1:]), rel=0.01)


def test_a_260_weighs_about_two_grams():
    rubber = rubber_named("ogden")
    assert size_named("260").rubber_volume * rubber.density == pytest.approx(1.74e-3, rel=0.01)


@pytest.mark.parametrize("size", ROUNDS, ids=lambda size: size.name)
def test_a_full_round_balloon_or_heart_is_as_wide_as_its_name_says(size):
    assert WIDER[size.heart] * 2.0 * size.radius / INCH == pytest.approx(int(size.name[1:]), rel=0.03)


def test_round_balloons_weigh_what_real_ones_do():
    rubber = rubber_named("ogden")
    assert size_named("R5").rubber_volume * rubber.density == pytest.approx(0.55e-3, abs=0.05e-3)
    assert size_named("R11").rubber_volume * rubber.density == pytest.approx(2.7e-3, rel=0.03)


def test_a_round_balloon_of_another_radius_has_the_same_shape():
    size, wider = size_named("R5"), size_named("R5").with_overrides(radius=26.0e-3)
    assert (wider.length, wider.neck) == pytest.approx((2.0 * size.length, 2.0 * size.neck))
    assert wider.thickness == size.thickness


@pytest.mark.parametrize("code", ["H6", "H11"])
def test_a_heart_is_as_long_as_its_wall_is_in_the_mean(code):
    size = size_named(code)
    assert size.length == pytest.approx(size.heart_wall.length, rel=1e-6)


def test_a_heart_of_another_radius_is_a_heart_of_the_same_shape():
    size, wider = size_named("H6"), size_named("H6").with_overrides(radius=37.2e-3)
    assert wider.heart
    assert (wider.length, wider.neck) == pytest.approx((2.0 * size.length, 2.0 * size.neck))
    assert wider.rubber_volume == pytest.approx(4.0 * size.rubber_volume)


def test_a_260_lies_14_millimetres_wide_when_flat():
    assert size_named("260").flat_width == pytest.approx(14.1e-3, rel=0.01)


def test_an_unknown_size_is_refused_with_the_choices():
    with pytest.raises(ValueError, match=r"'270'.*260"):
        size_named("270")


def test_overrides_replace_only_what_is_given():
    size = size_named("260").with_overrides(length=0.282)
    assert (size.name, size.radius, size.length, size.thickness) == ("260", 4.5e-3, 0.282, 0.18e-3)


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.inf, math.nan])
def test_an_impossible_dimension_is_refused(wrong):
    with pytest.raises(ValueError, match="thickness must be positive"):
        size_named("260").with_overrides(thickness=wrong)
