"""Rubber laws as the kernels take them: curves between knots against the sums that they stand for."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import RUBBERS, Rubber, rubber_named
from balloon_usd.solver.latex.device_law import curve_grid, device_laws, ogden_curve

STIFF = Rubber("cloth", mu=(2.0e3,), alpha=(500.0,), softening=None)
"""A law that no table of even steps over all stretches could follow."""


@pytest.mark.parametrize("rubber", [*(r for r in RUBBERS if r.mu), STIFF], ids=lambda r: r.name)
def test_a_curve_follows_the_sum_of_its_terms_to_a_millionth_of_the_largest(rubber):
    knots, curve = curve_grid(rubber), ogden_curve(rubber).astype(np.float64)
    places = np.linspace(np.log(knots.most**-2.0), np.log(knots.most), 20001)[1:-1]
    squared = np.exp(places)
    step = np.searchsorted(knots.squared, squared, side="right") - 1
    share = (squared - knots.squared[step]) / np.diff(knots.squared)[step]
    powers = share[:, None] ** np.arange(4)
    terms = np.array([m * squared ** (0.5 * k) for m, k in zip(rubber.mu, rubber.alpha, strict=True)])
    energies = np.array([(t - m) / k for t, m, k in zip(terms, rubber.mu, rubber.alpha, strict=True)])
    for row, exact in ((0, terms), (1, energies)):
        found = (curve[step, row] * powers).sum(axis=1)
        scale = np.abs(terms).max(axis=0) + np.abs(rubber.mu).max()
        assert (np.abs(found - exact.sum(axis=0)) / scale).max() < 2e-6


def test_rubber_at_rest_pulls_neither_way():
    rubber = rubber_named("ogden")
    knots, curve = curve_grid(rubber), ogden_curve(rubber)
    rest = int(np.flatnonzero(knots.squared == 1.0)[0])
    assert curve[rest, 0, 0] == pytest.approx(sum(rubber.mu), rel=1e-7)
    assert curve[rest, 1, 0] == 0.0


def test_balloons_of_one_rubber_share_its_curve():
    ogden, gent = rubber_named("ogden"), rubber_named("gent")
    laws, curves = device_laws([ogden, gent, ogden], 1e-4)
    assert [law.first_segment for law in laws] == [0, len(ogden_curve(ogden)), 0]
    assert len(curves) == len(ogden_curve(ogden)) + len(ogden_curve(gent))
