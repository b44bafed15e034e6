"""Chains of bubbles that hands close, and where their rings are brought, of all sculptures at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.motions.carried import Carried
    from balloon_usd.solver.motions.closing import ClosingChain

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


class Cheeks(NamedTuple):
    """Rings inside the bubbles of a chain, which are pressed outwards as it closes."""

    joints: Ints
    """Of the scene, (C,)."""
    sides: Ints
    """The side of the chain that each is on, (C,)."""
    straight: Floats
    """How far each was off the middle of its side, (C, 3), m."""
    bulge: Floats
    """How far each shall be off it in the end, (C, 1), m."""


@dataclass(frozen=True)
class Chain:
    """A chain of bubbles that is being closed, and what was found when that began."""

    corners: Ints
    """Joints of the chain, from its first to the held one, (N,)."""
    began: Floats
    """Where the corners were, (N, 3), m."""
    closing: ClosingChain
    off: Floats
    """How far the corners were off a straight chain, (N, 3), m."""
    carried: Carried
    """What hangs on its corners."""
    cheeks: Cheeks
    dips: Floats
    """How far what hangs on each corner goes besides in the end, (N, 3), m."""

    def pose(self, progress: float) -> Pose:
        """Return where its corners shall be; `progress`: 0 straight, 1 closed."""
        corners = self.began[-1] + self.closing.pose(progress)
        # The chain was not quite straight: what it was off fades as it closes.
        corners += (1.0 - progress) * self.off
        return Pose(self, progress, corners)


class Pose(NamedTuple):
    """A chain on its way."""

    chain: Chain
    progress: float
    corners: Floats
    """Where its corners shall be, (N, 3), m."""

    @property
    def shifts(self) -> Floats:
        """How far what hangs on each corner shall go, (N, 3), m."""
        return self.corners - self.chain.began + self.progress * self.chain.dips


def pose_chains(goal: NDArray[np.float32], poses: Sequence[Pose]) -> None:
    """Write where hands bring the rings of some chains; `goal`: of all rings, (J, 3), m."""
    chains = [pose.chain for pose in poses]
    corners = np.concatenate([pose.corners for pose in poses])
    goal[np.concatenate([chain.corners for chain in chains])] = corners
    carried = [pose.chain.carried.goals(pose.shifts) for pose in poses]
    goal[np.concatenate([chain.carried.joints for chain in chains])] = np.concatenate(carried)
    counts = [len(chain.cheeks.joints) for chain in chains]
    if any(counts):
        _pose_cheeks(goal, poses, corners, counts)


def _pose_cheeks(
    goal: NDArray[np.float32], poses: Sequence[Pose], corners: Floats, counts: Sequence[int]
) -> None:
    """Write where the rings inside the bubbles of chains go, out of the chains as these close.

    `corners`: of all chains; `counts`: of such rings.
    """
    cheeks = [pose.chain.cheeks for pose in poses]
    before = np.cumsum([0, *(len(pose.corners) for pose in poses[:-1])])
    sides = np.concatenate([each.sides for each in cheeks]) + np.repeat(before, counts)
    centres = np.repeat([pose.corners.mean(axis=0) for pose in poses], counts, axis=0)
    progress = np.repeat([pose.progress for pose in poses], counts)[:, None]
    straight = np.concatenate([each.straight for each in cheeks])
    bulge = np.concatenate([each.bulge for each in cheeks])
    first, second = corners[sides], corners[sides + 1]
    middles, across = 0.5 * (first + second), _unit(second - first)
    out = middles - centres
    out = _unit(out - across * (out * across).sum(axis=1)[:, None])
    places = middles + (1.0 - progress) * straight + progress * bulge * out
    goal[np.concatenate([each.joints for each in cheeks])] = places


def _unit(vectors: Floats) -> Floats:
    """Return vectors (N, 3) at length 1."""
    lengths: Floats = np.sqrt((vectors * vectors).sum(axis=1))
    return vectors / np.maximum(lengths, 1e-9)[:, None]
