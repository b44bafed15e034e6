"""What `balloon-usd bench --batch` prints: whole runs, from recipes to verified stages on disk."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from balloon_usd.bench.batch_run import BatchRun
    from balloon_usd.bench.targets import Target

COLUMNS = ("recipes", "jobs", "frames", "seconds", "on disk/s", "first s", "steady/s", "solver/s", "share")
FRAMES_ON_CPU = 96
"""Frames of each recipe that are made on a CPU unless others are asked for: four seconds of animation."""


def bench_batch(copies: tuple[int, ...], detail: str, device: str, frames: int | None) -> None:
    """Print how fast whole runs put frames on disk, beside the speed of the solver alone."""
    from balloon_usd.bench.batch_run import RunFailed  # noqa: PLC0415
    from balloon_usd.bench.machine import cores, machine  # noqa: PLC0415

    click.echo(f"classic dogs from recipes to verified stages, latex, {detail}, on {machine(device)}")
    heads = "".join(f"{column:>11}" for column in (*COLUMNS, "memory GB", "MB a dog"))
    click.echo(f"{heads}  promised")
    try:
        if device == "cpu":
            _on_cpu(cores(), copies, detail, frames or FRAMES_ON_CPU)
        else:
            _on_gpu(copies, detail, device, frames)
    except RunFailed as error:
        raise Failure(str(error), ExitCode.SIMULATION_FAILED) from error


def _on_cpu(cores: int, copies: tuple[int, ...], detail: str, frames: int) -> None:
    """Compare one core with all: each is as fast alone as beside the others."""
    from balloon_usd.bench.batch_run import batch_run  # noqa: PLC0415
    from balloon_usd.bench.targets import CORES_SHARE, TIMES, Target  # noqa: PLC0415

    solver = _solver_alone(1, detail, "cpu", frames)
    for count in copies:
        recipes = count if count > 1 else 2 * cores
        one = batch_run(recipes, detail, "cpu", jobs=1, frames=frames)
        _print(one, 1, solver, None, 0.0)
        if cores > 1:
            many = batch_run(recipes, detail, "cpu", jobs=cores, frames=frames)
            target = Target(CORES_SHARE * cores, TIMES)
            _print(many, cores, solver * cores, target, many.steady / one.steady)


def _on_gpu(copies: tuple[int, ...], detail: str, device: str, frames: int | None) -> None:
    from balloon_usd.bench.batch_run import batch_run  # noqa: PLC0415
    from balloon_usd.bench.machine import cores  # noqa: PLC0415
    from balloon_usd.bench.targets import BATCH, BATCH_ON_DISK, DOG_ON_DISK  # noqa: PLC0415

    for count in copies:
        solver = _solver_alone(count, detail, device, frames)
        run = batch_run(count, detail, device, jobs=None, frames=frames)
        target, value = {1: (DOG_ON_DISK, run.steady), BATCH: (BATCH_ON_DISK, run.rate)}.get(
            count, (None, 0.0)
        )
        _print(run, cores(), solver, target if detail == "draft" else None, value)


def _solver_alone(copies: int, detail: str, device: str, frames: int | None) -> float:
    """Return the frames per second of one thread of the solver in this process, which writes nothing."""
    from balloon_usd.bench.bench_recipes import CLASSIC_DOG  # noqa: PLC0415
    from balloon_usd.bench.timing import measure, planned  # noqa: PLC0415

    return measure("dog", [planned(CLASSIC_DOG)] * copies, detail, device, frames, threads=1).rate


def _print(run: BatchRun, jobs: int, solver: float, target: Target | None, value: float) -> None:
    told = f"  {target.beside(value)}" if target else ""
    click.echo(
        f"{run.recipes:>11}{jobs:>11}{run.frames:>11}{run.seconds:>11.2f}{run.rate:>11.1f}{run.first:>11.2f}"
        f"{run.steady:>11.1f}{solver:>11.1f}{run.rate / solver:>11.2f}{run.memory / 1e9:>11.2f}"
        f"{run.size / run.recipes / 1e6:>11.2f}{told}"
    )
