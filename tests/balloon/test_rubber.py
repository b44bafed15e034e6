"""Rubber laws: patch tests, softening and wrinkling."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import (
    RUBBERS,
    Rubber,
    Softening,
    UnloadedRubber,
    relaxed_stretches,
    rubber_named,
)

MPA = 1e6


@pytest.mark.parametrize(
    ("stretch", "uniaxial", "equibiaxial", "pure_shear"),
    [(2.0, 0.603, 0.817, 0.684), (4.0, 1.414, 2.089, 1.481), (6.0, 3.816, 5.952, 3.887)],
)
def test_latex_patch_stresses_match_the_published_law(stretch, uniaxial, equibiaxial, pure_shear):
    latex = rubber_named("ogden")
    assert latex.nominal_stress(stretch**-0.5, stretch)[1] / MPA == pytest.approx(uniaxial, abs=5e-4)
    assert latex.nominal_stress(stretch, stretch)[1] / MPA == pytest.approx(equibiaxial, abs=5e-4)
    assert latex.nominal_stress(1.0, stretch)[1] / MPA == pytest.approx(pure_shear, abs=5e-4)


@pytest.mark.parametrize(
    ("name", "modulus"),
    [("ogden", 416e3), ("ogden-treloar", 422e3), ("gent", 375e3), ("mooney-rivlin", 330e3)],
)
def test_shear_moduli_match_the_sources(name, modulus):
    assert rubber_named(name).shear_modulus == pytest.approx(modulus, rel=2e-3)


@pytest.mark.parametrize("unloaded", [False, True], ids=["loading", "unloading"])
@pytest.mark.parametrize("rubber", RUBBERS, ids=lambda rubber: rubber.name)
def test_stress_and_stiffness_are_the_derivatives_of_the_energy(rubber, unloaded):
    law = UnloadedRubber(rubber, 12e6) if unloaded else rubber
    a, b = np.array([0.9, 1.4, 3.1, 5.0]), np.array([1.3, 1.1, 2.2, 3.9])
    e = 1e-5
    hoop, axial = law.nominal_stress(a, b)
    assert hoop == pytest.approx((law.energy(a + e, b) - law.energy(a - e, b)) / (2 * e), rel=1e-6)
    assert axial == pytest.approx((law.energy(a, b + e) - law.energy(a, b - e)) / (2 * e), rel=1e-6)
    aa, ab, bb = law.stiffness(a, b)
    right, left = law.nominal_stress(a + e, b), law.nominal_stress(a - e, b)
    assert aa == pytest.approx((right[0] - left[0]) / (2 * e), rel=1e-6)
    assert ab == pytest.approx((right[1] - left[1]) / (2 * e), rel=1e-5)
    top, bottom = law.nominal_stress(a, b + e), law.nominal_stress(a, b - e)
    assert bb == pytest.approx((top[1] - bottom[1]) / (2 * e), rel=1e-6)


@pytest.mark.parametrize("rubber", RUBBERS, ids=lambda rubber: rubber.name)
def test_unstressed_rubber_holds_no_energy_and_no_stress(rubber):
    assert float(rubber.energy(1.0, 1.0)) == pytest.approx(0.0, abs=1e-9)
    assert np.array(rubber.nominal_stress(1.0, 1.0)) == pytest.approx(0.0, abs=1e-9)


def test_a_gent_rubber_is_infinitely_stiff_beyond_its_limit():
    gent = rubber_named("gent")
    assert np.isinf(gent.energy(10.0, 1.0))
    assert np.isinf(gent.nominal_stress(10.0, 1.0)[0])


def test_softened_stress_joins_the_loading_curve_at_the_largest_energy():
    latex = rubber_named("ogden")
    w_max = float(latex.energy(5.0, 4.0))
    unloaded = UnloadedRubber(latex, w_max)
    assert unloaded.energy(5.0, 4.0) == pytest.approx(w_max)
    assert unloaded.nominal_stress(5.0, 4.0)[0] == pytest.approx(latex.nominal_stress(5.0, 4.0)[0])
    assert unloaded.nominal_stress(6.0, 4.0)[0] == pytest.approx(latex.nominal_stress(6.0, 4.0)[0])


def test_fully_unloaded_rubber_keeps_the_fraction_one_minus_one_over_r():
    assert Softening(r=2.0, c=0.4).factor(0.0, 1.0) == pytest.approx(0.5, abs=3e-4)
    assert Softening(r=4.0, c=0.4).factor(0.0, 1.0) == pytest.approx(0.75, abs=3e-4)


def test_softening_factor_is_one_for_virgin_and_for_unsoftened_rubber():
    latex = rubber_named("ogden")
    assert latex.softening_factor(0.0, 0.0) == 1.0
    assert latex.without_softening().softening_factor(1.0, 5.0) == 1.0
    assert latex.softening_factor(1.0, 5.0) < 1.0


@pytest.mark.parametrize(
    ("given", "felt"),
    [
        ((2.0, 1.5), (2.0, 1.5)),
        ((0.3, 4.0), (0.5, 4.0)),
        ((4.0, 0.3), (4.0, 0.5)),
        ((0.9, 0.8), (1.0, 1.0)),
        ((1.0, 0.9), (1.0, 1.0)),
    ],
    ids=["taut", "hoop wrinkles", "axial wrinkles", "slack", "just slack"],
)
def test_a_wrinkled_wall_feels_uniaxial_tension(given, felt):
    assert np.array(relaxed_stretches(*given)) == pytest.approx(felt)


@pytest.mark.parametrize("rubber", RUBBERS, ids=lambda rubber: rubber.name)
def test_a_wrinkled_wall_never_pushes(rubber):
    a, b = np.meshgrid(np.linspace(0.2, 5.0, 40), np.linspace(0.2, 5.0, 40))
    assert np.array(rubber.nominal_stress(*relaxed_stretches(a, b))).min() > -1e-6 * rubber.shear_modulus


@pytest.mark.parametrize(
    ("r", "c"), [(1.0, 0.4), (2.0, 0.0), (float("nan"), 0.4)], ids=["r", "c", "not a number"]
)
def test_an_impossible_softening_is_refused(r, c):
    with pytest.raises(ValueError, match="softening needs"):
        Softening(r, c)


def test_an_impossible_rubber_is_refused():
    with pytest.raises(ValueError, match="2 moduli but 1 exponents"):
        Rubber("odd", mu=(1.0, 2.0), alpha=(2.0,))
    with pytest.raises(ValueError, match="must be positive"):
        Rubber("odd", gent_mu=1.0, gent_limit=0.0)


def test_an_unknown_rubber_is_refused_with_the_choices():
    with pytest.raises(ValueError, match=r"'latex'.*ogden-treloar"):
        rubber_named("latex")
