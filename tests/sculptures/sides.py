"""Which bubbles of a figure lie on its left, by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame
    from balloon_usd.solver.simulation import Simulation

TAIL_FIRST = ("elephant_ess", "kissing_poodles/her")
"""Figures that are made from their tails on and so face +x, some of them one of several in a recipe."""


def pairs(plan: Plan) -> Iterator[tuple[str, str, float]]:
    """Yield the bubbles of a plan that are called left and right of the same, and the sign of y on the left."""
    names = {bubble.name for bubble in plan.bubbles}
    for name in sorted(names):
        words = name.split("_")
        if "left" in words:
            other = "_".join("right" if word == "left" else word for word in words)
            backwards = {plan.recipe.name, f"{plan.recipe.name}/{words[0]}"} & set(TAIL_FIRST)
            assert other in names, name
            yield name, other, 1.0 if backwards else -1.0


def middle_of(simulation: Simulation, frame: Frame, bubble: str) -> np.ndarray:
    """Return the middle of the walls of a bubble, (3,), m."""
    for points, mesh, strip in zip(
        frame.points, simulation.meshes[0], simulation.plans[0].strips.values(), strict=True
    ):
        names = [each.name for each in strip.bubbles]
        if bubble in names:
            quads = mesh.quads[mesh.quad_bubble == names.index(bubble)]
            return np.asarray(points[quads.reshape(-1)].astype(float).mean(axis=0))
    raise KeyError(bubble)
