"""`balloon-usd plan`: what a recipe means, without simulating it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.sources import plans_of, recipe_files
from balloon_usd.files.whole_file import write_whole

if TYPE_CHECKING:
    from balloon_usd.plan import AfterStep, Plan


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("recipes", nargs=-1, required=True, metavar="RECIPE...", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON, one plan a line, instead of text.")
@click.option(
    "--svg",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Also draw the marks on the flat balloon and the graph (one recipe only).",
)
@click.option(
    "--step",
    type=click.IntRange(min=1),
    metavar="K",
    help="Show what is made after the first K steps, and what is left to work with.",
)
def plan(recipes: tuple[Path, ...], as_json: bool, svg: Path | None, step: int | None) -> None:
    """Show what recipes mean: lengths on the balloon, joints, locks, tail left, cautions."""
    from balloon_usd.plan import plan_svg  # noqa: PLC0415

    plans = plans_of(recipe_files(recipes))
    stages = [None if step is None else _after(planned, step) for planned in plans]
    if svg is not None:
        if len(plans) != 1:
            raise Failure(f"--svg draws one recipe, not {len(plans)}", ExitCode.BAD_INPUT)
        if svg.suffix.lower() != ".svg":
            raise Failure(f"{svg}: expected a name that ends in .svg", ExitCode.BAD_INPUT)
        try:
            write_whole({svg: plan_svg(plans[0], stages[0]).encode()})
        except OSError as error:
            raise Failure(f"{svg} cannot be written: {error.strerror}", ExitCode.NOT_WRITTEN) from error
    for planned, after in zip(plans, stages, strict=True):
        click.echo(_told(planned, after, as_json=as_json))


def _after(planned: Plan, step: int) -> AfterStep:
    from balloon_usd.plan import after_step  # noqa: PLC0415

    steps = len(planned.recipe.steps)
    if planned.of_meshes:
        text = f"--step: {planned.recipe.file} is of a mesh, of which nothing is made step by step"
        raise Failure(text, ExitCode.BAD_INPUT)
    if step > steps:
        text = f"--step: {planned.recipe.file} has no step {step}, expected 1 to {steps}"
        raise Failure(text, ExitCode.BAD_INPUT)
    return after_step(planned, step - 1)


def _told(planned: Plan, after: AfterStep | None, *, as_json: bool) -> str:
    from balloon_usd.plan import after_step_json, after_step_text, plan_json, plan_text  # noqa: PLC0415

    if as_json:
        data = plan_json(planned) if after is None else after_step_json(after)
        return json.dumps(data, allow_nan=False)
    return plan_text(planned) if after is None else after_step_text(after)
