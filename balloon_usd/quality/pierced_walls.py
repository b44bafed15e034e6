"""Walls that pierce each other in one frame: how often, in which bubbles, how deep."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.quality.depth import deepest
from balloon_usd.quality.walls import NO_NECK

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.quality.crossings import Pierced
    from balloon_usd.quality.walls import Walls

MOST_DEPTHS = 128
"""Vertices whose depth is measured, each against all walls."""

Pair = tuple[str, str]


@dataclass(frozen=True)
class Crossings:
    """The crossings of one frame: pairs of an edge and a face that it pierces."""

    count: int
    """Those in no neck."""
    in_necks: int
    """Those between rubber that is folded up in the neck of one joint."""
    pairs: Mapping[Pair, int]
    """The former by the two bubbles, the most first; a bubble may cross itself."""


def crossings_in(walls: Walls, pierced: Pierced) -> Crossings:
    """Return the crossings of walls, from the edges and triangles of one frame."""
    outside = _outside_necks(walls, pierced)
    own = walls.bubble_of_vertex[pierced.edges[:, 0]]
    both = np.sort(np.stack([own, walls.bubble_of_triangle[pierced.triangles]], axis=1), axis=1)[outside]
    pairs = Counter((walls.names[a], walls.names[b]) for a, b in both.tolist())
    return Crossings(len(both), len(outside) - len(both), dict(pairs.most_common()))


def folded_in_necks(walls: Walls, pierced: Pierced) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the edges, (P, 2) vertices, that pierce faces in the neck of one joint, and the joint, (P,)."""
    edges = pierced.edges[~_outside_necks(walls, pierced)]
    return edges, walls.neck[edges[:, 0]]


def depth_in(walls: Walls, pierced: Pierced, points: NDArray[np.float64]) -> float:
    """Return how deep the deepest vertex at a crossing in no neck lies inside a wall, m; `points`: (V, 3)."""
    return deepest(points, walls.triangles, _ends(pierced, _outside_necks(walls, pierced)))


def _outside_necks(walls: Walls, pierced: Pierced) -> NDArray[np.bool_]:
    """Tell which pairs have not all their corners in the neck of one joint."""
    around = walls.quads[pierced.triangles % len(walls.quads)]
    necks = walls.neck[np.concatenate([pierced.edges, around], axis=1)]
    return np.asarray((necks[:, 0] == NO_NECK) | (necks != necks[:, :1]).any(axis=1))


def _ends(pierced: Pierced, of_these: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the ends of edges that pierce faces, those that reach farthest behind them first."""
    order = np.argsort(-pierced.behind[of_these], kind="stable")
    ends = pierced.edges[of_these][order].ravel()
    _, first = np.unique(ends, return_index=True)
    return ends[np.sort(first)][:MOST_DEPTHS]
