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


@dataclass(frozen=True)
class Timing:
    """One measurement."""

    copies: int
    vertices: int
    """Of all copies."""
    setup: float
    """From the plan to the first frame, with compiling on a first run (s)."""
    frames: int
    """Frames of one copy after the first."""
    seconds: float
    """Time that they took (s)."""
    fps: float

    @property
    def rate(self) -> float:
        """Frames of all copies per second."""
        return self.copies * self.frames / self.seconds


@click.command(epilog=EXIT_CODES_HELP)
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
    "--frames", type=click.IntRange(2), help="Stop after so many frames. Default: the whole animation."
)
@device_option
def bench(detail: str, copies: tuple[int, ...], frames: int | None, device: str) -> None:
    """Measure the solver on the classic dog, without writing anything."""
    used = start_device(device)
    from balloon_usd.plan import plan  # noqa: PLC0415
    from balloon_usd.recipe import Recipe  # noqa: PLC0415

    dog = plan(Recipe.parse(CLASSIC_DOG, "classic dog"))
    click.echo(f"classic dog, {detail} on {used}")
    click.echo(
        f"{'copies':>7} {'vertices':>9} {'set-up s':>9} {'frames':>7} {'frames/s':>9} {'real time':>10}"
    )
    for count in copies:
        timing = _measure(dog, count, detail, used, frames)
        click.echo(
            f"{timing.copies:>7} {timing.vertices:>9} {timing.setup:>9.2f} {timing.frames:>7} "
            f"{timing.rate:>9.1f} {timing.rate / timing.fps:>9.2f}x"
        )


def _measure(dog: Plan, copies: int, detail: str, device: str, most: int | None) -> Timing:
    """Simulate copies of a plan and time what comes after the first frame."""
    from balloon_usd.solver.simulation import simulate_many  # noqa: PLC0415

    begin = time.perf_counter()
    simulation = simulate_many([dog] * copies, detail=detail, device=device)
    frames = simulation.frames()
    next(frames)
    ready = time.perf_counter()
    count = min(most or simulation.frame_counts[0], simulation.frame_counts[0])
    for _ in range(count - 1):
        next(frames)
    seconds = time.perf_counter() - ready
    vertices = sum(len(mesh.points) for meshes in simulation.meshes for mesh in meshes)
    return Timing(copies, vertices, ready - begin, count - 1, seconds, dog.recipe.fps)
