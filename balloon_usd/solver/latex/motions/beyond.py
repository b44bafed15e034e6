"""What lies beyond a ring, on its balloon and on those that hang on it, and so turns with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.sculpture import LatexSculpture

    Ints = NDArray[np.int64]

CLEAR = 1e-6
"""What lies farther than this beyond a ring turns with the balloon, m."""


def beyond_on_its_balloon(sculpture: LatexSculpture, ring: int) -> Ints:
    """Return the vertices of the scene that lie beyond a ring of the plan on its own balloon."""
    planned = sculpture.plan.table.rings[ring]
    body = sculpture.body[planned.balloon]
    found = np.flatnonzero(sculpture.scene.bodies[body].along > planned.along + CLEAR)
    return found + int(sculpture.scene.vertex_start[body])


def beyond_on_others(sculpture: LatexSculpture, ring: int) -> Ints:
    """Return the vertices of the scene on other balloons that hang on what lies beyond a ring of the plan.

    A balloon that hangs on both sides of the ring, or on the ring itself, is not among them.
    """
    rings = sculpture.plan.table.rings
    # The next ring only guides and is in no weld: a balloon hangs on it as a whole, or not at all.
    _, hanging = sculpture.rings_hanging_on((ring, ring + 1))
    bodies = sorted(
        {sculpture.body[rings[k].balloon] for k in hanging} - {sculpture.body[rings[ring].balloon]}
    )
    start = sculpture.scene.vertex_start
    return np.concatenate([np.arange(0), *(np.arange(start[body], start[body + 1]) for body in bodies)])


def vertices_at(sculpture: LatexSculpture, rings: tuple[int, ...]) -> Ints:
    """Return the vertices of the scene that lie at some rings of the plan or in bubbles beside them."""
    table, scene, chosen = sculpture.plan.table.rings, sculpture.scene, set(rings)
    found = [np.arange(0)]
    for balloon in {table[ring].balloon for ring in rings}:
        body = sculpture.body[balloon]
        own = [k for k, ring in enumerate(table) if ring.balloon == balloon]
        places = np.array([table[ring].along for ring in own])
        inside = np.array([False, *(ring in chosen for ring in own), False])
        along = scene.bodies[body].along
        before, after = (np.searchsorted(places, along + off) for off in (-CLEAR, CLEAR))
        # Beside no ring both are the same, and the bubble goes with either ring beside it.
        at_ring = inside[after]
        between = inside[before] | inside[np.minimum(before + 1, len(own) + 1)]
        turns = np.where(after > before, at_ring, between)
        found.append(np.flatnonzero(turns) + int(scene.vertex_start[body]))
    return np.concatenate(found)
