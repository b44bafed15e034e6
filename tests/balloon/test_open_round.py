"""Twisting lobes off a round balloon."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.open_round import OpenRound
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named

NECK = 3.3e-3


def whole(size="R5", rubber="ogden", volume=560e-6, most=None):
    return OpenRound.whole(size_named(size), rubber_named(rubber), NECK, volume, most or volume)


def amount(lobe):
    return (ATMOSPHERE + lobe.pressure) * lobe.volume


@pytest.mark.parametrize("height", [0.035, 0.05, 0.066, 0.08, 0.1])
def test_a_lobe_is_as_high_as_asked_and_both_walls_are_stretched_alike(height):
    before = whole()
    lobe, left = before.twisted(height)
    assert lobe.height == pytest.approx(height, rel=1e-3)
    densities = [each.energy / each.rubber.sum() for each in (lobe, left.lobe)]
    assert densities[0] == pytest.approx(densities[1], rel=1e-3)


def test_no_gas_is_lost_and_both_are_harder_than_the_whole_was():
    before = whole()
    lobe, left = before.twisted(0.066)
    assert amount(lobe) + amount(left.lobe) == pytest.approx(amount(before.lobe), rel=1e-3)
    assert min(lobe.pressure, left.lobe.pressure) > before.lobe.pressure


@pytest.mark.parametrize("rubber", ["ogden", "ogden-treloar", "gent"])
@pytest.mark.parametrize(("size", "volume"), [("R5", 250e-6), ("R5", 900e-6), ("R11", 2e-3), ("R11", 7e-3)])
def test_walls_of_any_length_are_twisted_off(size, volume, rubber):
    before = whole(size, rubber, volume)
    least, most = before.lengths
    heights = [
        before.parted(least + share * (most - least))[0].height for share in (0.0, 0.25, 0.5, 0.75, 1.0)
    ]
    assert heights == sorted(heights)


def test_a_third_one_is_made_of_what_two_leave():
    first, left = whole("R11", volume=3.1e-3).twisted(0.08)
    second, rest = left.twisted(0.11)
    assert 0.0 < left.start < rest.start < rest.size.length
    assert second.height == pytest.approx(0.11, rel=1e-3)
    assert first.volume + second.volume + rest.lobe.volume < 3.1e-3


@pytest.mark.parametrize("height", [0.005, 0.3])
def test_what_is_too_low_or_too_high_is_not_found(height):
    with pytest.raises(ValueError, match="cm high is found"):
        whole().twisted(height)
