"""The vertices of each bubble of a sculpture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan

Vertices = tuple[int, "NDArray[np.int32]"]
"""A balloon by its place in `Plan.strips`, and vertices of its mesh."""


def vertices_of_bubbles(plan: Plan, meshes: Sequence[BalloonMesh]) -> dict[str, Vertices]:
    """Return the vertices of every bubble, by its name."""
    return {
        bubble.name: (balloon, np.unique(mesh.quads[mesh.quad_bubble == index]))
        for balloon, (strip, mesh) in enumerate(zip(plan.strips.values(), meshes, strict=True))
        for index, bubble in enumerate(strip.bubbles)
    }
