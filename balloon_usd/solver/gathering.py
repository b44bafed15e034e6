"""Gathering: where hands bring the rings of chains of bubbles that they close, of all sculptures at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.plan.closing import ClosingChain

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Gathering:
    """A chain of bubbles that is being closed, and what it found when that began; places in m."""

    corners: Ints
    """Joints of the chain, from its first to the held one, (N,)."""
    before: Ints
    """Joints of what is already made, (M,)."""
    began: Floats
    """Where the corners were, (N, 3)."""
    places_before: Floats
    """Where what is already made was, (M, 3)."""
    chain: ClosingChain
    off: Floats
    """How far the corners were off a straight chain, (N, 3)."""
    cheeks: Ints
    """Rings inside its bubbles, (C,)."""
    sides: Ints
    """The side of the chain that each is on, (C,)."""
    straight: Floats
    """How far each was off the middle of its side, (C, 3)."""
    bulge: Floats
    """How far each shall be off it in the end, (C, 1)."""

    def pose(self, progress: float) -> Pose:
        """Return where its corners shall be; `progress`: 0 straight, 1 closed."""
        corners = self.began[-1] + self.chain.pose(progress)
        # The chain was not quite straight: what it was off fades as it closes.
        corners += (1.0 - progress) * self.off
        return Pose(self, progress, corners)


class Pose(NamedTuple):
    """A chain on its way."""

    gathering: Gathering
    progress: float
    corners: Floats
    """Where its corners shall be, (N, 3), m."""


def pose_chains(goal: NDArray[np.float32], poses: Sequence[Pose]) -> None:
    """Write where hands bring the rings of some chains; `goal`: of all rings, (J, 3), m."""
    chains = [pose.gathering for pose in poses]
    corners = np.concatenate([pose.corners for pose in poses])
    goal[np.concatenate([chain.corners for chain in chains])] = corners
    shifts = [pose.corners[0] - pose.gathering.began[0] for pose in poses]
    places = np.concatenate([chain.places_before for chain in chains])
    moved = np.repeat(shifts, [len(chain.before) for chain in chains], axis=0)
    goal[np.concatenate([chain.before for chain in chains])] = places + moved
    counts = [len(chain.cheeks) for chain in chains]
    if any(counts):
        _pose_cheeks(goal, poses, corners, counts)


def _pose_cheeks(
    goal: NDArray[np.float32], poses: Sequence[Pose], corners: Floats, counts: Sequence[int]
) -> None:
    """Write where the rings inside the bubbles of chains go, out of the chains as these close.

    `corners`: of all chains; `counts`: of such rings.
    """
    chains = [pose.gathering for pose in poses]
    before = np.cumsum([0, *(len(pose.corners) for pose in poses[:-1])])
    sides = np.concatenate([chain.sides for chain in chains]) + np.repeat(before, counts)
    centres = np.repeat([pose.corners.mean(axis=0) for pose in poses], counts, axis=0)
    progress = np.repeat([pose.progress for pose in poses], counts)[:, None]
    straight = np.concatenate([chain.straight for chain in chains])
    bulge = np.concatenate([chain.bulge for chain in chains])
    first, second = corners[sides], corners[sides + 1]
    middles, across = 0.5 * (first + second), _unit(second - first)
    out = middles - centres
    out = _unit(out - across * (out * across).sum(axis=1)[:, None])
    places = middles + (1.0 - progress) * straight + progress * bulge * out
    goal[np.concatenate([chain.cheeks for chain in chains])] = places


def _unit(vectors: Floats) -> Floats:
    """Return vectors (N, 3) at length 1."""
    lengths: Floats = np.sqrt((vectors * vectors).sum(axis=1))
    return vectors / np.maximum(lengths, 1e-9)[:, None]
