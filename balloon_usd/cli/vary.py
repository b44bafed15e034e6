"""`balloon-usd vary`: the recipes of a parameter sweep or of a random crowd."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.output import require_readable_name

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.variation import Variations
    from balloon_usd.variation.vary import Progress


def _pair(_context: click.Context, _option: click.Parameter, texts: tuple[str, ...]) -> list[tuple[str, str]]:
    """Read PATH=VALUES; without the sign there is no value."""
    parts = (text.partition("=") for text in texts)
    return [(path.strip(), values) for path, _, values in parts]


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("recipe", metavar="RECIPE", type=click.Path(path_type=Path))
@click.option(
    "--set",
    "settings",
    multiple=True,
    required=True,
    callback=_pair,
    metavar="PATH=VALUES",
    help="Values of one entry: red,blue or 8..14/2, which is 8, 10, 12 and 14; with --random also 8..14, any "
    "number between. Give it several times for several entries.",
)
@click.option(
    "--random",
    "draws",
    type=int,
    metavar="N",
    help="Draw N combinations instead of making all.",
)
@click.option(
    "--seed",
    type=int,
    metavar="S",
    help="Of --random: equal seeds, equal recipes. Default: 0.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    required=True,
    metavar="DIR",
    help="Folder for the recipes; made if need be.",
)
@click.option("--force", is_flag=True, help="Replace files that are there and differ.")
def vary(
    recipe: Path,
    settings: list[tuple[str, str]],
    draws: int | None,
    seed: int | None,
    output: Path,
    force: bool,
) -> None:
    """Write variations of a recipe, each a recipe with its own name: `balloon-usd run DIR` makes them.

    PATH is a place in the recipe, such as balloons.main.tail, steps.0.bubbles.nose or physics.friction.
    Values are written as in recipes: "4 in", [1, 0, 0], true. What cannot be made is left out, and told.
    """
    from balloon_usd.variation import VariationError, VariationNotWrittenError, vary_recipe  # noqa: PLC0415

    for path in (recipe, output):
        require_readable_name(path)
    try:
        with _shown_progress() as progress:
            made = vary_recipe(
                recipe, settings, output, draws=draws, seed=seed, overwrite=force, progress=progress
            )
    except VariationNotWrittenError as error:
        raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
    except VariationError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error
    _print_summary(made, recipe, output)


def _print_summary(made: Variations, recipe: Path, output: Path) -> None:
    from balloon_usd.variation.reasons import reason_lines  # noqa: PLC0415

    for notice in made.notices:
        click.echo(notice, err=True)
    written = [variation.file.name for variation in made.written]
    of = f"{len(written)} of {len(written) + len(made.left_out)} variations"
    files = written[0] if len(written) == 1 else f"{written[0]} to {written[-1]}"
    click.echo(f"{recipe}: {of} written to {output}: {files}")
    for line in reason_lines(made.left_out):
        click.echo(line)


@contextmanager
def _shown_progress() -> Iterator[Progress]:
    """Show a bar on a terminal while variations are planned."""
    from rich.progress import Progress as Bar  # noqa: PLC0415

    from balloon_usd.cli.console import Terminal  # noqa: PLC0415

    console = Terminal(stderr=True)
    with Bar(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("planning", total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)
