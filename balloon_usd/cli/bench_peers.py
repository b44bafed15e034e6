"""What `balloon-usd bench --peer` prints: one task for every solver."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import PinchRun, PinchTask

VERTICES = ("1602", "6402", "25602")
PINCHES = ("fingers", "one ring")
"""How wide the tube is pinched."""
NAMES = ("newton", "blender")
NONE = "none"


def peer_names(_context: click.Context, _option: click.Parameter, text: str | None) -> tuple[str, ...] | None:
    """Read the names of peers, parted by commas.

    Raises:
        click.BadParameter: one of them is unknown.
    """
    if text is None:
        return None
    names = tuple(dict.fromkeys(name.strip() for name in text.split(",")))
    for name in names:
        if name not in (*NAMES, NONE):
            raise click.BadParameter(f'"{name}" is no peer, expected {" or ".join((*NAMES, NONE))}')
    return tuple(name for name in names if name != NONE)


def expect_installed(names: tuple[str, ...]) -> None:
    """Expect peers to be installed; raises `Failure` where one is not."""
    from balloon_usd.bench.peers import HOW_TO_INSTALL, PEERS  # noqa: PLC0415

    missing = [name for name in names if not PEERS[name].installed]
    if missing:
        verb = "is" if len(missing) == 1 else "are"
        raise Failure(f"{' and '.join(missing)} {verb} not installed: {HOW_TO_INSTALL}", ExitCode.BAD_INPUT)


def bench_peers(names: tuple[str, ...], vertices: int, pinch: str, device: str) -> None:
    """Pinch and twist the tube with our solver, with twice its substeps, and with the peers on the CPU.

    `pinch`: one of `PINCHES`.

    Raises:
        Failure: a peer is not installed; nothing was run.
    """
    from balloon_usd.bench.machine import machine  # noqa: PLC0415
    from balloon_usd.bench.peers import PEERS  # noqa: PLC0415
    from balloon_usd.bench.pinch_ours import run_ours, substeps_for  # noqa: PLC0415
    from balloon_usd.bench.pinch_task import FINGERS, PinchTask  # noqa: PLC0415

    expect_installed(names)
    task = PinchTask(vertices, FINGERS if pinch == PINCHES[0] else 0.0)
    what = f"pinch by {pinch} and one turn, {vertices} vertices, {task.frames} frames"
    click.echo(f"{what} on {machine(device)}")
    columns = ("substeps", "ms/frame", "CPU ms", "volume", "neck mm", "turns", "crossings")
    click.echo(f"{'':>14}" + "".join(f"{column:>11}" for column in columns) + "  promised")
    steps = substeps_for(task)
    for factor in (1, 2):
        name = "balloon_usd" if factor == 1 else "twice as fine"
        _print_row(name, task, run_ours(task, factor * steps, device), promised=factor == 1)
    for name in names:
        _print_row(PEERS[name].title, task, PEERS[name].pinch(task), promised=False)


def _print_row(name: str, task: PinchTask, run: PinchRun, *, promised: bool) -> None:
    from balloon_usd.bench.pinch_shape import shape_of  # noqa: PLC0415
    from balloon_usd.bench.targets import CROSSINGS, PINCH  # noqa: PLC0415

    shape = shape_of(task, run)
    row = (
        f"{name:>14}{run.substeps:>11}{run.wall_ms:>11.2f}{run.cpu_ms:>11.2f}{shape.volume_ratio:>11.4f}"
        f"{1e3 * shape.neck:>11.2f}{shape.turns:>11.2f}{shape.crossings:>11}"
    )
    if promised and task.vertices == int(VERTICES[0]):
        row += f"  {PINCH.beside(run.cpu_ms)}; {CROSSINGS.beside(shape.crossings)}"
    click.echo(row)
