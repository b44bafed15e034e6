"""One balloon, blown up to several widths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

RECIPE = """
format: 1
name: blown_up
units: cm
balloons:
  one: {{size: {size}, inflated: {width}}}
steps:
  - {{rest: bubble, balloon: one}}
physics: {{hold: 0.5}}
"""


def blown_up(size: str, widths: Sequence[float | str]) -> list[tuple[Plan, BalloonMesh, Frame]]:
    """Return plan, mesh and last frame of a balloon of a size for each width, cm, or what stands in its place."""
    plans = [plan(Recipe.parse(RECIPE.format(size=size, width=width))) for width in widths]
    simulation = simulate_many(plans, detail="preview", device="cpu")
    meshes = [each[0] for each in simulation.meshes]
    *_, last = simulation.frames()
    return list(zip(plans, meshes, last, strict=True))
