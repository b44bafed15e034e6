"""Rubber laws: the elastic energy of an incompressible membrane from its two in-plane stretches.

Throughout, `a` is the stretch round the tube (hoop), `b` the stretch along it (axial), and the stretch
through the wall is 1 / (a b). Energies are per unstressed volume (J/m3), stresses are nominal (Pa).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

LATEX_DENSITY = 930.0
"""Density of natural rubber gum, kg/m3 (literature range 910 to 950)."""

BURST_STRETCH = 7.0
"""Hoop stretch at which a 260 bursts that is stretched alike all over, judged."""

_erf_of_each = np.frompyfunc(math.erf, 1, 1)
"""As objects; np.vectorize takes thirty times as long for one number."""


class MembraneLaw(Protocol):
    """Anything that gives the energy and the stress of a membrane from its stretches."""

    def __hash__(self) -> int:
        """Laws are values: what theory finds for one is kept."""
        ...

    def energy(self, a: ArrayLike, b: ArrayLike) -> Floats:
        """Return the energy, J/m3, of the same shape as the stretches."""
        ...

    def nominal_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats]:
        """Return the nominal stresses (W_a, W_b), Pa, of the same shape as the stretches."""
        ...

    def energy_and_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return both, (W, W_a, W_b), in half the time: powers take most of it."""
        ...

    def stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the second derivatives (W_aa, W_ab, W_bb), Pa, of the same shape as the stretches."""
        ...

    def energy_to_stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, ...]:
        """Return all of these, (W, W_a, W_b, W_aa, W_ab, W_bb), in half the time."""
        ...


@dataclass(frozen=True)
class Softening:
    """Mullins softening: rubber that was stretched is softer on the way back (Ogden & Roxburgh 1999).

    Raises:
        ValueError: `r` is not above 1 or `c` is not positive.
    """

    r: float = 2.0
    """Depth: the stress falls to the fraction 1 - 1/r at most."""
    c: float = 0.4
    """Width of the fall, as a fraction of the largest energy so far."""

    def __post_init__(self) -> None:
        if not (self.r > 1.0 and self.c > 0.0):
            raise ValueError(f"softening needs r > 1 and c > 0, got r={self.r}, c={self.c}")

    def factor(self, w: ArrayLike, w_max: ArrayLike) -> Floats:
        """Return the stress factor at energy w (J/m3) after the largest energy w_max (J/m3), same shape as w.

        Ogden & Roxburgh 1999: 1 - erf((w_max - w) / (c w_max)) / r; 1 where w is at or beyond w_max.
        """
        return self.factor_and_energy(w, w_max)[0]

    def slope(self, w: ArrayLike, w_max: ArrayLike) -> Floats:
        """Return the derivative of the stress factor by the energy w, m3/J, same shape as w."""
        w, w_max = np.asarray(w, dtype=np.float64), np.asarray(w_max, dtype=np.float64)
        width = self.c * np.where(w_max > 0.0, w_max, 1.0)
        bell = 2.0 / math.sqrt(math.pi) * np.exp(-(self._depth(w, w_max) ** 2)) / (self.r * width)
        return np.asarray(np.where(w < w_max, bell, 0.0))

    def stored_energy(self, w: ArrayLike, w_max: ArrayLike) -> Floats:
        """Return the potential of the softened stress, J/m3, same shape as w.

        It is w_max minus the integral of the factor from w to w_max, so its gradient is the softened stress.
        """
        return self.factor_and_energy(w, w_max)[1]

    def factor_and_energy(self, w: ArrayLike, w_max: ArrayLike) -> tuple[Floats, Floats]:
        """Return both, the stress factor and the potential of the softened stress (J/m3)."""
        w, w_max = np.asarray(w, dtype=np.float64), np.asarray(w_max, dtype=np.float64)
        depth = self._depth(w, w_max)
        eroded = np.asarray(_erf_of_each(depth), dtype=np.float64)
        lost = depth * eroded + (np.exp(-(depth**2)) - 1.0) / math.sqrt(math.pi)
        return np.asarray(1.0 - eroded / self.r), np.asarray(w + self.c * w_max / self.r * lost)

    def _depth(self, w: ArrayLike, w_max: ArrayLike) -> Floats:
        w, w_max = np.asarray(w, dtype=np.float64), np.asarray(w_max, dtype=np.float64)
        width = self.c * np.where(w_max > 0.0, w_max, 1.0)
        return np.asarray(np.maximum(w_max - w, 0.0) / width)


@dataclass(frozen=True)
class Rubber:
    """An incompressible rubber: the sum of Ogden terms and of a Gent term.

    W = sum of mu/alpha (a^alpha + b^alpha + (a b)^-alpha - 3)  -  gent_mu/2 Jm ln(1 - (I1 - 3)/Jm)

    Raises:
        ValueError: `mu` and `alpha` differ in length, or a limit is not positive.
    """

    name: str
    mu: tuple[float, ...] = ()
    """Ogden moduli, Pa (Ogden 1972)."""
    alpha: tuple[float, ...] = ()
    """Ogden exponents. Mooney-Rivlin has (2, -2), neo-Hooke (2)."""
    gent_mu: float = 0.0
    """Modulus of the Gent term, Pa; 0 for none (Gent 1996)."""
    gent_limit: float = math.inf
    """Largest I1 - 3 of the Gent term (Jm); infinite for neo-Hooke."""
    density: float = LATEX_DENSITY
    """Density, kg/m3."""
    softening: Softening | None = Softening()
    """Mullins softening, or None for a rubber that retraces its loading path."""

    def __post_init__(self) -> None:
        if len(self.mu) != len(self.alpha):
            raise ValueError(f"rubber {self.name}: {len(self.mu)} moduli but {len(self.alpha)} exponents")
        if not (self.gent_limit > 0.0 and self.density > 0.0):
            raise ValueError(f"rubber {self.name}: gent_limit and density must be positive")

    @property
    def shear_modulus(self) -> float:
        """Small-strain shear modulus, Pa."""
        return 0.5 * sum(m * k for m, k in zip(self.mu, self.alpha, strict=True)) + self.gent_mu

    def without_softening(self) -> Rubber:
        """Return the same rubber without Mullins softening."""
        return replace(self, softening=None)

    def softening_factor(self, w: ArrayLike, w_max: ArrayLike) -> Floats:
        """Return the factor on the stress at energy w after the largest energy w_max (both J/m3)."""
        if self.softening is None:
            return np.ones(np.broadcast_shapes(np.shape(w), np.shape(w_max)))
        return self.softening.factor(w, w_max)

    def energy(self, a: ArrayLike, b: ArrayLike) -> Floats:
        """Return the energy of first loading, J/m3; infinite beyond the Gent limit."""
        return self.energy_and_stress(a, b)[0]

    def nominal_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats]:
        """Return the nominal stresses (W_a, W_b) of first loading, Pa; infinite beyond the Gent limit."""
        return self.energy_and_stress(a, b)[1:]

    def energy_and_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return both of first loading, (W, W_a, W_b), J/m3 and Pa; infinite beyond the Gent limit."""
        a, b = _stretches(a, b)
        thickness = 1.0 / (a * b)
        energy, hoop, axial = (np.zeros(thickness.shape) for _ in range(3))
        for m, k in zip(self.mu, self.alpha, strict=True):
            round_, along, across = a**k, b**k, thickness**k
            energy += m / k * (round_ + along + across - 3.0)
            hoop += m * (round_ - across) / a
            axial += m * (along - across) / b
        if self.gent_mu:
            energy += self._gent_energy(a, b)
            modulus = self.gent_mu * self._gent_rise(a, b)
            with np.errstate(invalid="ignore"):
                hoop += modulus * (a - thickness**2 / a)
                axial += modulus * (b - thickness**2 / b)
        return energy, hoop, axial

    def stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the second derivatives (W_aa, W_ab, W_bb) of first loading, Pa."""
        _, _, _, aa, ab, bb = self.energy_to_stiffness(a, b)
        return aa, ab, bb

    def energy_to_stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, ...]:
        """Return all of these of first loading, (W, W_a, W_b, W_aa, W_ab, W_bb), J/m3 and Pa."""
        a, b = _stretches(a, b)
        thickness = 1.0 / (a * b)
        energy, hoop, axial, aa, ab, bb = (np.zeros(thickness.shape) for _ in range(6))
        for m, k in zip(self.mu, self.alpha, strict=True):
            round_, along, across = a**k, b**k, thickness**k
            energy += m / k * (round_ + along + across - 3.0)
            hoop += m * (round_ - across)
            axial += m * (along - across)
            aa += m * ((k - 1.0) * round_ + (k + 1.0) * across)
            bb += m * ((k - 1.0) * along + (k + 1.0) * across)
            ab += m * k * across
        hoop, axial, aa, bb, ab = hoop / a, axial / b, aa / a**2, bb / b**2, ab * thickness
        if self.gent_mu:
            rise = self.gent_mu * self._gent_rise(a, b)
            bend = 2.0 * rise**2 / (self.gent_mu * self.gent_limit)
            slope_a, slope_b = a - thickness**2 / a, b - thickness**2 / b
            energy += self._gent_energy(a, b)
            with np.errstate(invalid="ignore"):
                hoop += rise * slope_a
                axial += rise * slope_b
                aa += rise * (1.0 + 3.0 * thickness**2 / a**2) + bend * slope_a**2
                bb += rise * (1.0 + 3.0 * thickness**2 / b**2) + bend * slope_b**2
                ab += rise * 2.0 * thickness**3 + bend * slope_a * slope_b
        return energy, hoop, axial, aa, ab, bb

    def _gent_energy(self, a: Floats, b: Floats) -> Floats:
        strain = a**2 + b**2 + (1.0 / (a * b)) ** 2 - 3.0
        if math.isinf(self.gent_limit):
            return np.asarray(0.5 * self.gent_mu * strain)
        with np.errstate(divide="ignore"):
            room = np.log(np.maximum(1.0 - strain / self.gent_limit, 0.0))
        return np.asarray(-0.5 * self.gent_mu * self.gent_limit * room)

    def _gent_rise(self, a: Floats, b: Floats) -> Floats:
        room = 1.0 - (a**2 + b**2 + (a * b) ** -2.0 - 3.0) / self.gent_limit
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / np.maximum(room, 0.0))


@dataclass(frozen=True)
class UnloadedRubber:
    """A rubber on its way back from the energy `w_max`, after Ogden & Roxburgh 1999.

    Beyond `w_max` it is the rubber of first loading.
    """

    rubber: Rubber
    w_max: float | Floats
    """Largest energy of first loading so far, J/m3; or that of each piece of a wall."""

    def energy(self, a: ArrayLike, b: ArrayLike) -> Floats:
        """Return the potential of the softened stress, J/m3, of the same shape as the stretches."""
        return self.energy_and_stress(a, b)[0]

    def nominal_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats]:
        """Return the softened nominal stresses (W_a, W_b), Pa, of the same shape as the stretches."""
        return self.energy_and_stress(a, b)[1:]

    def energy_and_stress(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the potential and the stresses that it gives, (W, W_a, W_b), J/m3 and Pa."""
        w, hoop, axial = self.rubber.energy_and_stress(a, b)
        soft = self.rubber.softening
        if soft is None:
            return w, hoop, axial
        factor, stored = soft.factor_and_energy(w, self.w_max)
        return stored, factor * hoop, factor * axial

    def stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the second derivatives (W_aa, W_ab, W_bb), Pa, of the same shape as the stretches."""
        _, _, _, aa, ab, bb = self.energy_to_stiffness(a, b)
        return aa, ab, bb

    def energy_to_stiffness(self, a: ArrayLike, b: ArrayLike) -> tuple[Floats, ...]:
        """Return all of these, (W, W_a, W_b, W_aa, W_ab, W_bb), J/m3 and Pa."""
        loading = self.rubber.energy_to_stiffness(a, b)
        soft = self.rubber.softening
        if soft is None:
            return loading
        w, hoop, axial, aa, ab, bb = loading
        (factor, stored), slope = soft.factor_and_energy(w, self.w_max), soft.slope(w, self.w_max)
        return (
            stored,
            factor * hoop,
            factor * axial,
            factor * aa + slope * hoop**2,
            factor * ab + slope * hoop * axial,
            factor * bb + slope * axial**2,
        )


def relaxed_stretches(a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats]:
    """Return the stretches that a wrinkled membrane feels, of the same shape as those given.

    Tension field: a wall cannot be pushed. Where one stretch is below the free lateral contraction of the
    other (a < b^-1/2), the wall wrinkles and is in uniaxial tension; where both are below 1 it is slack.
    """
    a, b = _stretches(a, b)
    slack = np.maximum(a, b) < 1.0
    hoop = np.where(a < b, np.maximum(a, b**-0.5), a)
    axial = np.where(a < b, b, np.maximum(b, a**-0.5))
    return np.where(slack, 1.0, hoop), np.where(slack, 1.0, axial)


def _stretches(a: ArrayLike, b: ArrayLike) -> tuple[Floats, Floats]:
    return np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)


RUBBERS: tuple[Rubber, ...] = (
    # Kyriakides & Chang 1991, fitted to the latex tubes that they inflated.
    Rubber("ogden", mu=(617e3, 1.86e3, -9.79e3), alpha=(1.30, 5.08, -2.00)),
    # Ogden 1972, fitted to the natural rubber of Treloar.
    Rubber("ogden-treloar", mu=(630e3, 1.2e3, -10e3), alpha=(1.3, 5.0, -2.0)),
    # Gent 1996; constants chosen for the Maxwell pressure of "ogden".
    Rubber("gent", gent_mu=375e3, gent_limit=97.0),
    # Müller & Strehlow 2004: s+ = 3 bar, s- = -0.3 bar. It has no bulged phase: round balloons only.
    Rubber("mooney-rivlin", mu=(300e3, -30e3), alpha=(2.0, -2.0)),
    # The small-strain modulus of "ogden". It never stiffens, so it has no bulged phase either.
    Rubber("neo-hooke", mu=(416e3,), alpha=(2.0,)),
)
"""Every rubber that a recipe can name."""

DEFAULT_RUBBER = "ogden"
"""Name of the rubber used when none is asked for."""

_RUBBERS_BY_NAME = {rubber.name: rubber for rubber in RUBBERS}


def rubber_named(name: str = DEFAULT_RUBBER) -> Rubber:
    """Return the rubber with this name, softening included.

    Raises:
        ValueError: no such rubber.
    """
    try:
        return _RUBBERS_BY_NAME[name]
    except KeyError:
        raise ValueError(f"unknown rubber {name!r}, expected one of {', '.join(_RUBBERS_BY_NAME)}") from None
