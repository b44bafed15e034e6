"""All that is known of variations before they are planned: their names, their values and their texts."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod
from numbers import Integral
from typing import TYPE_CHECKING

from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.recipe.recipe_file import read_recipe_file
from balloon_usd.recipe.upgrades import upgraded
from balloon_usd.variation.error import VariationError
from balloon_usd.variation.mesh_paths import mesh_paths, moved_value
from balloon_usd.variation.naming import FEW, names_with_values, numbered_names
from balloon_usd.variation.parameters import read_parameters
from balloon_usd.variation.provenance import provenance_lines
from balloon_usd.variation.sampling import MOST_VARIATIONS, draw, sweep
from balloon_usd.variation.template import template_of
from balloon_usd.variation.values import Span, shown_count
from balloon_usd.variation.writing import folder_problem

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path as File

    from balloon_usd.language.problem import Path
    from balloon_usd.variation.parameters import Parameter, Settings
    from balloon_usd.variation.sampling import Combination
    from balloon_usd.variation.template import Template

NAME: Path = ("name",)


@dataclass(frozen=True)
class Design:
    """Variations of a recipe in their order, each a name and a combination of values."""

    recipe: Recipe
    template: Template
    parameters: Sequence[Parameter]
    combinations: Sequence[Combination]
    names: Sequence[str]
    moved: Mapping[Path, object]
    """Mesh files that are not varied, as they are found from the target."""
    source: File
    target: File
    """Folders of the recipe and of the variations."""

    def values(self, at: int) -> dict[str, object]:
        """Return what is set in a variation, by its path."""
        return {parameter.name: value for parameter, value in self._set(at)}

    def text(self, at: int) -> str:
        """Return the recipe of a variation."""
        filled = {
            parameter.path: moved_value(parameter.path, value, self.source, self.target)
            for parameter, value in self._set(at)
        }
        body = self.template.filled({NAME: self.names[at], **self.moved, **filled})
        return provenance_lines(self.recipe, self.values(at)) + body

    def _set(self, at: int) -> Iterator[tuple[Parameter, object]]:
        for parameter, number in zip(self.parameters, self.combinations[at], strict=True):
            yield parameter, parameter.values.value(number)


def design_of(file: File, settings: Settings, target: File, *, draws: int | None, seed: int | None) -> Design:
    """Return the variations that are asked for; see `vary_recipe`.

    Raises:
        VariationError: with all that is wrong with the recipe, the settings and the folder.
    """
    problems: list[str] = []
    recipe, text, document = None, "", None
    try:
        text = read_recipe_file(file)
        recipe = Recipe.parse(text, file=str(file))
        document, _ = upgraded(read_yaml(text, str(file)))
    except RecipeError as error:
        problems += map(str, error.problems)
    parameters, wrong = read_parameters(settings, document and document.data)
    problems += [*wrong, *_amount_problems(parameters, draws, seed), *filter(None, [folder_problem(target)])]
    if recipe is None or document is None or problems:
        raise VariationError(problems)
    counts = [parameter.values.count for parameter in parameters]
    chosen = list(sweep(counts)) if draws is None else draw(counts, draws, seed or 0)
    names = _names(recipe.name, parameters, chosen, drawn=draws is not None)
    # The text keeps its older words, which are known by today's.
    parameters = [replace(each, path=document.marks.written(each.path)) for each in parameters]
    moved = _moved_meshes(document.data, parameters, file.parent, target)
    paths = [NAME, *moved, *(parameter.path for parameter in parameters)]
    template = template_of(text, str(file), paths)
    return Design(recipe, template, parameters, chosen, names, moved, file.parent, target)


def _amount_problems(parameters: Sequence[Parameter], draws: int | None, seed: int | None) -> Iterator[str]:
    """Yield what is wrong with how many variations there are."""
    if not all(each is None or isinstance(each, Integral) for each in (draws, seed)):
        yield f"{draws!r} variations with seed {seed!r} cannot be drawn, expected whole numbers"
        return
    if draws is not None:
        if not 1 <= draws <= MOST_VARIATIONS:
            yield f"{shown_count(draws)} variations cannot be drawn, expected 1 to {MOST_VARIATIONS}"
        if seed is not None and seed < 0:
            yield f"{seed} is no seed, expected 0 or more"
        return
    if seed is not None:
        yield "a seed chooses among random variations, expected their number, too: --random N"
    continuous = False
    for parameter in parameters:
        if isinstance(parameter.values, Span) and parameter.values.continuous:
            continuous = True
            text = f"{parameter.values.text} is a continuous range, from which only --random N draws"
            yield f"{parameter.name}: {text}; expected a step, such as {parameter.values.with_step}"
    count = prod(parameter.values.count for parameter in parameters)
    if count > MOST_VARIATIONS and not continuous:
        what = f"{shown_count(count)} variations are too many, expected at most {MOST_VARIATIONS}"
        yield f"{what}: fewer values, or --random N"


def _names(
    base: str, parameters: Sequence[Parameter], chosen: Sequence[Combination], *, drawn: bool
) -> list[str]:
    if drawn or len(chosen) > FEW:
        return numbered_names(base, len(chosen))
    # What is the same in all tells none apart.
    varied = [at for at, parameter in enumerate(parameters) if parameter.values.count > 1]
    shown = varied or range(len(parameters))
    return names_with_values(base, [[parameters[at].values.value(row[at]) for at in shown] for row in chosen])


def _moved_meshes(
    data: object, parameters: Sequence[Parameter], source: File, target: File
) -> dict[Path, object]:
    moved: dict[Path, object] = {}
    for path, mesh in mesh_paths(data):
        if not any(path[: len(parameter.path)] == parameter.path for parameter in parameters):
            there = moved_value(path, mesh, source, target)
            if there != mesh:
                moved[path] = there
    return moved
