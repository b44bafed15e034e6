"""Theory of inflated tubes and spheres against closed forms and tabulated numbers."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import Rubber, rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import (
    bulged_state,
    closed_tube_axial_stretch,
    closed_tube_pressure,
    closed_tube_state,
    fixed_length_tube_pressure,
    gauge_pressure,
    inflated_rubber,
    maxwell_state,
    pressure_maximum,
    pressure_minimum,
    sphere_limits,
    sphere_pressure,
    thin_state,
)

NEO_HOOKE = Rubber("neo-hooke of unit modulus", mu=(1.0,), alpha=(2.0,))


def mooney_rivlin(ratio: float) -> Rubber:
    """Unit shear modulus, C2 / C1 = ratio."""
    c1 = 0.5 / (1.0 + ratio)
    return Rubber("mooney-rivlin", mu=(2.0 * c1, -2.0 * c1 * ratio), alpha=(2.0, -2.0))


def gent(limit: float) -> Rubber:
    return Rubber("gent of unit modulus", gent_mu=1.0, gent_limit=limit)


def test_neo_hooke_sphere_bulges_at_the_sixth_root_of_seven():
    maximum, minimum = sphere_limits(NEO_HOOKE)
    assert minimum is None
    assert maximum.stretch == pytest.approx(7.0 ** (1.0 / 6.0), rel=1e-6)
    assert maximum.p_star == pytest.approx(1.23946, rel=1e-5)


def test_mooney_rivlin_sphere_follows_its_closed_form():
    stretch = np.linspace(1.01, 5.0, 50)
    closed_form = 4.0 * (stretch**-1 - stretch**-7) * (0.5 / 1.1) * (1.0 + 0.1 * stretch**2)
    assert sphere_pressure(mooney_rivlin(0.1), stretch) == pytest.approx(closed_form, rel=1e-12)


def test_mooney_rivlin_sphere_has_its_published_limits():
    maximum, minimum = sphere_limits(mooney_rivlin(0.1))
    assert (maximum.stretch, maximum.p_star) == pytest.approx((1.4762, 1.3551), rel=1e-4)
    assert (minimum.stretch, minimum.p_star) == pytest.approx((3.1427, 1.1487), rel=1e-4)


def test_mooney_rivlin_sphere_loses_its_limits_at_the_critical_ratio():
    assert sphere_limits(mooney_rivlin(0.2135))[1] is not None
    assert sphere_limits(mooney_rivlin(0.2155)) == (None, None)


def test_gent_spheres_have_limits_only_when_they_stiffen_late():
    maximum, minimum = sphere_limits(gent(97.2))
    assert (maximum.stretch, minimum.stretch) == pytest.approx((1.398, 4.085), abs=5e-4)
    assert sphere_limits(gent(15.0)) == (None, None)


@pytest.mark.parametrize(("a", "p_star"), [(1.1, 0.3170), (1.5, 0.8025), (2.0, 0.9375)])
def test_neo_hooke_tube_of_fixed_length_follows_its_closed_form(a, p_star):
    assert fixed_length_tube_pressure(NEO_HOOKE, a) == pytest.approx(p_star, abs=5e-5)
    assert fixed_length_tube_pressure(NEO_HOOKE, a) == pytest.approx(1.0 - a**-4, rel=1e-12)


def test_neo_hooke_tube_bulges_but_has_no_bulged_phase():
    onset = pressure_maximum(NEO_HOOKE)
    assert (onset.p_star, onset.a, onset.b) == pytest.approx((0.74987, 1.577, 1.178), rel=5e-4)
    with pytest.raises(ValueError, match="no bulged phase"):
        maxwell_state(NEO_HOOKE)


def test_party_balloon_mooney_rivlin_tube_has_no_bulged_phase():
    rubber = rubber_named("mooney-rivlin")
    assert closed_tube_pressure(rubber, 12.0) < closed_tube_pressure(rubber, 11.0)
    with pytest.raises(ValueError, match="no bulged phase"):
        pressure_minimum(rubber)


@pytest.mark.parametrize("name", ["ogden", "gent", "mooney-rivlin", "neo-hooke"])
def test_closed_tube_balances_hoop_and_axial_force(name):
    rubber = rubber_named(name)
    a = np.array([1.001, 1.3, 2.0, 4.0, 6.0])
    b = closed_tube_axial_stretch(rubber, a)
    hoop, axial = rubber.nominal_stress(a, b)
    assert hoop / (a * b) == pytest.approx(axial * 2.0 / a**2, rel=1e-7)


@pytest.mark.parametrize(
    ("rubber", "onset", "least", "p_star", "thin", "bulged", "volume_ratio", "pressure_ratio"),
    [
        (rubber_named("ogden"), (312.995e3, 1.607, 1.118), (162.23e3, 4.43),
         178.363e3, (1.1482, 1.0086), (5.6642, 4.1465), 133.0, 0.570),
        (rubber_named("ogden-treloar"), (317.13e3, 1.603, 1.113), (143.46e3, 5.04),
         158.58e3, (1.1230, 1.0059), (6.592, 4.511), 196.0, 0.500),
        (gent(97.2), (0.7593, 1.597, 1.189), (0.4360, 4.72),
         0.4760, (1.1694, 1.0181), (5.795, 4.098), 137.6, 0.627),
        (gent(80.0), (0.7614, 1.6016, 1.1916), (0.4759, 4.29),
         0.5162, (1.1923, 1.0231), (5.239, 3.705), 101.7, 0.678),
        (gent(50.0), (0.7690, 1.6196, 1.2015), (0.5824, 3.42),
         0.6188, (1.266, 1.043), (4.086, 2.890), 48.2, 0.805),
    ],
    ids=["ogden", "ogden-treloar", "gent 97.2", "gent 80", "gent 50"],
)  # fmt: skip
def test_two_phases_of_a_tube_match_the_tabulated_numbers(
    rubber, onset, least, p_star, thin, bulged, volume_ratio, pressure_ratio
):
    maximum, minimum, maxwell = pressure_maximum(rubber), pressure_minimum(rubber), maxwell_state(rubber)
    assert maximum.p_star == pytest.approx(onset[0], rel=2e-4)
    assert (maximum.a, maximum.b) == pytest.approx(onset[1:], abs=1e-3)
    assert minimum.p_star == pytest.approx(least[0], rel=2e-4)
    assert minimum.a == pytest.approx(least[1], rel=2e-3)
    assert maxwell.p_star == pytest.approx(p_star, rel=2e-4)
    assert (maxwell.thin.a, maxwell.thin.b) == pytest.approx(thin, rel=3e-4)
    assert (maxwell.bulged.a, maxwell.bulged.b) == pytest.approx(bulged, rel=3e-4)
    assert maxwell.bulged.volume_ratio == pytest.approx(volume_ratio, rel=1e-3)
    assert maxwell.p_star / maximum.p_star == pytest.approx(pressure_ratio, abs=6e-4)


def test_the_maxwell_pressure_cuts_equal_areas_off_the_pressure_curve():
    rubber = rubber_named("ogden")
    state = maxwell_state(rubber)
    a = np.linspace(state.thin.a, state.bulged.a, 4001)
    p_star, volume = closed_tube_pressure(rubber, a), a**2 * closed_tube_axial_stretch(rubber, a)
    work = np.sum(0.5 * (p_star[1:] + p_star[:-1]) * np.diff(volume))
    assert work == pytest.approx(state.p_star * (volume[-1] - volume[0]), rel=1e-6)


def test_a_260_bulges_at_7_kilopascals():
    size, rubber = size_named("260"), rubber_named("ogden")
    assert gauge_pressure(size, maxwell_state(rubber).p_star) == pytest.approx(7134.5, rel=1e-4)
    assert gauge_pressure(size, pressure_maximum(rubber).p_star) == pytest.approx(12.5e3, rel=3e-3)


def test_softened_rubber_deflates_at_about_half_the_pressure():
    rubber = rubber_named("ogden")
    deflating = maxwell_state(inflated_rubber(rubber)).p_star
    assert deflating / maxwell_state(rubber).p_star == pytest.approx(0.533, abs=1e-3)
    assert gauge_pressure(size_named("260"), deflating) == pytest.approx(3.80e3, rel=2e-3)


@pytest.mark.parametrize(
    ("a", "kilopascals", "volume"),
    [(5.66, 7.13, 1.00), (6.0, 7.48, 1.21), (6.5, 8.10, 1.57), (7.0, 8.82, 1.99)],
)
def test_a_260_without_tail_climbs_slowly(a, kilopascals, volume):
    size, rubber = size_named("260"), rubber_named("ogden")
    state = closed_tube_state(rubber, a)
    assert gauge_pressure(size, state.p_star) / 1e3 == pytest.approx(kilopascals, abs=6e-3)
    ratio = state.volume_ratio / maxwell_state(rubber).bulged.volume_ratio
    assert ratio == pytest.approx(volume, abs=8e-3)


def test_branches_return_the_states_they_were_asked_for():
    rubber = rubber_named("ogden")
    thin, bulged = thin_state(rubber, 170e3), bulged_state(rubber, 170e3)
    assert thin.a < pressure_maximum(rubber).a < pressure_minimum(rubber).a < bulged.a
    assert (thin.p_star, bulged.p_star) == pytest.approx((170e3, 170e3), rel=1e-9)


def test_states_that_do_not_exist_are_refused():
    rubber = rubber_named("ogden")
    with pytest.raises(ValueError, match="no thin phase"):
        thin_state(rubber, 400e3)
    with pytest.raises(ValueError, match="no bulged phase"):
        bulged_state(rubber, 100e3)
    with pytest.raises(ValueError, match="no maximum"):
        pressure_maximum(gent(5.0))
