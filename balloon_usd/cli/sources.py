"""From the paths of the command line to plans, with all problems of all files at once."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from balloon_usd.plan import Plan
    from balloon_usd.recipe import Recipe

SUFFIXES = frozenset({".yaml", ".yml"})


def recipe_files(paths: Iterable[Path]) -> list[Path]:
    """Return the recipe files: those named, and those directly inside folders, by name; each once.

    Raises:
        Failure: a folder holds no recipe.
    """
    files: dict[Path, Path] = {}
    for path in paths:
        found = _files_in(path) if is_folder(path) else [path]
        if not found:
            raise Failure(f"{path}: no recipes (*.yaml) in this folder", ExitCode.BAD_INPUT)
        for file in found:
            files.setdefault(_place(file), file)
    return list(files.values())


def is_folder(path: Path) -> bool:
    """Whether a path leads to a folder; one that leads nowhere, as too long a name does, is none."""
    try:
        return path.is_dir()
    except OSError:
        return False


def is_same(path: Path, other: Path) -> bool:
    """Whether two paths lead to one file; one that leads nowhere leads to none."""
    try:
        return path.samefile(other)
    except OSError:
        return False


def _files_in(folder: Path) -> list[Path]:
    try:
        entries = sorted(folder.iterdir())
    except OSError as error:
        raise Failure(f"{folder}: cannot be read ({error.strerror or error})", ExitCode.BAD_INPUT) from error
    return [file for file in entries if file.suffix in SUFFIXES and file.is_file()]


def _place(file: Path) -> Path:
    """Return where a file is, by which two names of it are known as one."""
    try:
        return file.resolve()
    except (OSError, RuntimeError, ValueError):
        # Links that lead in a circle, no name of a file, a folder that is gone: reading it will tell.
        return file


def plans_of(files: Sequence[Path]) -> list[Plan]:
    """Read and plan every file, and tell notices of all on the error stream.

    Raises:
        Failure: with the problems of all files, one a line, if there is any.
    """
    from balloon_usd.plan import plan  # noqa: PLC0415
    from balloon_usd.recipe import Recipe, RecipeError  # noqa: PLC0415

    plans: list[Plan] = []
    problems: list[str] = []
    for file in files:
        try:
            plans.append(plan(Recipe.load(file)))
        except RecipeError as error:
            problems.append(str(error))
    for planned in plans:
        tell_notices(planned.recipe)
    problems += _shared_names(plans)
    if problems:
        raise Failure("\n".join(problems), ExitCode.BAD_INPUT)
    return plans


def tell_notices(recipe: Recipe) -> None:
    """Tell what the writer of a recipe should know, on the error stream."""
    for notice in recipe.notices:
        click.echo(notice, err=True)


def _shared_names(plans: Iterable[Plan]) -> list[str]:
    """Say which recipes would write the same files, also where capitals make no difference."""
    by_name: dict[str, list[Plan]] = defaultdict(list)
    for plan in plans:
        by_name[plan.recipe.name.casefold()].append(plan)
    return [
        f'{other.recipe.file}: name: "{other.recipe.name}" is taken by {first.recipe.file}'
        for first, *others in by_name.values()
        for other in others
    ]
