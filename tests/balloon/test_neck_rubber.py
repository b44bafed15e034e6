"""Rubber hidden in a neck that is not closed to a point."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.bubble_shape import bubble_of_length, neck_rubber
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named

SIZE, LATEX = size_named("260"), rubber_named()


@pytest.mark.parametrize(("length", "stretch"), [(0.030, 4.58), (0.050, 5.18), (0.090, 5.24)])
def test_a_neck_hides_its_radius_over_the_meridional_stretch_beside_it(length, stretch):
    rest = bubble_of_length(SIZE, LATEX, length).rest_length
    assert neck_rubber(SIZE, LATEX, rest, 2.0e-3) == pytest.approx(2.0e-3 / stretch, rel=2e-3)


def test_a_neck_closed_to_a_point_hides_nothing():
    assert neck_rubber(SIZE, LATEX, 0.0166, 0.0) == 0.0
