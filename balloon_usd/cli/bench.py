"""`balloon-usd bench`: how fast the solver is here, with what is promised beside it."""

from __future__ import annotations

import click
from click.core import ParameterSource

from balloon_usd.cli.bench_batch import bench_batch
from balloon_usd.cli.bench_crowd import bench_crowd
from balloon_usd.cli.bench_peers import PINCHES, VERTICES, bench_peers, peer_names
from balloon_usd.cli.bench_rows import (
    bench_first_frame,
    bench_mixed,
    bench_processes,
    bench_stage,
    bench_table,
)
from balloon_usd.cli.device import compiling, device_option, start_device
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.run import DETAILS

MOST_COPIES = 65_536
MOST_PROCESSES = 1024
MODELS = ("latex", "kosaka")
TABLE = ("model", "detail", "copies", "frames", "threads")
"""Options of the table that is printed where nothing else is asked for."""
OPTIONS: dict[str, tuple[str, ...]] = {
    "mixed": ("detail", "frames"),
    "first_frame": ("detail",),
    "processes": ("detail", "frames"),
    "crowd": ("peers",),
    "peers": ("vertices", "pinch"),
    "stage": ("frames",),
    "batch": ("detail", "copies", "frames"),
}
"""Options of everything else that is measured."""


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
@click.option(
    "--threads",
    type=click.IntRange(1, MOST_PROCESSES),
    help="Threads of a CPU that may share the work. Default: one for each core, up to 16.",
)
@click.option("--mixed", is_flag=True, help="Different recipes together instead, against each alone.")
@click.option("--first-frame", is_flag=True, help="The start instead: with compiled kernels and without.")
@click.option(
    "--processes",
    type=click.IntRange(2, MOST_PROCESSES),
    help="So many processes at once instead, against one.",
)
@click.option("--stage", is_flag=True, help="Writing, checking and comparing stages instead.")
@click.option("--batch", is_flag=True, help="Whole runs instead, from recipes to verified stages on disk.")
@click.option(
    "--crowd",
    is_flag=True,
    help="Seven tubes turned into a rope instead, with what goes through what; with --peer beside others.",
)
@click.option(
    "--peer",
    "peers",
    callback=peer_names,
    metavar="newton,blender",
    help="Pinch and twist one tube instead, beside other solvers; needs the extra [peers]. "
    '"none" runs ours alone.',
)
@click.option(
    "--vertices",
    type=click.Choice(VERTICES),
    default=VERTICES[0],
    show_default=True,
    help="Of that tube.",
)
@click.option(
    "--pinch",
    type=click.Choice(PINCHES),
    default=PINCHES[0],
    show_default=True,
    help="What thins that tube: the width of fingers, or one ring of vertices.",
)
@device_option
def bench(
    model: str,
    detail: str,
    copies: tuple[int, ...],
    frames: int | None,
    threads: int | None,
    mixed: bool,
    first_frame: bool,
    processes: int | None,
    stage: bool,
    batch: bool,
    crowd: bool,
    peers: tuple[str, ...] | None,
    vertices: str,
    pinch: str,
    device: str,
) -> None:
    """Measure the solver, or what becomes of its frames, and leave nothing behind.

    Of the latex model the classic dog, of the kosaka model the capsule of the thesis's experiment and longer
    ones, up to a whole 260. Beside what is promised stands whether it was kept here.
    """
    _refuse_what_does_not_apply()
    used = start_device("cpu" if stage else device)
    if stage:
        bench_stage(frames)
        return
    with compiling():
        if crowd:
            bench_crowd(peers or (), used)
        elif peers is not None:
            bench_peers(peers, int(vertices), pinch, used)
        elif mixed:
            bench_mixed(detail, used, frames)
        elif first_frame:
            bench_first_frame(detail, used)
        elif processes is not None:
            bench_processes(processes, detail, used, frames)
        elif batch:
            bench_batch(copies, detail, used, frames)
        else:
            bench_table(model, detail, copies, used, frames, threads)


def _refuse_what_does_not_apply() -> None:
    """Refuse options that what is measured would ignore, and two things at a time."""
    context = click.get_current_context()
    given = {
        name for name in context.params if context.get_parameter_source(name) is ParameterSource.COMMANDLINE
    }
    flags = {option.name: option.opts[0] for option in context.command.params}
    chosen = [name for name in OPTIONS if name in given]
    if chosen == ["crowd", "peers"]:
        chosen.pop()
    if len(chosen) > 1:
        raise Failure(
            "--mixed, --first-frame, --processes, --stage, --batch, --crowd and --peer are measured one at a "
            "time",
            ExitCode.BAD_INPUT,
        )
    used = OPTIONS[chosen[0]] if chosen else TABLE
    idle = sorted(flags[name] for name in given - {*chosen, *used, "device"})
    if idle:
        what = f"with {flags[chosen[0]]}" if chosen else "without --peer"
        raise Failure(f"{', '.join(idle)}: not used {what}", ExitCode.BAD_INPUT)
