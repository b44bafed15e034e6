"""`balloon-usd run`: recipes in, stages, contact sheets and reports out."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.device import compiling, device_option, start_device
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.form import LOOKS, WITH_AIR, Form
from balloon_usd.cli.frame_range import FrameRange, frame_range
from balloon_usd.cli.output import require_free, require_writable, sheet_path
from balloon_usd.cli.sources import plans_of, recipe_files

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.cli.perform import Outcome
    from balloon_usd.plan import Plan

DETAILS = ("draft", "preview", "full")
PROGRESS = ("bar", "lines")


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
@device_option
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
    device: str,
    flat: bool,
    usdz: bool,
    look: str | None,
    shot: bool,
    frames: FrameRange | None,
    no_preview: bool,
    no_report: bool,
    progress: str,
) -> None:
    """Make sculptures: simulate recipes and write a USD stage, a contact sheet and a report of each.

    RECIPE is a recipe file, or a folder whose recipes (*.yaml) are all made. All sculptures advance together.
    If a recipe is wrong nothing is run, and all problems of all recipes are listed.

    Writes OUTPUT/NAME/NAME.usda with its payload, OUTPUT/NAME.png, OUTPUT/NAME.report.json and its figure
    OUTPUT/NAME.report.png, where NAME is the recipe's name. --flat and --usdz write one file instead.
    """
    form = Form(flat=flat, usdz=usdz, look=look, shot=shot)
    plans = plans_of(recipe_files(recipes))
    form.require_look(plans)
    require_writable(output)
    names = [plan.recipe.name for plan in plans]
    sheets = [] if no_preview else [sheet_path(output, name) for name in names]
    reports = [] if no_report else _report_paths(output, names)
    require_free(output, names, form, [*sheets, *reports])
    used = start_device(device)
    _print_cautions(plans)
    outcomes = _perform_all(
        plans, output, detail, used, form, frames=frames or FrameRange(), lines=progress == "lines"
    )
    if not no_report:
        _report(outcomes, output, detail)
    if not no_preview:
        _draw(outcomes, output, used, form)
    failed = [f"{o.plan.recipe.file}: simulation failed {o.failed}" for o in outcomes if o.failed]
    if failed:
        raise Failure("\n".join(failed), ExitCode.SIMULATION_FAILED)


def _print_cautions(plans: Sequence[Plan]) -> None:
    for plan in plans:
        for caution in plan.cautions:
            place = "" if caution.step is None else f"step {caution.step + 1}: "
            click.echo(f"{plan.recipe.file}: caution: {place}{caution.what} ({caution.why})", err=True)


def _perform_all(
    plans: Sequence[Plan],
    output: Path,
    detail: str,
    device: str,
    form: Form,
    *,
    frames: FrameRange,
    lines: bool,
) -> list[Outcome]:
    from balloon_usd.solver.device import wake  # noqa: PLC0415

    wake(device)
    from balloon_usd.cli.perform import Order, perform, together  # noqa: PLC0415
    from balloon_usd.cli.summary import print_summary  # noqa: PLC0415

    order = Order(output, detail, device, form, frames, lines)
    begin = time.perf_counter()
    with compiling():
        outcomes = [outcome for group in together(plans) for outcome in perform(group, order)]
    print_summary(outcomes, time.perf_counter() - begin, detail, device)
    return outcomes


def _report_paths(output: Path, names: Sequence[str]) -> list[Path]:
    from balloon_usd.report import report_files  # noqa: PLC0415

    return [file for name in names for file in report_files(output, name)]


def _report(outcomes: Sequence[Outcome], output: Path, detail: str) -> None:
    from balloon_usd.report import ReportError, write_report  # noqa: PLC0415
    from balloon_usd.staging import provenance_of  # noqa: PLC0415

    for outcome in outcomes:
        if outcome.written is None:
            continue
        origin = provenance_of(outcome.plan.recipe)
        try:
            files = write_report(outcome.history, output, detail=detail, provenance=origin)
        except ReportError as error:
            raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
        for file in files:
            click.echo(f"report {file}")


def _draw(outcomes: Sequence[Outcome], output: Path, device: str, form: Form) -> None:
    from balloon_usd.preview import PreviewError, draw_contact_sheet  # noqa: PLC0415

    for outcome in outcomes:
        if outcome.written is None:
            continue
        name = outcome.plan.recipe.name
        try:
            sheet = draw_contact_sheet(form.stage(output, name), sheet_path(output, name), device=device)
        except PreviewError as error:
            raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
        click.echo(f"contact sheet {sheet}")
