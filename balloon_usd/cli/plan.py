"""`balloon-usd plan`: what a recipe means, without simulating it."""

from __future__ import annotations

import json
from pathlib import Path

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.sources import plans_of, recipe_files


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("recipes", nargs=-1, required=True, metavar="RECIPE...", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON, one plan a line, instead of text.")
@click.option(
    "--svg",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Also draw the marks on the flat balloon and the graph (one recipe only).",
)
def plan(recipes: tuple[Path, ...], as_json: bool, svg: Path | None) -> None:
    """Show what recipes mean: lengths on the balloon, joints, locks, tail left, cautions."""
    from balloon_usd.plan import plan_json, plan_svg, plan_text  # noqa: PLC0415

    plans = plans_of(recipe_files(recipes))
    if svg is not None:
        if len(plans) != 1:
            raise Failure(f"--svg draws one recipe, not {len(plans)}", ExitCode.BAD_INPUT)
        try:
            svg.write_text(plan_svg(plans[0]), encoding="utf-8")
        except OSError as error:
            raise Failure(f"{svg} cannot be written: {error.strerror}", ExitCode.NOT_WRITTEN) from error
    for planned in plans:
        click.echo(json.dumps(plan_json(planned), allow_nan=False) if as_json else plan_text(planned))
