"""How legs are bent so that all feet of a figure stand on one plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.placement import UP, turn_about, turn_between
from balloon_usd.solver.rotations import rotation

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

Floats = NDArray[np.float64]

MOST = 0.25
"""Farthest that a leg is bent, rad: beyond it the figure is another one."""
TOUCHES = 5.0e-4
"""Height above the lowest place up to which a bubble touches the ground, m."""
LOOKS = 4
"""How often the plane through the feet is sought: which vertex of a foot is lowest depends on it."""


def feet_of(
    walls: Mapping[str, Floats], alike: Iterable[frozenset[str]], low: float, near: float
) -> tuple[str, ...]:
    """Return the bubbles that are feet of a figure on the ground: what touches it, and what is like that and
    nearly does.

    Args:
        walls: vertices of every bubble, (V, 3), m.
        alike: groups of bubbles that are each other's like.
        low: height above the lowest vertex up to which a bubble touches the ground, m.
        near: height up to which it nearly does, m.
    """
    height = {name: float(points[:, 2].min()) for name, points in walls.items()}
    lowest = min(height.values())
    touching = {name for name, each in height.items() if each - lowest <= low}
    like = {name for group in alike if not group.isdisjoint(touching) for name in group}
    return tuple(name for name, each in height.items() if each - lowest <= near and name in touching | like)


class Feet(NamedTuple):
    """The feet of a figure on the plane that fits them best."""

    turn: Floats
    """Brings the figure onto it, (3, 3)."""
    place: Floats
    """Lowest vertex of every foot there, (feet, 3), m."""
    height: Floats
    """How far it is above the plane, (feet,), m."""

    @classmethod
    def on_plane(cls, walls: Sequence[Floats], turn: Floats) -> Feet:
        """Return those of a figure; `walls`: vertices of every foot, (V, 3), m; `turn`: brings it about onto
        the plane, (3, 3).
        """
        for _ in range(LOOKS):
            turned = [points @ turn.T for points in walls]
            place = np.array([points[int(np.argmin(points[:, 2]))] for points in turned])
            fit = _plane(place)
            plane = np.linalg.pinv(fit) @ place[:, 2]
            found = cls(turn, place, place[:, 2] - fit @ plane)
            normal = np.array([-plane[1], -plane[2], 1.0])
            turn = turn_about(*turn_between(normal / np.linalg.norm(normal), UP)) @ turn
        return found

    def level_turns(self, limbs: Sequence[int], joints: Floats) -> Floats:
        """Return the smallest turns of some limbs about their joints, (L, 3), rad, after which all feet touch
        one plane, to first order.

        Args:
            limbs: number of the limb to which each foot belongs, (feet,); -1 for none.
            joints: where each limb hangs on that plane, (L, 3), m.
        """
        rise = np.zeros((len(self.place), len(joints), 3))
        for k, limb in enumerate(limbs):
            if limb >= 0:
                arm = self.place[k] - joints[limb]
                # A turn w lifts the foot by the third of w x arm.
                rise[k, limb] = arm[1], -arm[0], 0.0
        # Planes through all feet are as good as this one.
        fit = _plane(self.place)
        off = np.eye(len(fit)) - fit @ np.linalg.pinv(fit)
        turns = np.linalg.lstsq(off @ rise.reshape(len(fit), -1), -self.height, rcond=1e-3)[0]
        return np.asarray(turns.reshape(-1, 3))


def _plane(place: Floats) -> Floats:
    """Return what a plane's height, and its slopes, add to the heights at some places, (N, 3)."""
    beside = place[:, :2] - place[:, :2].mean(axis=0)
    return np.column_stack([np.ones(len(place)), beside])


def levelling_turns(walls: Sequence[Floats], limbs: Sequence[int], joints: Floats, turn: Floats) -> Floats:
    """Return the turns of some limbs about their joints, (L, 3), rad, after which all feet touch one plane.

    Args:
        walls: vertices of every foot, (V, 3), m.
        limbs: number of the limb to which each foot belongs, (feet,); -1 for none.
        joints: where each limb hangs, (L, 3), m.
        turn: brings the figure about onto that plane, (3, 3).
    """
    turns = np.zeros((len(joints), 3))
    for _ in range(LOOKS):
        bent = [
            points if limb < 0 else joints[limb] + (points - joints[limb]) @ rotation(turns[limb]).T
            for points, limb in zip(walls, limbs, strict=True)
        ]
        feet = Feet.on_plane(bent, turn)
        turns += feet.level_turns(limbs, joints @ feet.turn.T) @ feet.turn
        turns *= min(1.0, MOST / max(float(np.linalg.norm(turns, axis=1).max()), 1e-12))
    return turns
