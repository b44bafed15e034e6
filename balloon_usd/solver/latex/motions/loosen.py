"""Hands that let go of a finished figure of latex slowly."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

LOOSE_FORCE = 0.6
"""Force with which hands go on leading every ring at first, N: few rings need more than a tenth of it."""
DECAYS = 10.0
"""How often that decays by a factor of e in all: what still moves comes to rest in the second half."""


class Loosen(Motion):
    """Hands whose grip fades: a figure goes to where its own rubber, gas and friction hold it, and does not
    jump there.
    """

    def __init__(self, _: moves.Loosen, sculpture: LatexSculpture) -> None:
        """Hold by the middle of each ring only, where it is; welds hold by friction from now on."""
        self._hands, middle = sculpture.hands, sculpture.frame.middle
        joints = np.array([j for j in sculpture.all_joints if self._hands.mode[j] != 0], dtype=np.int64)
        self._hands.let_go(joints)
        for joint in joints:
            self._hands.lead(int(joint), middle)
        self._joints = joints
        sculpture.struts.hold(sculpture.friction.pairs(sculpture.hands))

    def advance(self, share: float) -> None:
        """Loosen the grip by a share."""
        self._hands.force[self._joints] = LOOSE_FORCE * math.exp(-DECAYS * share)
