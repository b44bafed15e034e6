"""What is measured on a tube after the pinch and the turn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.bench.pierced import pierced_triangles

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, Ints, PinchRun, PinchTask

RECOVERED = 0.8
"""Share of its first girth at which the tube counts as whole again: the neck ends there."""


@dataclass(frozen=True)
class PinchShape:
    """The shape that a solver ended with."""

    volume_ratio: float
    """Volume at the end over volume at the start."""
    neck: float
    """Distance along the axis from the pinch to where the girth is back, mean of both sides, m; not a number
    where it never is.
    """
    turns: float
    """Turns between the ends that are still wound in the wall."""
    crossings: int
    """Edges of the mesh that pierce a triangle, each counted with every triangle that it pierces."""


def shape_of(task: PinchTask, run: PinchRun) -> PinchShape:
    """Measure the end of a run."""
    return PinchShape(
        volume_ratio=volume(run.end, task.triangles) / volume(run.start, task.triangles),
        neck=neck_height(task, run.start, run.end),
        turns=wound_turns(task, run.end),
        crossings=pierced_triangles(run.end, task.triangles),
    )


def volume(points: Floats, triangles: Ints) -> float:
    """Return the volume (m3) inside the triangles (T, 3) of closed walls at `points` (V, 3), m."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.einsum("ti,ti->", a, np.cross(b, c))) / 6.0


def neck_height(task: PinchTask, start: Floats, end: Floats) -> float:
    """Return the mean distance (m) along x from the middle ring to where the girth is back, on both sides."""
    first = _rings(task, start)
    wanted = RECOVERED * float(_girth(first)[task.middle])
    rings = _rings(task, end)
    girth, place = _girth(rings), rings[:, :, 0].mean(axis=1)
    heights = []
    for side in (-1, 1):
        k = task.middle
        while girth[k] < wanted:
            k += side
            if not 0 <= k < len(girth):
                return math.nan
        if k == task.middle:
            return 0.0
        before = k - side
        share = (wanted - girth[before]) / (girth[k] - girth[before])
        heights.append(abs(place[before] + share * (place[k] - place[before]) - place[task.middle]))
    return float(np.mean(heights))


def wound_turns(task: PinchTask, points: Floats) -> float:
    """Return the turns between the first and the last ring, added up from ring to ring."""
    rings = _rings(task, points)
    arms = rings - rings.mean(axis=1, keepdims=True)
    flat = arms[:, :, 1] + 1j * arms[:, :, 2]
    between = np.angle((flat[1:] * np.conj(flat[:-1])).mean(axis=1))
    return float(abs(between.sum())) / (2.0 * math.pi)


def _rings(task: PinchTask, points: Floats) -> Floats:
    """Vertices of all rings, (R, around, 3), m."""
    return np.asarray(points[task.mesh.ring_start[:, None] + np.arange(task.mesh.around)])


def _girth(rings: Floats) -> Floats:
    """Length round every ring as of a circle of its mean radius, (R,), m: no wider for being crumpled."""
    arms = rings - rings.mean(axis=1, keepdims=True)
    return np.asarray(2.0 * math.pi * np.linalg.norm(arms, axis=2).mean(axis=1))
