"""Theory of a ball of rubber that is held round its equator and pressed flat at a pole: a membrane of revolution.

A point of its wall is told by its unstressed angle t from the pole, its radius r, its height z and the angle f of the
wall against the plane that presses. Along the wall, with the stretches a round the axis and b along the contour
(Green & Adkins 1970, Feng & Yang 1973):

    d(sin t W_b)/dt = W_a cos f,   dr/dt = R b cos f,   dz/dt = R b sin f,   T_b df/ds + T_a sin f / r = p

On the flat disc f is 0, and the plane presses back with p, as a wall without bending stiffness lets it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import MembraneLaw

Floats = NDArray[np.float64]

STEPS = 40
"""Steps of Runge and Kutta on the disc, and again from its edge to the equator: four times as many change nothing
in the sixth digit.
"""
POLE = 1e-3
"""Angle from the pole where they begin, radians: nearer all stretches are alike."""
EXACT = 1e-9
"""Error at the equator, in its radius, at which a contour is found."""


class Contour(NamedTuple):
    """What a contour comes to, for each of several guesses, (N,)."""

    disc: Floats
    """Radius of the disc, m."""
    radius: Floats
    """Radius at the equator, m."""
    height: Floats
    """Height there above the disc, m."""


@dataclass(frozen=True)
class PressedBall:
    """A ball whose unstressed equator is held where it is."""

    law: MembraneLaw
    radius: float
    """Unstressed, m."""
    thickness: float
    """Unstressed, m."""
    stretch: float
    """Of the equator."""
    pressure: float
    """Gauge pressure, Pa: that of a sphere so much stretched."""

    def disc(self, height: float) -> float:
        """Return the radius (m) of the flat disc on a plane at this height (m) above the equator.

        Raises:
            AssertionError: no contour was found.
        """
        equator = self.stretch * self.radius
        # From a sphere that hardly touches, step by step.
        about = np.array([self.stretch, 0.2])
        for lower in np.append(np.arange(0.97 * equator, height, -0.1 * equator), height):
            about = self._solved(lower, about)
        return float(self._contour(about[None]).disc[0])

    def _solved(self, height: float, about: Floats) -> Floats:
        """Return the stretch at the pole and the unstressed angle of the disc's edge, by Newton's method."""
        equator, step = self.stretch * self.radius, 1e-5
        for _ in range(40):
            _, radii, heights = self._contour(about + step * np.array([[0, 0], [1, 0], [0, 1]]))
            off = np.stack([radii - equator, heights - height]) / equator
            if np.abs(off[:, 0]).max() < EXACT:
                return about
            change = np.linalg.solve((off[:, 1:] - off[:, :1]) / step, off[:, 0])
            about = about - change / max(1.0, 20.0 * np.abs(change).max())
        raise AssertionError(f"no contour of height {height}: off by {off[:, 0]}")

    def _contour(self, guesses: Floats) -> Contour:
        """Follow the contour from the pole to the equator; `guesses`: as of `_solved`, (N, 2)."""
        pole, edge = guesses.T
        begin, equator = np.full_like(edge, POLE), np.full_like(edge, 0.5 * math.pi)
        state = np.stack([self.radius * pole * np.sin(begin), pole, 0.0 * pole, 0.0 * pole])
        at_edge = self._followed(state, begin, edge, 0.0)
        radius, _, _, height = self._followed(at_edge, edge, equator, self.pressure)
        return Contour(at_edge[0], radius, height)

    def _followed(self, state: Floats, begin: Floats, end: Floats, load: float) -> Floats:
        """Follow it from one unstressed angle to another, by Runge and Kutta; `load`: what bends it, Pa."""
        h = (end - begin) / STEPS
        for k in range(STEPS):
            t = begin + k * h
            k1 = self._slope(t, state, load)
            k2 = self._slope(t + 0.5 * h, state + 0.5 * h * k1, load)
            k3 = self._slope(t + 0.5 * h, state + 0.5 * h * k2, load)
            k4 = self._slope(t + h, state + h * k3, load)
            state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        return state

    def _slope(self, t: Floats, state: Floats, load: float) -> Floats:
        """Return what radius, stretch along, angle and height change by with the unstressed angle."""
        r, b, f, _ = state
        sine = np.sin(t)
        a = r / (self.radius * sine)
        w_a, w_b = self.law.nominal_stress(a, b)
        _, w_ab, w_bb = self.law.stiffness(a, b)
        a_slope = (b * np.cos(f) - a * np.cos(t)) / sine
        b_slope = ((w_a * np.cos(f) - w_b * np.cos(t)) / sine - w_ab * a_slope) / w_bb
        across, along = self.thickness * w_a / b, self.thickness * w_b / a
        turn = self.radius * b * (load - across * np.sin(f) / r) / along
        return np.stack([self.radius * b * np.cos(f), b_slope, turn, self.radius * b * np.sin(f)])
