"""How far from its joint rubber of a neck lies that goes through itself.

There gas between its layers may blow it up inside its bubble, which only a count shows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.quality.joints import joints_of
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.walls import neck_reach

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame


class Farthest(NamedTuple):
    """The rubber of a neck that goes through itself farthest from its joint."""

    joint: str
    """The joint, by its first end."""
    away: float
    """m"""
    reaches: float
    """The same in what of the unstressed balloon counts as neck on one side of a joint."""


class NeckReach:
    """The joints of one sculpture, as `walls_of` counts them."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find the rings of all joints; one mesh a balloon, in the order of `Plan.strips`."""
        self._joints = joints_of(plan)
        self._rings = [[RingCorners.of(plan, meshes, ring) for ring in joint.rings] for joint in self._joints]
        self._reach = [neck_reach(strip) for strip in plan.strips.values()]

    def farthest(self, frame: Frame, edges: NDArray[np.int64], joints: NDArray[np.int64]) -> Farthest | None:
        """Return what lies farthest in a frame; None where nothing goes through itself.

        `edges`, `joints`: as of `CrossingCounter.in_necks`.
        """
        points = np.concatenate(frame.points).astype(np.float64)
        middles = points[edges].mean(axis=1)
        found = [self._of_joint(frame, int(joint), middles[joints == joint]) for joint in np.unique(joints)]
        return max(found, key=lambda each: each.reaches, default=None)

    def _of_joint(self, frame: Frame, joint: int, places: NDArray[np.float64]) -> Farthest:
        """Return the farthest of some places, (P, 3) m, each from the nearest neck of their joint."""
        rings = self._rings[joint]
        necks = np.array([ring.places(frame).mean(axis=0) for ring in rings])
        away = np.linalg.norm(places[:, None] - necks[None], axis=2)
        reaches = (away / np.array([self._reach[ring.balloon] for ring in rings])).min(axis=1)
        worst = int(np.argmax(reaches))
        return Farthest(self._joints[joint].name, float(away[worst].min()), float(reaches[worst]))
