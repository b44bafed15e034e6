"""`balloon-usd golden`: recipes held to the stages that they gave before."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from textwrap import indent
from typing import TYPE_CHECKING, Any

import click

from balloon_usd.cli.device import compiling, start_device
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.frame_range import MOST_FRAMES
from balloon_usd.cli.golden_recipes import golden_recipes
from balloon_usd.cli.tolerance import tolerance_options

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from balloon_usd.cli.golden_recipes import GoldenRecipe
    from balloon_usd.diff import Comparison
    from balloon_usd.golden import Compare

DIFFERENT = 1
EXIT_CODES = """\b
Exit codes:
  0    verify: all are the same; update: done
  1    verify: one differs; update: one could not be written
  2    bad input: recipe, option, list, or a golden stage is missing or not whole
  3    a simulation failed
  130  interrupted
"""


@click.group(epilog=EXIT_CODES)
def golden() -> None:
    """Hold recipes to golden stages: the stages that they gave when somebody last looked.

    The file golden.yaml beside the stages lists recipes, frames and tolerances. Recipes are simulated
    in draft on the CPU.
    """


def _holding(command: Callable[..., None]) -> Callable[..., None]:
    """Add what both commands take."""
    options = (
        click.argument("recipes", nargs=-1, metavar="[RECIPE]...", type=click.Path(path_type=Path)),
        click.option(
            "--stages",
            type=click.Path(path_type=Path),
            default=Path("stages"),
            show_default=True,
            metavar="DIR",
            help="Folder of the golden stages and of golden.yaml.",
        ),
        click.option(
            "--frames",
            type=click.IntRange(1, MOST_FRAMES),
            metavar="N",
            help="Keep the first N frames. Default: what the list says, else all.",
        ),
        tolerance_options,
    )
    for option in reversed(options):
        command = option(command)
    return command


@golden.command(epilog=EXIT_CODES)
@_holding
def verify(recipes: tuple[Path, ...], stages: Path, **options: Any) -> None:
    """Simulate recipes, and compare what comes out with their golden stages.

    RECIPE is a recipe file or a folder of them; without any, all that golden.yaml lists are verified.
    """
    with _comparing() as compare:
        same = _verify(golden_recipes(recipes, stages, **options), stages, compare)
    if not all(same):
        raise click.exceptions.Exit(DIFFERENT)


def _verify(held: list[GoldenRecipe], stages: Path, compare: Compare) -> list[bool]:
    """Return of each recipe whether its stage is the same as before."""
    from balloon_usd import golden as room  # noqa: PLC0415
    from balloon_usd.diff.report import diff_text  # noqa: PLC0415

    def one(held: GoldenRecipe) -> bool:
        found = room.verify(held.plan, stages, held.tolerances, held.frames, compare=compare)
        click.echo(f"{held.plan.recipe.name}: {'the same' if found.same else 'different'}")
        if not found.same:
            click.echo(indent(diff_text(found), "  "))
        return found.same

    return _each(held, one)


@golden.command(epilog=EXIT_CODES)
@_holding
@click.option(
    "--all", "always", is_flag=True, help="Replace also those that are the same within the tolerance."
)
def update(recipes: tuple[Path, ...], stages: Path, always: bool, **options: Any) -> None:
    """Replace the golden stages that differ from what comes out now, and say how.

    RECIPE is a recipe file or a folder of them; without any, all that golden.yaml lists are updated. Recipes
    that it does not list are entered.
    """
    with _comparing() as compare:
        _update(golden_recipes(recipes, stages, **options), stages, compare, always=always)


def _update(held: list[GoldenRecipe], stages: Path, compare: Compare, *, always: bool) -> None:
    """Replace the stages that differ."""
    from balloon_usd import golden as room  # noqa: PLC0415
    from balloon_usd.diff.report import diff_text  # noqa: PLC0415

    def one(held: GoldenRecipe) -> bool:
        plan, tolerances = held.plan, held.tolerances
        done = room.update(plan, stages, tolerances, held.frames, always=always, compare=compare)
        click.echo(f"{held.plan.recipe.name}: {'written' if done.written else 'kept, it is the same'}")
        if done.written and done.comparison is not None:
            click.echo(indent(diff_text(done.comparison), "  "))
        recipe = held.plan.recipe
        if not room.enter(stages, recipe.name, Path(recipe.file), held.frames):
            click.echo(f"{stages / room.FILE_NAME}: enter {recipe.name} by hand, below the others", err=True)
        return True

    _each(held, one)


@contextmanager
def _comparing() -> Iterator[Compare]:
    """Compare stages in a child process, as nobody knows what became of those in a folder."""
    from balloon_usd.cli.child_process import ChildProcess, DamagedError  # noqa: PLC0415

    def compare(first: Path, second: Path, **options: Any) -> Comparison:
        from balloon_usd.diff import DamagedStageError, DiffError, compare_files  # noqa: PLC0415

        try:
            found = child.call([first, second], compare_files, first, second, **options)
        except (DamagedError, DamagedStageError) as error:
            raise DiffError(f"{first}: damaged: {error}") from error
        child.pass_on()
        return found

    with ChildProcess() as child:
        # Before this process has more than can be forked.
        child.start()
        yield compare


def _each(recipes: list[GoldenRecipe], one: Callable[[GoldenRecipe], bool]) -> list[bool]:
    """Do one after the other, also after one that could not be done.

    Raises:
        Failure: one or more could not be done; the gravest tells the exit code.
    """
    from balloon_usd.diff import DiffError  # noqa: PLC0415
    from balloon_usd.golden import DEVICE, GoldenError  # noqa: PLC0415
    from balloon_usd.solver.errors import SimulationFailed  # noqa: PLC0415
    from balloon_usd.stage import StageError  # noqa: PLC0415

    start_device(DEVICE)
    done: list[bool] = []
    problems: list[tuple[ExitCode, str]] = []
    for each in recipes:
        file = each.plan.recipe.file
        try:
            with compiling():
                done.append(one(each))
        except SimulationFailed as error:
            problems.append((ExitCode.SIMULATION_FAILED, f"{file}: simulation failed {error}"))
        except (DiffError, GoldenError) as error:
            problems.append((ExitCode.BAD_INPUT, f"{file}: {error}"))
        except StageError as error:
            problems.append((ExitCode.NOT_WRITTEN, f"{file}: {error}"))
    if problems:
        raise Failure("\n".join(text for _, text in problems), max(code for code, _ in problems))
    return done
