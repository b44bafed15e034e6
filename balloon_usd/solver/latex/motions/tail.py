"""Leading the flat tail of a tube while the tube is blown up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.bubble_shape import tail_volume_per_rest_length, tube_volume_per_rest_length
from balloon_usd.balloon.tube_theory import maxwell_state, pressure_maximum
from balloon_usd.plan.budget import blown_up_pressure
from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture

TAIL_STIFFNESS = 200.0
"""Stiffness of the hand that leads the flat tail while the balloon is blown up, N/m: soft, it only steers."""
TAUT = 1.5
"""Pull of that hand over the thrust of the gas on the end of the flat tube: when the first bulge grows it
drives the tube ahead of it faster than the flow says, and without the pull the tube telescopes (4.8 mm deep
on a 260).
"""


class Tail:
    """A flat tail that a hand keeps straight and as fast as the front behind it."""

    def __init__(self, sculpture: LatexSculpture, balloon: str) -> None:
        """Take hold of its end."""
        self._sculpture, hands = sculpture, sculpture.hands
        plan, scene, strip = sculpture.plan, sculpture.scene, sculpture.plan.strips[balloon]
        self._tip = sculpture.joints[plan.table.guides(strip.bubbles[-1].name)[-1]]
        hands.lead(self._tip, sculpture.frame.middle)
        hands.stiffness[self._tip] = TAIL_STIFFNESS
        thrust = pressure_maximum(strip.rubber).p_star * strip.size.thickness * math.pi * strip.size.radius
        self._ahead = np.float32(TAUT * thrust / TAIL_STIFFNESS)
        """How far (m) the hand is ahead of the end when it keeps it taut."""
        gained = tube_volume_per_rest_length(strip.size, strip.rubber) - tail_volume_per_rest_length(
            strip.size, strip.rubber
        )
        pressure = scene.settings.atmosphere + blown_up_pressure(strip)
        state = maxwell_state(strip.rubber)
        longer = float(scene.air.molar_energy) * (state.bulged.b - state.thin.b)
        self._step = longer / (pressure * gained * plan.recipe.fps)
        """How far (m) a flow of one mol/s drives it in a frame along with the front."""

    def lead(self, flow: float, taut: float) -> None:
        """Lead it for a frame; `flow`: of the gas that drives the front along, mol/s; `taut`: share of the
        pull that keeps it from telescoping.
        """
        tip, hands = self._tip, self._sculpture.hands
        start, goal = hands.start[tip], hands.goal[tip]
        start[:] = goal
        # Forward is the first coordinate.
        start[0] += self._sculpture.frame.middle[tip, 0] - goal[0]
        goal[0] = start[0] + np.float32(flow * self._step)
        ahead = np.float32(taut) * self._ahead
        start[0] += ahead
        goal[0] += ahead

    def leave(self) -> None:
        """Hold it only across from now on: what is blown up lies as long as it is."""
        self._sculpture.hands.free[self._tip] = ALONG
