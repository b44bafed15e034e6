"""`balloon-usd bench`: how fast the solver is here."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.device import device_option, start_device
from balloon_usd.cli.failure import EXIT_CODES_HELP
from balloon_usd.cli.run import DETAILS

if TYPE_CHECKING:
    from balloon_usd.plan import Plan

MOST_COPIES = 65_536
MODELS = ("latex", "kosaka")

CLASSIC_DOG = """\
format: 1
name: dog
units: cm
balloons:
  main: {size: 260, tail: 10}
steps:
  - bubbles: {nose: 10, left_ear: 10, right_ear: 10}
  - lock: [left_ear, right_ear]
    point: up
  - bubbles: {neck: 7, left_foreleg: 12, right_foreleg: 12}
  - lock: [left_foreleg, right_foreleg]
    point: down
  - bubbles: {body: 15, left_hindleg: 12, right_hindleg: 12}
  - lock: [left_hindleg, right_hindleg]
    point: down
  - rest: tail
"""
"""What is measured; it stays the same from version to version, whatever the shipped recipes become."""

EXPERIMENT = """\
format: 1
name: experiment
units: cm
balloons:
  main: {{size: 260, capsule: {length:g}}}
steps:
  - wait: 60
physics: {{model: kosaka}}
"""
"""The thesis's capsule of springs and air particles (Kosaka 2008, 4.1), and longer ones."""
LENGTHS = (20.0, 40.0, 80.0, 150.0)
"""Lengths of capsules that are measured, cm: the thesis's up to a whole 260."""
KOSAKA_FRAMES = 481
"""Frames of a capsule that are measured unless others are asked for: 20 s, mostly with the air at rest."""


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

    @property
    def rate(self) -> float:
        """Frames of all copies per second."""
        return self.copies * self.frames / self.seconds

    @property
    def cost(self) -> float:
        """Time for one vertex or particle in one substep (ns)."""
        points = (self.vertices + self.particles) * self.frames * self.substeps
        return 1e9 * self.seconds / points


@click.command(epilog=EXIT_CODES_HELP)
@click.option("--model", type=click.Choice(MODELS), default="latex", show_default=True)
@click.option("--detail", type=click.Choice(DETAILS), default="draft", show_default=True)
@click.option(
    "--copies",
    type=click.IntRange(1, MOST_COPIES),
    multiple=True,
    default=(1,),
    show_default=True,
    help="Sculptures that advance together; give it several times to compare.",
)
@click.option(
    "--frames", type=click.IntRange(3), help="Stop after so many frames. Default: a whole animation."
)
@device_option
def bench(model: str, detail: str, copies: tuple[int, ...], frames: int | None, device: str) -> None:
    """Measure the solver without writing anything.

    Of the latex model the classic dog, of the kosaka model the capsule of the thesis's experiment and longer
    ones, up to a whole 260.
    """
    used = start_device(device)
    what = "classic dog" if model == "latex" else "capsules"
    click.echo(f"{what}, {model}, {detail} on {used}")
    columns = ("copies", "vertices", "particles", "substeps", "set-up s", "frames", "frames/s", "real time")
    click.echo(
        f"{what[:-1] if model == 'kosaka' else '':>10}" + "".join(f"{c:>11}" for c in columns) + "    ns each"
    )
    for name, plan in _cases(model):
        most = frames or (KOSAKA_FRAMES if model == "kosaka" else None)
        for count in copies:
            click.echo(_row(_measure(name, plan, count, detail, used, most)))


def _row(timing: Timing) -> str:
    return (
        f"{timing.name:>10}{timing.copies:>11}{timing.vertices:>11}{timing.particles:>11}{timing.substeps:>11}"
        f"{timing.setup:>11.2f}{timing.frames:>11}{timing.rate:>11.1f}{timing.rate / timing.fps:>10.2f}x"
        f"{timing.cost:>11.1f}"
    )


def _cases(model: str) -> list[tuple[str, Plan]]:
    """Plans that are measured, with their names."""
    from balloon_usd.plan import plan  # noqa: PLC0415
    from balloon_usd.recipe import Recipe  # noqa: PLC0415

    if model == "latex":
        return [("dog", plan(Recipe.parse(CLASSIC_DOG, "classic dog")))]
    return [
        (f"{length:g} cm", plan(Recipe.parse(EXPERIMENT.format(length=length), "capsule")))
        for length in LENGTHS
    ]


def _measure(name: str, plan: Plan, copies: int, detail: str, device: str, most: int | None) -> Timing:
    """Simulate copies of a plan and time what comes after the second frame, which compiles and records."""
    from balloon_usd.solver.simulation import simulate_many  # noqa: PLC0415

    begin = time.perf_counter()
    simulation = simulate_many([plan] * copies, detail=detail, device=device)
    frames = simulation.frames()
    (first, *_) = next(frames)
    next(frames)
    ready = time.perf_counter()
    count = min(most or simulation.frame_counts[0], simulation.frame_counts[0])
    for _ in range(count - 2):
        next(frames)
    seconds = time.perf_counter() - ready
    vertices = sum(len(mesh.points) for meshes in simulation.meshes for mesh in meshes)
    particles = copies * sum(len(air) for air in getattr(first, "air", ()))
    return Timing(
        name,
        copies,
        vertices,
        particles,
        simulation.substeps,
        ready - begin,
        count - 2,
        seconds,
        plan.recipe.fps,
    )
