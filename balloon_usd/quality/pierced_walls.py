"""Walls that pierce each other in the last frame: how often, in which bubbles, how deep."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.quality.crossings import pierced_triangles
from balloon_usd.quality.depth import deepest
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.walls import NO_NECK, walls_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.quality.crossings import Pierced
    from balloon_usd.solver.frame import Frame

MOST_DEPTHS = 128
"""Vertices whose depth is measured, each against all walls."""


def crossings_of(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> dict[str, dict[str, Any]]:
    """Return the crossings of a frame and their depth, as results by the keys of measures."""
    walls = walls_of(plan, meshes)
    points = np.concatenate(frame.points).astype(np.float64)
    pierced = pierced_triangles(points, walls.triangles, walls.faces)
    around = np.concatenate([pierced.edges, walls.faces[pierced.triangles]], axis=1)
    necks = walls.neck[around]
    in_neck = (necks[:, 0] != NO_NECK) & (necks == necks[:, :1]).all(axis=1)
    names = [bubble.name for bubble in plan.bubbles]
    own = walls.bubble_of_vertex[pierced.edges[:, 0]]
    both = np.sort(np.stack([own, walls.bubble_of_triangle[pierced.triangles]], axis=1), axis=1)[~in_neck]
    counts = Counter((names[a], names[b]) for a, b in both.tolist())
    told = {
        "in_necks": int(in_neck.sum()),
        "bubbles": [{"pair": list(pair), "count": count} for pair, count in counts.most_common()],
    }
    depth = deepest(points, walls.triangles, _ends(pierced, ~in_neck))
    return {
        "crossings": MEASURES["crossings"].result(len(both), told),
        "depth": MEASURES["depth"].result(depth),
    }


def _ends(pierced: Pierced, of_these: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the ends of edges that pierce faces, those that reach farthest behind them first."""
    order = np.argsort(-pierced.behind[of_these], kind="stable")
    ends = pierced.edges[of_these][order].ravel()
    _, first = np.unique(ends, return_index=True)
    return ends[np.sort(first)][:MOST_DEPTHS]
