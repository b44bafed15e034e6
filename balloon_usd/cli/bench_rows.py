"""What `balloon-usd bench` prints of our own solver."""

from __future__ import annotations

import math
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.bench.stage_files import Chore
    from balloon_usd.bench.timing import Timing
    from balloon_usd.plan import Plan

KOSAKA_FRAMES = 481
"""Frames of a capsule that are measured unless others are asked for: 20 s, mostly with the air at rest."""
COLUMNS = (
    "copies",
    "vertices",
    "particles",
    "substeps",
    "set-up s",
    "frames",
    "frames/s",
    "real time",
    "ns each",
    "us/substep",
    "crossings",
    "x one",
)


def bench_table(
    model: str,
    detail: str,
    copies: tuple[int, ...],
    device: str,
    frames: int | None,
    threads: int | None,
) -> None:
    """Print a row for every case and number of copies."""
    from balloon_usd.bench.timing import measure  # noqa: PLC0415

    what = "classic dog" if model == "latex" else "capsules"
    _title(f"{what}, {model}, {detail}", device)
    _heads(what[:-1] if model == "kosaka" else "")
    for name, plan in _cases(model):
        most = frames or (KOSAKA_FRAMES if model == "kosaka" else None)
        measured: dict[int, Timing] = {}
        for count in copies:
            timing = measured[count] = measure(name, [plan] * count, detail, device, most, threads)
            click.echo(_row(timing, measured.get(1)) + _target(model, detail, timing, measured, device))


def bench_mixed(detail: str, device: str, frames: int | None) -> None:
    """Print what different recipes cost alone and together."""
    from balloon_usd.bench.mixed import mixed_timings  # noqa: PLC0415
    from balloon_usd.bench.targets import MIXED_COST  # noqa: PLC0415

    _title(f"different recipes, latex, {detail}", device)
    _heads("")
    alone, whole = mixed_timings(detail, device, frames)
    for timing in (*alone, whole):
        click.echo(_row(timing, None))
    ratio = whole.seconds / sum(timing.seconds for timing in alone)
    click.echo(f"together they take {ratio:.2f} x what they take alone  {MIXED_COST.beside(ratio)}")


def bench_first_frame(detail: str, device: str) -> None:
    """Print how long processes take to their first frame."""
    from balloon_usd.bench.first_frame import starts  # noqa: PLC0415
    from balloon_usd.bench.targets import COMPILING, FIRST_FRAME  # noqa: PLC0415

    _title(f"first frame, latex, {detail}", device)
    click.echo(f"{'':>20}{'seconds':>11}{'compiled':>11}  promised")
    with _children():
        cold, *warm = starts(detail, device)
    cuda = device.startswith("cuda")
    click.echo(
        _start(cold.name, cold.seconds, cold.compiled) + ("" if cuda else COMPILING.beside(cold.seconds))
    )
    for start in warm:
        again = "nothing" if start.compiled == 0 else f"{start.compiled} modules"
        told = f"{FIRST_FRAME.beside(start.seconds)}, compiled {again} again"
        click.echo(_start(start.name, start.seconds, start.compiled) + told)


def bench_processes(count: int, detail: str, device: str, frames: int | None) -> None:
    """Print the throughput of processes side by side."""
    from balloon_usd.bench.machine import cores  # noqa: PLC0415
    from balloon_usd.bench.processes import together  # noqa: PLC0415
    from balloon_usd.bench.targets import PROCESSES_SHARE, TIMES, Target  # noqa: PLC0415

    _title(f"classic dog in processes of its own, latex, {detail}", device)
    click.echo(f"{'processes':>11}{'frames/s':>11}{'x one':>11}  promised")
    with _children():
        one, many = (together(number, detail, device, frames) for number in (1, count))
    click.echo(f"{1:>11}{one:>11.1f}{1.0:>11.2f}")
    target = Target(PROCESSES_SHARE * min(count, cores()), TIMES)
    told = target.beside(many / one) if device == "cpu" else ""
    click.echo(f"{count:>11}{many:>11.1f}{many / one:>11.2f}  {told}".rstrip())


def bench_stage(frames: int | None) -> None:
    """Print how long stages take to be written, checked and compared."""
    from balloon_usd.bench.stage_files import FRAMES, PART, stage_chores  # noqa: PLC0415
    from balloon_usd.bench.targets import READING, WRITING  # noqa: PLC0415

    count = frames or FRAMES
    few, many = stage_chores(max(1, count // PART)), stage_chores(count)
    _title(f"stages of {many.vertices} vertices and {many.frames} frames", "cpu")
    click.echo(f"{'':>20}{'seconds':>11}{'MB':>11}{'MB/s':>11}{'memory MB':>11}  promised")
    ratio = many.write.seconds / many.plain.seconds
    click.echo(_chore(many.plain))
    click.echo(
        _chore(many.write) + f"{ratio:.2f} x plain  {WRITING.beside(ratio)}" + _kept(many.write, few.write)
    )
    click.echo(_chore(many.check) + READING.beside(many.check.seconds) + _kept(many.check, few.check))
    if many.with_nvidia:
        click.echo(_chore(many.with_nvidia) + READING.beside(many.with_nvidia.seconds))
    click.echo(_chore(many.diff) + READING.beside(many.diff.seconds) + _kept(many.diff, few.diff))


def _chore(chore: Chore) -> str:
    size = chore.size / 1e6
    return (
        f"{chore.name:>20}{chore.seconds:>11.2f}{size:>11.0f}{size / chore.seconds:>11.0f}"
        f"{chore.memory / 1e6:>11.0f}  "
    )


def _kept(chore: Chore, part: Chore) -> str:
    """Say whether memory stayed that of a tenth of the frames, where memory is known."""
    from balloon_usd.bench.targets import MEMORY  # noqa: PLC0415

    return "" if math.isnan(chore.memory) else f", {MEMORY.beside(chore.memory / part.memory)}"


@contextmanager
def _children() -> Iterator[None]:
    """Tell in one line when a process that is measured has failed."""
    from balloon_usd.bench.child import ChildError  # noqa: PLC0415

    try:
        yield
    except ChildError as error:
        raise Failure(str(error), ExitCode.SIMULATION_FAILED) from error


def _title(what: str, device: str) -> None:
    from balloon_usd.bench.machine import machine  # noqa: PLC0415

    click.echo(f"{what} on {machine(device)}")


def _heads(first: str) -> None:
    click.echo(f"{first:>10}" + "".join(f"{column:>11}" for column in COLUMNS) + "  promised")


def _row(timing: Timing, one: Timing | None) -> str:
    times = f"{timing.rate / one.rate:.2f}" if one else "-"
    return (
        f"{timing.name:>10}{timing.copies:>11}{timing.vertices:>11}{timing.particles:>11}{timing.substeps:>11}"
        f"{timing.setup:>11.2f}{timing.frames:>11}{timing.rate:>11.1f}{timing.rate / timing.fps:>10.2f}x"
        f"{timing.cost:>11.1f}{timing.substep:>11.1f}{timing.crossings:>11}{times:>11}"
    )


def _target(model: str, detail: str, timing: Timing, measured: Mapping[int, Timing], device: str) -> str:
    from balloon_usd.bench.targets import target_of  # noqa: PLC0415

    told = target_of(model, detail, timing, measured, cuda=device.startswith("cuda"))
    return f"  {told}" if told else ""


def _start(name: str, seconds: float, compiled: int) -> str:
    return f"{name:>20}{seconds:>11.2f}{compiled:>11}  "


def _cases(model: str) -> list[tuple[str, Plan]]:
    """Plans that are measured, with their names."""
    from balloon_usd.bench.bench_recipes import CLASSIC_DOG, EXPERIMENT, LENGTHS  # noqa: PLC0415
    from balloon_usd.bench.timing import planned  # noqa: PLC0415

    if model == "latex":
        return [("dog", planned(CLASSIC_DOG))]
    return [(f"{length:g} cm", planned(EXPERIMENT.format(length=length))) for length in LENGTHS]
