"""Turning a limb of a figure about the joint at which it hangs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

TURNING = 15.0
"""Largest force of a hand on a ring of the limb, N: half of that with which it pushes one through another."""


class Aim(Motion):
    """A limb that is led as it is about its joint, while hands hold all the rest."""

    def __init__(self, move: moves.Aim, sculpture: LatexSculpture) -> None:
        """Take hold of the limb and of all the rest."""
        hands, joints, middle = sculpture.hands, sculpture.joints, sculpture.frame.middle
        self._hands = hands
        hands.touch(sculpture.bodies)
        # Struts would hold the pose against the hands, which hold all of it now.
        sculpture.struts.loosen(set(joints))
        base, limb, pointing = _rings(move, sculpture)
        for joint in joints:
            hands.lead(joint, middle)
        hands.grip(base, middle)
        self._limb = np.array(limb, dtype=np.int64)
        hands.lead_firmly(self._limb, TURNING)
        self._base: Floats = middle[base].astype(np.float64)
        self._began: Floats = middle[self._limb] - self._base
        """Where the rings of the limb are, away from its joint, (N, 3), m."""
        arm = middle[pointing].mean(axis=0, dtype=np.float64) - self._base
        arm /= max(float(np.linalg.norm(arm)), 1e-9)
        self._arm, self._spin = arm, move.spin
        self._axis, self._angle = turn_between(arm, np.array(move.toward))

    def advance(self, share: float) -> None:
        """Lead it on about its joint."""
        gone = smooth(share)
        turn = turn_about(self._axis, gone * self._angle) @ turn_about(self._arm, gone * self._spin)
        self._hands.goal[self._limb] = self._base + self._began @ turn.T


def _rings(move: moves.Aim, sculpture: LatexSculpture) -> tuple[int, list[int], list[int]]:
    """Return the joint of the scene on which a limb hangs, its others, and those whose middle points."""
    table, joints = sculpture.plan.table, sculpture.joints
    piece = sculpture.plan.recipe.piece.after(move.step)
    limb = piece.limb(move.bubble)
    assert limb is not None, "what is aimed hangs on a joint"
    held = [ring for end in piece.joint(limb.joint) if (ring := table.joint(end)) is not None]
    base = {joints[ring] for ring in held}

    def outer(bubble: str) -> list[int]:
        rings = (*table.ends(bubble), *table.guides(bubble))
        return [joints[ring] for ring in rings if ring is not None and joints[ring] not in base]

    own = outer(move.bubble)
    places = sculpture.frame.middle
    at = places[joints[held[0]]]
    pointing = [max(own, key=lambda joint: float(np.linalg.norm(places[joint] - at)))]
    if all(end.bubble != move.bubble for end in piece.joint(limb.joint)):
        # It lies across, on the far side of a ring of others.
        pointing = own
    return joints[held[0]], sorted({joint for bubble in limb.bubbles for joint in outer(bubble)}), pointing
