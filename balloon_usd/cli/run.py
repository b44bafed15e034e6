"""`balloon-usd run`: recipes in, stages, contact sheets and reports out."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from balloon_usd.batch.looks import LOOKS, WITH_AIR
from balloon_usd.batch.order import FrameRange, Order
from balloon_usd.cli.device import devices_named
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.form import require_form
from balloon_usd.cli.frame_range import frame_range
from balloon_usd.cli.sources import recipe_files
from balloon_usd.processes.cores import usable_cores

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from balloon_usd.batch.record import Record
    from balloon_usd.batch.watch import Watch

    Engine = Callable[[Sequence[Path], Order, tuple[str, ...], int | None, Watch], list[Record]]
    """Makes recipes on devices with so many jobs, and tells a watch how far it is."""

DETAILS = ("draft", "preview", "full")
PROGRESS = ("bar", "lines")
ENGINES = ("local", "ray")
MOST_JOBS = 4096


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("recipes", nargs=-1, required=True, metavar="RECIPE...", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    default=Path(),
    help="Folder for the stages; made if need be. Default: here.",
)
@click.option(
    "--detail",
    type=click.Choice(DETAILS),
    default="draft",
    show_default=True,
    help="How fine the mesh and the time steps are.",
)
@click.option(
    "--device",
    "devices",
    type=devices_named,
    metavar="auto|cpu|cuda:0,cuda:1|all",
    default="auto",
    show_default=True,
    help="Where to compute; auto is the first CUDA device, else the CPU, all is every CUDA device.",
)
@click.option(
    "--jobs",
    type=click.IntRange(1, MOST_JOBS),
    metavar="N",
    help="Processor cores to use. Default: all that there are.",
)
@click.option(
    "--engine",
    type=click.Choice(ENGINES),
    default=ENGINES[0],
    show_default=True,
    help="This machine, or a Ray cluster that shares the folders; needs the extra [cluster].",
)
@click.option(
    "--address",
    metavar="HOST:PORT",
    help="Of the cluster, with --engine ray. Default: start one on this machine.",
)
@click.option("--flat", is_flag=True, help="Write one NAME.usdc instead of the folder NAME with its layers.")
@click.option("--usdz", is_flag=True, help="Write one NAME.usdz instead, for AR viewers: y up, no textures.")
@click.option(
    "--look",
    metavar="|".join((*LOOKS, WITH_AIR)),
    help="Look that the stage shows: the only one with --flat and --usdz, else the one selected.",
)
@click.option(
    "--shot", is_flag=True, help="Write NAME_shot.usda too: the stage with camera, lights and ground."
)
@click.option(
    "--frames",
    type=frame_range,
    metavar="A:B",
    help="Write only these frames, counted from 1; A: and :B leave an end open.",
)
@click.option("--no-preview", is_flag=True, help="Draw no contact sheet.")
@click.option("--no-report", is_flag=True, help="Write no report.")
@click.option("--force", is_flag=True, help="Make anew also what is there already, made of the same.")
@click.option(
    "--progress",
    type=click.Choice(PROGRESS),
    default=PROGRESS[0],
    show_default=True,
    help='What the error stream tells meanwhile; "lines" is for programs: progress DONE/TOTAL DOING.',
)
def run(
    recipes: tuple[Path, ...],
    output: Path,
    detail: str,
    devices: tuple[str, ...],
    jobs: int | None,
    engine: str,
    address: str | None,
    flat: bool,
    usdz: bool,
    look: str | None,
    shot: bool,
    frames: FrameRange | None,
    no_preview: bool,
    no_report: bool,
    force: bool,
    progress: str,
) -> None:
    """Make sculptures: simulate recipes and write a USD stage, a contact sheet and a report of each.

    RECIPE is a recipe file, or a folder whose recipes (*.yaml) are all made, on all cores, or as many at once
    as fit a GPU. A recipe that is refused or fails takes no other along: all problems are listed, the rest is
    made. What is there already, whole and made of the same recipe with the same options, is skipped; so a run
    that was interrupted or killed goes on where it was.

    Writes OUTPUT/NAME/NAME.usda with its payload, OUTPUT/NAME.png, OUTPUT/NAME.report.json and its figure
    OUTPUT/NAME.report.png, where NAME is the recipe's name, and OUTPUT/batch.jsonl, a line for each recipe.
    --flat and --usdz write one file instead. A simulation that fails leaves the frames before that under the
    name NAME.failed until the recipe is made, and an earlier NAME as it was.
    """
    if address is not None and engine != "ray":
        raise Failure("--address: only with --engine ray", ExitCode.BAD_INPUT)
    require_form(flat=flat, usdz=usdz, look=look, shot=shot)
    order = Order(
        output,
        detail,
        flat,
        usdz,
        look,
        shot,
        frames or FrameRange(),
        preview=not no_preview,
        report=not no_report,
        force=force,
    )
    made = _on_cluster(address) if engine == "ray" else _here
    _end(_make(made, recipe_files(recipes), order, devices, jobs, lines=progress == "lines"))


def _make(
    made: Engine,
    files: Sequence[Path],
    order: Order,
    devices: tuple[str, ...],
    jobs: int | None,
    *,
    lines: bool,
) -> list[Record]:
    from balloon_usd.cli.batch_progress import BatchProgress  # noqa: PLC0415
    from balloon_usd.cli.summary import print_summary  # noqa: PLC0415

    begin = time.perf_counter()
    with BatchProgress(order, lines=lines) as progress:
        records = made(files, order, devices, jobs, progress)
    print_summary(records, order, time.perf_counter() - begin, progress.device)
    return records


def _here(
    files: Sequence[Path], order: Order, devices: tuple[str, ...], jobs: int | None, watch: Watch
) -> list[Record]:
    """Make recipes on this machine."""
    from balloon_usd.batch.engine import run_batch  # noqa: PLC0415
    from balloon_usd.batch.error import BatchError, NotKept  # noqa: PLC0415
    from balloon_usd.batch.machine import Machine  # noqa: PLC0415

    try:
        return run_batch(files, order, Machine(jobs or usable_cores(), devices), watch)
    except NotKept as error:
        raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
    except BatchError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error


def _on_cluster(address: str | None) -> Engine:
    """Return what makes recipes on a Ray cluster."""
    from balloon_usd.batch.cluster import run_on_cluster  # noqa: PLC0415
    from balloon_usd.batch.error import BatchError, NotKept  # noqa: PLC0415
    from balloon_usd.batch.machine import Machine  # noqa: PLC0415
    from balloon_usd.batch.ray_cluster import ClusterError  # noqa: PLC0415

    def made(
        files: Sequence[Path], order: Order, devices: tuple[str, ...], jobs: int | None, watch: Watch
    ) -> list[Record]:
        try:
            return run_on_cluster(files, order, Machine(jobs or 1, devices), address, watch)
        except NotKept as error:
            raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
        except (BatchError, ClusterError) as error:
            raise Failure(str(error), ExitCode.BAD_INPUT) from error

    return made


def _end(records: Sequence[Record]) -> None:
    """End with what went wrong, and the gravest exit code: not written, failed, refused.

    Raises:
        Failure: something did.
    """
    from balloon_usd.batch.record import Status  # noqa: PLC0415

    codes = {
        Status.NOT_WRITTEN: ExitCode.NOT_WRITTEN,
        Status.UNFORESEEN: ExitCode.NOT_WRITTEN,
        Status.KILLED: ExitCode.SIMULATION_FAILED,
        Status.DEVICE: ExitCode.SIMULATION_FAILED,
        Status.FAILED: ExitCode.SIMULATION_FAILED,
        Status.REFUSED: ExitCode.BAD_INPUT,
    }
    found = {codes[record.status] for record in records if record.status in codes}
    told = [record.error for record in records if record.status in codes and record.status != Status.REFUSED]
    gravity = (ExitCode.NOT_WRITTEN, ExitCode.SIMULATION_FAILED, ExitCode.BAD_INPUT)
    if gravest := next((code for code in gravity if code in found), None):
        if not told:
            # Refusals have been told before anything was run.
            raise click.exceptions.Exit(int(gravest))
        raise Failure("\n".join(told), gravest)
