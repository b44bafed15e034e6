"""Who can blow up a balloon, and what hands that stretch its start before save."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.plan import plan_json, plan_text
from balloon_usd.plan.lungs import blown_by, opening_pressure

SIZES = ["646", "350", "260", "160"]
"""By mouth easiest first (balloonhq.com: a column of M. Floyd)."""


def test_a_260_gives_way_at_twelve_and_a_half_kilopascals():
    assert opening_pressure(size_named("260"), rubber_named(), stretched=False) == pytest.approx(
        12.52e3, rel=1e-3
    )


@pytest.mark.parametrize("name", ["ogden", "ogden-treloar", "gent"])
def test_a_stretched_start_saves_lungs_more_than_a_third_in_every_rubber(name):
    size, rubber = size_named("260"), rubber_named(name)
    fresh, stretched = (opening_pressure(size, rubber, stretched=each) for each in (False, True))
    assert stretched < 0.65 * fresh


def test_rubber_that_does_not_soften_gains_nothing_by_stretching():
    size, rubber = size_named("260"), rubber_named().without_softening()
    fresh, stretched = (opening_pressure(size, rubber, stretched=each) for each in (False, True))
    assert stretched == fresh


def test_sizes_are_as_hard_to_blow_up_as_makers_say():
    pressures = [opening_pressure(size_named(name), rubber_named(), stretched=False) for name in SIZES]
    assert pressures == sorted(pressures)
    assert [blown_by(each) for each in pressures] == ["most lungs", "strong lungs", "strong lungs", "a pump"]


def test_the_plan_tells_what_it_takes_to_begin(dog):
    told = "begins to grow at 12.5 kPa (strong lungs), and at 7.1 kPa (most lungs) where hands stretched"
    assert told in plan_text(dog)
    budget = plan_json(dog)["balloons"][0]["budget"]
    assert budget["opening_pressure"] == pytest.approx(12.52e3, rel=1e-3)
    assert budget["opening_pressure_stretched"] == pytest.approx(budget["pressure"])


def test_nothing_is_said_of_stretching_where_rubber_does_not_soften(planned):
    text = plan_text(
        planned("physics: {softening: false}\nballoons: {a: {size: 260, tail: 9}}\nsteps: [{rest: b}]")
    )
    assert "begins to grow at 12.5 kPa (strong lungs)\n" in text


def test_capsules_of_the_thesis_do_not_begin_to_grow(planned):
    text = plan_text(
        planned(
            "physics: {model: kosaka}\nballoons: {a: {size: 260, capsule: 60}}\nsteps: [{bubbles: {b: 20}}]"
        )
    )
    assert "begins to grow" not in text
