"""What `balloon-usd bench --crowd` prints: tubes that are turned into a rope, and what goes through what."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from balloon_usd.cli.bench_peers import expect_installed

if TYPE_CHECKING:
    from balloon_usd.bench.crowd_task import CrowdRun, CrowdTask

COLUMNS = ("substeps", "ms/frame", "CPU ms", "volume", "frames", "most", "last")
"""The last three tell of crossings: frames that have any, the most in one, and those in the last."""


def bench_crowd(names: tuple[str, ...], device: str) -> None:
    """Turn the crowd with our solver, with walls that touch and without, and with the peers on the CPU.

    Raises:
        Failure: a peer is not installed; nothing was run.
    """
    from balloon_usd.bench.crowd_ours import run_ours  # noqa: PLC0415
    from balloon_usd.bench.crowd_task import TUBES, CrowdTask  # noqa: PLC0415
    from balloon_usd.bench.machine import machine  # noqa: PLC0415
    from balloon_usd.bench.peers import PEERS  # noqa: PLC0415

    expect_installed(names)
    task = CrowdTask()
    what = f"{TUBES} tubes turned by half a turn, {len(task.points)} vertices, {task.frames} frames"
    click.echo(f"{what} on {machine(device)}")
    click.echo(f"{'':>16}" + "".join(f"{column:>10}" for column in COLUMNS) + "  promised")
    _print_row("balloon_usd", task, run_ours(task, device), promised=True)
    _print_row("without contact", task, run_ours(task, device, contact=False), promised=False)
    for name in names:
        _print_row(PEERS[name].crowd_title, task, PEERS[name].crowd(task), promised=False)


def _print_row(name: str, task: CrowdTask, run: CrowdRun, *, promised: bool) -> None:
    from balloon_usd.bench.pierced import pierced_triangles  # noqa: PLC0415
    from balloon_usd.bench.pinch_shape import volume  # noqa: PLC0415
    from balloon_usd.bench.targets import CROSSINGS  # noqa: PLC0415

    found = [pierced_triangles(points, task.triangles) for points in run.shapes]
    kept = volume(run.shapes[-1], task.triangles) / volume(task.points, task.triangles)
    row = (
        f"{name:>16}{run.substeps:>10}{run.wall_ms:>10.2f}{run.cpu_ms:>10.2f}{kept:>10.4f}"
        f"{sum(count > 0 for count in found):>10}{max(found):>10}{found[-1]:>10}"
    )
    click.echo(row + (f"  {CROSSINGS.beside(max(found))}" if promised else ""))
