"""From a recipe and parameters to the recipes of its variations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.language.problem import escaped
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.variation.design import design_of
from balloon_usd.variation.error import VariationError
from balloon_usd.variation.reasons import reason_lines
from balloon_usd.variation.result import LeftOut, Variation, Variations
from balloon_usd.variation.writing import give_names, hidden_folder, obstacles, write_text

if TYPE_CHECKING:
    from balloon_usd.recipe import Problem
    from balloon_usd.recipe.recipe_file import FilePath
    from balloon_usd.variation.design import Design
    from balloon_usd.variation.parameters import Settings

Progress = Callable[[int, int], None]
"""Is told how many variations are done, and of how many."""


def vary_recipe(
    recipe: FilePath,
    settings: Settings,
    folder: FilePath,
    *,
    draws: int | None = None,
    seed: int | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Variations:
    """Write variations of a recipe, each a recipe with its own name in a file NAME.yaml.

    Variations that the reader or the plan refuses are left out. Either all others are written or none.

    Args:
        recipe: file of the recipe.
        settings: values by the path where they are set, such as {"balloons.main.tail": "8..14/2"} or
            {"balloons.main.color": ["red", "blue"]}. Mesh files are found from the recipe's folder.
        folder: gets the files; made if need be.
        draws: draw so many combinations at random, instead of making all; ranges may be continuous.
        seed: of the draws, 0 if absent; equal seeds give equal files.
        overwrite: replace files that are there and differ.
        progress: is called after each variation.

    Raises:
        VariationError: with all problems, if the recipe, the settings or the folder are wrong, or if no
            variation can be made; nothing is written.
        VariationNotWrittenError: they cannot be written, as on a full disk.
    """
    source, target = Path(recipe), Path(folder)
    design = design_of(source, settings, target, draws=draws, seed=seed)
    files = [target / f"{name}.yaml" for name in design.names]
    with hidden_folder(target) as aside:
        in_the_way = list(obstacles(files, design.text, source, overwrite=overwrite))
        if in_the_way:
            raise VariationError(in_the_way)
        found = _make(design, files, aside, progress)
        if not found.written:
            none = f"{escaped(str(source))}: none of {len(files)} variations can be made, nothing is written"
            raise VariationError([none, *reason_lines(found.left_out)])
        give_names(aside, target, [variation.file.name for variation in found.written])
    return found


def _make(design: Design, files: list[Path], aside: Path, progress: Progress | None) -> Variations:
    """Plan all variations, and write those that can be made under their names in another folder."""
    written: list[Variation] = []
    left_out: list[LeftOut] = []
    for at, (name, file) in enumerate(zip(design.names, files, strict=True)):
        text = design.text(at)
        problem = _first_problem(text, file)
        if problem is None:
            write_text(aside / file.name, text)
            written.append(Variation(name, file, design.values(at)))
        else:
            left_out.append(LeftOut(name, design.values(at), problem))
        if progress is not None:
            progress(at + 1, len(files))
    return Variations(tuple(written), tuple(left_out), design.recipe.notices)


def _first_problem(text: str, file: Path) -> Problem | None:
    """Read and plan a variation as a run of its file would."""
    try:
        plan(Recipe.parse(text, file=str(file)))
    except RecipeError as error:
        return error.problems[0]
    return None
