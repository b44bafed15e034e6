"""Pressing the end of a balloon of latex into the first bubble of another, whose wall is turned inside."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.led_limb import hold_figure
from balloon_usd.solver.latex.motions.face_knot import first_rings, rings_with
from balloon_usd.solver.latex.motions.into_ring import PUSHING
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]


class PressIn(Motion):
    """Two balloons in one line, knot to knot, that are moved into each other."""

    def __init__(self, move: moves.PressIn, sculpture: LatexSculpture) -> None:
        """Take hold of all, and find the way."""
        hold_figure(sculpture)
        self._hands = hands = sculpture.hands
        middle = sculpture.frame.middle
        knot, neck, end = (sculpture.joints[ring] for ring in (move.knot, move.neck, move.other))
        for joint in (knot, neck, end):
            hands.clasp(joint, middle)
        hands.lead_firmly(np.array(first_rings(sculpture, move.other)), PUSHING)
        joints = rings_with(sculpture, move.moved)
        through = (middle[neck] - middle[knot]).astype(np.float64)
        # As far from the neck as two necks lie that are twisted into one.
        far = float(np.linalg.norm(through)) - 2.0 * float(hands.neck[neck])
        self._way: Floats = far * unit(through)
        # The knot before it goes with the end that is pressed in, and stays where that is held.
        if move.moved == move.knot:
            joints, self._way = joints[joints != knot], -self._way
        else:
            joints = np.append(joints, knot)
        self._joints = joints
        self._began: Floats = hands.goal[joints].astype(np.float64)

    def advance(self, share: float) -> None:
        """Move them a share of the way."""
        self._hands.goal[self._joints] = self._began + smooth(share) * self._way
