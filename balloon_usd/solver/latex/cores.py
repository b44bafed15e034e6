"""Cores of wound necks: how thin the rubber of every ring packs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.flatten import Arrays
    from balloon_usd.solver.latex.body import LatexBody


def core_radii(body: LatexBody) -> NDArray[np.float64]:
    """Return the radius to which the unstressed rubber of every ring of a balloon's mesh packs, (R,), m."""
    corners, vertices = body.quads.reshape(-1), len(body.points)
    count = np.bincount(corners, minlength=vertices)
    thickness = np.bincount(corners, np.repeat(body.thickness, 4), vertices) / np.maximum(count, 1)
    sections = []
    for first, around in body.mesh_rings:
        ring = body.rest[first : first + around]
        girth = float(np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1).sum())
        sections.append(girth * float(thickness[first : first + around].mean()))
    return np.sqrt(np.array(sections) / math.pi)


def row_lengths(body: LatexBody) -> NDArray[np.float64]:
    """Return the unstressed distance from every ring of a mesh to the next, (R,), m; 0 for the last."""
    middle = np.array([body.rest[first : first + around].mean(axis=0) for first, around in body.mesh_rings])
    return np.append(np.linalg.norm(np.diff(middle, axis=0), axis=1), 0.0)


def core_arrays(bodies: Sequence[LatexBody], by_world: Callable[[NDArray[Any]], NDArray[np.int32]]) -> Arrays:
    """Return the rings of all balloons that pack, in order along them, with their cores and distances.

    `by_world`: gives the first thing of every sculpture, of those of every body, see `FlatBodies`.
    """
    ring_start = np.concatenate([[0], np.cumsum([len(b.mesh_rings) for b in bodies])])
    counts = [len(b.mesh_rings) if b.packs else 0 for b in bodies]
    rings = [ring_start[k] + np.arange(count) for k, count in enumerate(counts)]
    packing = [b for b in bodies if b.packs]
    rows = [row_lengths(b) for b in packing]
    # Device arrays are never empty: the last entry belongs to no balloon.
    return {
        "core_ring": np.concatenate([*rings, [0]]).astype(np.int32),
        "core_next": np.concatenate([*(row > 0.0 for row in rows), [False]]).astype(np.int32),
        "core_radius": np.concatenate([*map(core_radii, packing), [0.0]]).astype(np.float32),
        "core_row": np.concatenate([*rows, [0.0]]).astype(np.float32),
        "world_core": by_world(np.concatenate([[0], np.cumsum(counts)])),
    }
