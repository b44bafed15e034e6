"""Figures that are looked at in every frame."""

from __future__ import annotations

from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many


def watched(recipe: Recipe) -> QualityWatch:
    """Make a figure at draft detail and count its crossings in every frame."""
    planned = plan(recipe)
    simulation = simulate_many([planned], detail="draft", device="cpu")
    quality = QualityWatch(planned, simulation.meshes[0], range(1, planned.frame_count + 1))
    for (frame,) in simulation.frames():
        assert isinstance(frame, Frame), frame
        quality.add(frame)
    return quality


def crossings(quality: QualityWatch) -> dict[int, int]:
    """Pairs of crossing walls by the time code, of those frames that have any."""
    return {code: found.count for code, found in quality.crossings.frames.items() if found.count}
