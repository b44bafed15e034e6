"""The recipes that `golden` is about, with what was asked for and what the list says of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.output import require_readable_name
from balloon_usd.cli.sources import plans_of, recipe_files
from balloon_usd.cli.tolerance import tolerances_of

if TYPE_CHECKING:
    from pathlib import Path

    from balloon_usd.diff import Tolerances
    from balloon_usd.golden import GoldenEntry
    from balloon_usd.plan import Plan


@dataclass(frozen=True)
class GoldenRecipe:
    """A plan, and how its golden stage is compared."""

    plan: Plan
    tolerances: Tolerances
    frames: int | None
    """The first so many; None: all."""


def golden_recipes(
    recipes: tuple[Path, ...], stages: Path, *, frames: int | None, **tolerances: Any
) -> list[GoldenRecipe]:
    """Return the recipes named, else all in the list of a folder; options stand above what the list says.

    `tolerances`: what `tolerance_options` gives.

    Raises:
        Failure: a recipe or the list is wrong, or there is neither.
    """
    from balloon_usd.golden import FILE_NAME, GoldenError, read_list  # noqa: PLC0415

    require_readable_name(stages)
    try:
        listed = read_list(stages)
    except GoldenError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error
    if not recipes and not listed:
        nothing = "lists no stages" if (stages / FILE_NAME).exists() else "is not there"
        raise Failure(f"{stages / FILE_NAME} {nothing}: name the recipes", ExitCode.BAD_INPUT)
    plans = plans_of(recipe_files(recipes or [entry.recipe for entry in listed.values()]))
    names = {plan.recipe.name for plan in plans}
    for name, entry in listed.items():
        if not recipes and name not in names:
            raise Failure(f'{stages / FILE_NAME}: {entry.recipe} is not called "{name}"', ExitCode.BAD_INPUT)
    asked = tolerances_of(**tolerances)
    return [_golden_recipe(plan, listed.get(plan.recipe.name), asked, frames) for plan in plans]


def _golden_recipe(
    plan: Plan, entry: GoldenEntry | None, asked: Tolerances, frames: int | None
) -> GoldenRecipe:
    """Put what was asked for above what the list says."""
    from balloon_usd.diff import Allowed, Tolerances  # noqa: PLC0415

    if entry is None:
        return GoldenRecipe(plan, asked, frames)
    kept = entry.tolerances
    general = asked.general if asked.general != Allowed() else kept.general
    rms = kept.rms if asked.rms is None else asked.rms
    merged = Tolerances(general, {**kept.named, **asked.named}, rms)
    return GoldenRecipe(plan, merged, frames or entry.frames)
