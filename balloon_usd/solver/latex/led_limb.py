"""Limbs of a figure that hands turn about the joints on which they hang."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.operations.workpiece import Limb, Workpiece
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

TURNING = 15.0
"""Largest force of a hand on a ring of the limb, N: half of that with which it pushes one through another."""


def hold_figure(sculpture: LatexSculpture, joints: Iterable[int] | None = None) -> None:
    """Take hold of all rings of a figure, or of some joints of the scene, where they are."""
    sculpture.hands.touch(sculpture.bodies)
    # Struts would hold the pose against the hands, which hold all of it now.
    sculpture.struts.loosen(set(sculpture.joints))
    for joint in sculpture.joints if joints is None else joints:
        sculpture.hands.lead(joint, sculpture.frame.middle)


def leave_figure(sculpture: LatexSculpture) -> None:
    """Leave the pose of a figure to friction, and let it stick to what it lies on."""
    sculpture.hold_pose()
    # What leaks shrinks, and so does not stick.
    if sculpture.plan.recipe.physics.leak is None:
        sculpture.hands.lay(list(sculpture.bodies))


class LedLimb:
    """A limb that hands lead as it is, while they hold all the rest."""

    def __init__(self, sculpture: LatexSculpture, piece: Workpiece, limb: Limb) -> None:
        """Find its rings; `piece`: what is made by then."""
        self._sculpture = sculpture
        rings = map(sculpture.plan.table.joint, piece.joint(limb.joint))
        self._held = [sculpture.joints[ring] for ring in rings if ring is not None]
        """Joints of the scene that are the one on which it hangs."""
        outer = {joint for bubble in limb.bubbles for joint in self.outer(bubble)}
        self._joints = np.array(sorted(outer), dtype=np.int64)

    @property
    def base(self) -> Floats:
        """Where the joint is on which it hangs, (3,), m."""
        base: Floats = self._sculpture.frame.middle[self._held[0]].astype(np.float64)
        return base

    def outer(self, bubble: str) -> list[int]:
        """Return the joints of the scene of a bubble of it, without that on which it hangs."""
        table, joints = self._sculpture.plan.table, self._sculpture.joints
        rings = (*table.ends(bubble), *table.guides(bubble))
        return [joints[ring] for ring in rings if ring is not None and joints[ring] not in self._held]

    def way_to(self, joints: list[int]) -> Floats:
        """Return the unit direction (3,) from the joint on which it hangs to the middle of some others."""
        return unit(self._sculpture.frame.middle[joints].mean(axis=0, dtype=np.float64) - self.base)

    def take(self, force: float = TURNING) -> None:
        """Grip the joint on which it hangs, and take hold of the rest of it with up to a force (N)."""
        hands, middle = self._sculpture.hands, self._sculpture.frame.middle
        hands.grip(self._held[0], middle)
        hands.lead_firmly(self._joints, force)
        self._base = self.base
        self._began: Floats = middle[self._joints] - self._base
        """Where its joints are, away from that on which it hangs, (N, 3), m."""

    def reach(self, turn: Floats, axis: Floats) -> float:
        """Return how far its rings lie apart along a unit axis (3,) after a turn (3, 3), m."""
        along = self._began @ turn.T @ axis
        return float(along.max() - along.min())

    def turn(self, turn: Floats) -> None:
        """Lead it to where a turn (3, 3) brings it that has been taken."""
        self._sculpture.hands.goal[self._joints] = self._base + self._began @ turn.T
