"""Symmetric parts: bubbles `left_...` and `right_...` of equal recipes, which ought to be mirror images."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from balloon_usd.operations.moves import OTHER_SIDE
from balloon_usd.quality.measures import MEASURES

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, PlannedBubble
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

LEFT, RIGHT = "left_", "right_"
SAME_LENGTH = 1e-6
"""Largest difference of planned lengths of twins, m."""
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
    pairs = {
        left.name.removeprefix(LEFT): (_twin(plan, meshes, frame, left), _twin(plan, meshes, frame, right))
        for left, right in pairs_of(plan)
    }
    found = {
        "symmetric_volume": {name: _share(a.volume, b.volume) for name, (a, b) in pairs.items()},
        "symmetric_length": {name: _share(a.length, b.length) for name, (a, b) in pairs.items()},
        "symmetric_place": mirrored({name: (a.middle, b.middle) for name, (a, b) in pairs.items()}),
    }
    return {key: MEASURES[key].largest(each) for key, each in found.items()}


def pairs_of(plan: Plan) -> list[tuple[PlannedBubble, PlannedBubble]]:
    """Return the pairs of bubbles of which a recipe says the same, the left one first."""
    by_name = {bubble.name: bubble for bubble in plan.bubbles if plan.strips[bubble.balloon].shape is None}
    twins = [
        (bubble, by_name.get(RIGHT + name.removeprefix(LEFT)))
        for name, bubble in by_name.items()
        if name.startswith(LEFT)
    ]
    return [(left, right) for left, right in twins if right is not None and _said_equal(plan, left, right)]


def _said_equal(plan: Plan, left: PlannedBubble, right: PlannedBubble) -> bool:
    a, b = plan.strips[left.balloon], plan.strips[right.balloon]
    rests = {a.bubbles[-1].name, b.bubbles[-1].name}
    return (
        left.kind == right.kind
        and abs(left.length - right.length) < SAME_LENGTH
        and (a.size, a.rubber) == (b.size, b.rubber)
        and rests.isdisjoint({left.name, right.name})
        and _point(plan, right) == _mirrored_point(_point(plan, left))
    )


def _point(plan: Plan, bubble: PlannedBubble) -> str:
    """Return where the step that makes a bubble points; "" if it does not say so."""
    return getattr(plan.recipe.steps[bubble.step], "point", None) or ""


def _mirrored_point(point: str) -> str:
    """Return where the right one of a pair points if the left one points there."""
    return OTHER_SIDE.get(point, point)


def mirrored(pairs: Mapping[str, tuple[Floats, Floats]]) -> dict[str, float]:
    """Return the largest distance (m) of each bubble from the mirror image of its twin.

    All pairs have one mirror, that of the least squares of these distances. A bubble may run either way
    along the image of its twin, as the two of a lock twist do.

    Args:
        pairs: places along both bubbles, (N, 3) m, by name.
    """
    if not pairs:
        return {}
    middles = [(a.mean(axis=0)[None], b.mean(axis=0)[None]) for a, b in pairs.values()]
    mirror = _mirror(middles)
    turned = {name: (a, _turned(a, b, mirror)) for name, (a, b) in pairs.items()}
    mirror = _mirror(list(turned.values()))
    return {name: float(_misses(a, b, mirror).max()) for name, (a, b) in turned.items()}


def _turned(p: Floats, q: Floats, mirror: _Mirror) -> Floats:
    """Return the places of a bubble in that order in which they are nearer to the image of its twin."""
    other = q[::-1]
    return other if _misses(p, other, mirror).sum() < _misses(p, q, mirror).sum() else q


class _Mirror(NamedTuple):
    """A plane."""

    through: Floats
    """A place in it, (3,) m."""
    normal: Floats
    """Its unit normal, (3,)."""


def _mirror(pairs: Sequence[tuple[Floats, Floats]]) -> _Mirror:
    """Return the plane in which places, (N, 3) m, come nearest to being mirror images of each other.

    For a plane through m with normal n the sum of squared distances is a constant and 4 sum(n.(p-m) n.(q-m)).
    """
    p, q = (np.concatenate([pair[side] for pair in pairs]) for side in (0, 1))
    through = 0.5 * (p + q).mean(axis=0)
    together = (p - through).T @ (q - through)
    return _Mirror(through, np.linalg.eigh(together + together.T)[1][:, 0])


def _misses(p: Floats, q: Floats, mirror: _Mirror) -> Floats:
    """Return the distances (m) of the mirror images of some places, (N, 3) m, from others."""
    image = p - 2.0 * ((p - mirror.through) @ mirror.normal)[:, None] * mirror.normal
    return np.asarray(np.linalg.norm(image - q, axis=1))


def _twin(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame, bubble: PlannedBubble) -> _Twin:
    balloon = list(plan.strips).index(bubble.balloon)
    mesh = meshes[balloon]
    first, last = mesh.ring_at(bubble.rest_start), mesh.ring_at(bubble.rest_end)
    rings = mesh.ring_start[first : last + 1, None] + np.arange(mesh.around)
    line = frame.points[balloon][rings].astype(np.float64).mean(axis=1)
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.linspace(0.0, run[-1], PLACES)
    middle = np.stack([np.interp(at, run, line[:, axis]) for axis in range(3)], axis=1)
    return _Twin(float(frame.volume[plan.bubbles.index(bubble)]), float(run[-1]), middle)


def _share(a: float, b: float) -> float:
    """Return by which share of their mean two numbers differ; 0 where both are 0."""
    return 2.0 * (a - b) / (a + b) if a + b else 0.0
