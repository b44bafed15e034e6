"""Setting a finished figure straight, so that its twins are mirror images of each other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.led_limb import TURNING, hold_figure, leave_figure
from balloon_usd.solver.mirroring import ways_to_symmetry
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import round_at, smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

NEARLY = 0.04
"""Distance from its own mirror image up to which what lies between twins is set straight, m."""
ROUNDS = 2
"""How often hands lead the figure and loosen their grip: of 67 mm by which a mouse was off its mirror image
28 are left after the first, 12 after the second; of a dog's 22, 4 after the first.
"""
LED = 0.5
"""Share of a round after which it is where it shall be, and hands loosen their grip."""
DECAYS = 8.0
"""How often the force of the hands decays by a factor of e in what is left of a round."""


class Straighten(Motion):
    """Hands that lead all of a figure to the middle between where it is and its mirror image."""

    def __init__(self, move: moves.Straighten, sculpture: LatexSculpture) -> None:
        """See what its twins are; what comes undone is left alone."""
        self._sculpture, self._all = sculpture, sculpture.all_joints
        rings = enumerate(sculpture.plan.table.rings)
        self._led = np.array([k for k, ring in rings if not ring.flat], dtype=np.int64)
        """Rings of the plan that hands lead: a flat tail that is led aside folds into itself."""
        self._joints = self._all[self._led]
        self._twins = [(_rings(sculpture, left), _rings(sculpture, right)) for left, right in move.twins]
        self._between = [_rings(sculpture, name) for name in move.between]
        self._leads = not (sculpture.unwinding or sculpture.undone)
        self._round, self._loosens = -1, False

    def advance(self, share: float) -> None:
        """Lead it on, or loosen the grip."""
        if not self._leads:
            return
        number, share = round_at(share, ROUNDS)
        if number > self._round:
            self._round, self._loosens = number, False
            self._take_hold()
        hands = self._sculpture.hands
        hands.goal[self._joints] = self._began + smooth(min(share / LED, 1.0)) * self._ways
        if share > LED:
            if not self._loosens:
                self._loosens = True
                leave_figure(self._sculpture)
            hands.force[self._joints] = TURNING * math.exp(-DECAYS * (share - LED) / (1.0 - LED))

    def _take_hold(self) -> None:
        """Take hold of the figure and see where it shall lie."""
        sculpture = self._sculpture
        hands = sculpture.hands
        places = sculpture.frame.middle[self._all].astype(np.float64)
        hands.let_go(self._joints)
        hold_figure(sculpture, map(int, self._joints))
        hands.lead_firmly(self._joints, TURNING)
        self._began = places[self._led]
        self._ways = ways_to_symmetry(places, self._twins, self._between, NEARLY)[self._led]


def _rings(sculpture: LatexSculpture, bubble: str) -> NDArray[np.int64]:
    """Return the rings of the plan of a bubble, from its start to its end."""
    return np.array(sculpture.plan.table.along(bubble), dtype=np.int64)
