"""Timing a simulation from its third frame on: the first two compile and record."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver import simulation as solver
from balloon_usd.solver.frame import Frame

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.snapshot import Outcome

UNTIMED = 2
"""Frames before the clock runs."""


@dataclass(frozen=True)
class Timing:
    """One measurement."""

    name: str
    copies: int
    vertices: int
    """Of all copies."""
    particles: int
    """Of all copies; 0 where the air is no particles."""
    substeps: int
    """In one frame."""
    setup: float
    """From the plan to the second frame, with compiling on a first run (s)."""
    frames: int
    """Frames of one copy that were timed."""
    seconds: float
    """Time that they took (s)."""
    fps: float
    crossings: int
    """In the last frame, of all figures that differ: walls that pierce walls, but for those in necks."""

    @property
    def rate(self) -> float:
        """Frames of all copies per second."""
        return self.copies * self.frames / self.seconds

    @property
    def substep(self) -> float:
        """Time for one substep of all copies (us)."""
        return 1e6 * self.seconds / (self.frames * self.substeps)

    @property
    def cost(self) -> float:
        """Time for one vertex or particle in one substep (ns)."""
        return 1e3 * self.substep / (self.vertices + self.particles)


def planned(text: str) -> Plan:
    """Return the plan of a recipe that is measured."""
    return plan(Recipe.parse(text, "what is measured"))


def measure(
    name: str,
    plans: Sequence[Plan],
    detail: str,
    device: str,
    most: int | None,
    threads: int | None = None,
) -> Timing:
    """Simulate plans together, no more than `most` frames, and time what comes after the second.

    `threads`: of a CPU at most, one for each of its cores if absent.
    """
    begin = time.perf_counter()
    simulation = solver.simulate_many(plans, detail=detail, device=device, threads=threads)
    frames = simulation.frames()
    first = next(frames)
    next(frames)
    ready = time.perf_counter()
    count = min(most or max(simulation.frame_counts), *simulation.frame_counts)
    last = first
    for _ in range(count - UNTIMED):
        last = next(frames)
    seconds = time.perf_counter() - ready
    crossings = _crossings(plans, simulation.meshes, last)
    vertices = sum(len(mesh.points) for meshes in simulation.meshes for mesh in meshes)
    particles = sum(len(air) for frame in first for air in getattr(frame, "air", ()))
    return Timing(
        name,
        len(plans),
        vertices,
        particles,
        simulation.substeps,
        ready - begin,
        count - UNTIMED,
        seconds,
        plans[0].recipe.fps,
        crossings,
    )


def _crossings(
    plans: Sequence[Plan], meshes: Sequence[Sequence[BalloonMesh]], frames: Sequence[Outcome]
) -> int:
    """Count the crossings of each figure once: copies of one have the same."""
    seen = {id(plan): place for place, plan in enumerate(plans)}
    found = 0
    for place in seen.values():
        frame = frames[place]
        if isinstance(frame, Frame):
            walls = walls_of(plans[place], meshes[place])
            found += CrossingCounter(walls, 1).count(frame.points).count
    return found
