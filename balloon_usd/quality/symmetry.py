"""Symmetric parts: twins, which ought to be mirror images of each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from balloon_usd.plan.twins import LEFT, twins_of
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.wall_rings import WallRings
from balloon_usd.solver.mirroring import Mirror

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, PlannedBubble
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

PLACES = 9
"""Places along each bubble that are mirrored."""


class _Twin(NamedTuple):
    """One bubble of a pair."""

    volume: float
    """m3."""
    length: float
    """Along its middle, m."""
    middle: Floats
    """Places at equal distances along its middle line, (PLACES, 3) m."""


def symmetry_of(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> dict[str, dict[str, Any]]:
    """Return how far all pairs of a frame are from equal and mirrored, as results by the keys of measures."""
    twins = {
        left.name.removeprefix(LEFT): (left, right) for left, right in twins_of(plan.recipe, plan.strips)
    }
    pairs = {
        name: (_twin(plan, meshes, frame, left), _twin(plan, meshes, frame, right))
        for name, (left, right) in twins.items()
    }
    # The middle line of an ear goes where its wall is pressed.
    lines = {name: pairs[name] for name, (left, _) in twins.items() if left.hollow}
    found = {
        "symmetric_volume": {name: _share(a.volume, b.volume) for name, (a, b) in pairs.items()},
        "symmetric_length": {name: _share(a.length, b.length) for name, (a, b) in lines.items()},
        "symmetric_place": mirrored({name: (a.middle, b.middle) for name, (a, b) in pairs.items()}),
    }
    return {key: MEASURES[key].largest(each) for key, each in found.items()}


def mirrored(pairs: Mapping[str, tuple[Floats, Floats]]) -> dict[str, float]:
    """Return the largest distance (m) of each bubble from the mirror image of its twin.

    All pairs have one mirror, that of the least squares of these distances. A bubble may run either way
    along the image of its twin, as the two of a lock twist do.

    Args:
        pairs: places along both bubbles, (N, 3) m, by name.
    """
    if not pairs:
        return {}
    mirror = Mirror.of_twins(pairs.values())
    return {name: float(mirror.misses(a, mirror.ordered(a, b)).max()) for name, (a, b) in pairs.items()}


def _twin(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame, bubble: PlannedBubble) -> _Twin:
    line = WallRings.of(plan, meshes, bubble).corners(frame).mean(axis=1)
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.linspace(0.0, run[-1], PLACES)
    middle = np.stack([np.interp(at, run, line[:, axis]) for axis in range(3)], axis=1)
    return _Twin(float(frame.volume[plan.bubbles.index(bubble)]), float(run[-1]), middle)


def _share(a: float, b: float) -> float:
    """Return by which share of their mean two numbers differ; 0 where both are 0."""
    return 2.0 * (a - b) / (a + b) if a + b else 0.0
