"""Shapes of what twists make of a round balloon."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.lobe_shape import PIECES, blown_up, flat_wall
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named

R5, RUBBER, NECK = size_named("R5"), rubber_named(), 3e-3
HALF = 0.5 * R5.length
WALLS = {
    "whole": flat_wall(R5, 0.0, R5.length, (NECK, 0.0)),
    "between two necks": flat_wall(R5, 0.0, HALF, (NECK, NECK)),
    "with the tip": flat_wall(R5, HALF, R5.length, (NECK, 0.0)),
}


@pytest.mark.parametrize("wall", WALLS.values(), ids=list(WALLS))
@pytest.mark.parametrize("volume", [50e-6, 200e-6, 500e-6])
def test_what_the_gas_does_is_what_the_wall_stores(wall, volume):
    less, more = (blown_up(wall, RUBBER, share * volume) for share in (0.999, 1.001))
    now = blown_up(wall, RUBBER, volume)
    assert (more.energy - less.energy) / (more.volume - less.volume) == pytest.approx(now.pressure, rel=1e-4)


def test_it_begins_from_a_shape_that_is_like_it_and_finds_the_same():
    wall = WALLS["whole"]
    first = blown_up(wall, RUBBER, 300e-6)
    again = blown_up(wall, RUBBER, 300e-6, like=blown_up(wall, RUBBER, 270e-6))
    assert again.width == pytest.approx(first.width, rel=1e-5)
    assert again.pressure == pytest.approx(first.pressure, rel=1e-5)


def test_round_a_neck_its_wall_lies_in_folds_and_pulls_straight_along():
    lobe = blown_up(WALLS["between two necks"], RUBBER, 200e-6)
    assert lobe.radius[0] == lobe.radius[-1] == NECK
    assert lobe.width > lobe.height
    assert len(lobe.x) == PIECES + 1


def test_both_parts_hold_their_rubber():
    whole, first, last = (wall.rubber.sum() for wall in WALLS.values())
    assert first + last == pytest.approx(whole, rel=1e-3)


def test_no_gas_makes_no_shape():
    with pytest.raises(ValueError, match="no lobe of 0 mL is found"):
        blown_up(WALLS["whole"], RUBBER, 0.0)
