"""`balloon-usd farm-template`: recipes as a job of a render farm."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from balloon_usd.batch.looks import LOOKS, WITH_AIR
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.form import require_form
from balloon_usd.cli.output import require_readable_name
from balloon_usd.cli.run import run
from balloon_usd.cli.sources import is_folder, is_same, plans_of, recipe_files

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.farm import JobTemplate
    from balloon_usd.plan import Plan

OF_RUN = ("devices", "flat", "usdz", "look", "shot", "frames", "no_preview", "no_report")
"""Options of `run` that are written into the template as they are given."""
MOST_IN_CHUNK = 4096


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("recipes", nargs=-1, required=True, metavar="RECIPE...", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "template",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="File for the template: .yaml, .yml or .json. Default: print it, to be kept in this folder.",
)
@click.option(
    "--output",
    type=click.Path(path_type=Path),
    default=Path("out"),
    show_default=True,
    metavar="DIR",
    help="Folder for the stages, default of the job's parameter Output.",
)
@click.option(
    "--chunk",
    type=click.IntRange(1, MOST_IN_CHUNK),
    metavar="N",
    help="Recipes that one task makes together. Default: 16, or 256 with --device cuda.",
)
def farm_template(
    recipes: tuple[Path, ...],
    template: Path | None,
    output: Path,
    chunk: int | None,
    detail: str,
    **of_run: Any,
) -> None:
    """Write recipes as a job template (OpenJD) for a render farm, one task a chunk of recipes.

    RECIPE is a recipe file, or a folder whose recipes (*.yaml) are all made. If a recipe is wrong nothing is
    written, and all problems of all recipes are listed.

    The job has the parameters Recipes, Output, Detail and Command. With --device cuda its tasks go to
    machines with a GPU. The other options are those of balloon-usd run.
    """
    from balloon_usd.farm import JobTemplate, chunk_size, default_below  # noqa: PLC0415

    require_form(**{name: of_run[name] for name in ("flat", "usdz", "look", "shot")})
    plans = plans_of(recipe_files(recipes))
    _require_air(plans, of_run["look"])
    _require_text(plans)
    require_readable_name(output)
    beside = _template_folder(template)
    if template is not None and any(is_same(template, Path(plan.recipe.file)) for plan in plans):
        raise Failure(f"{template} is a recipe of the job, expected another name", ExitCode.BAD_INPUT)
    folders = {"Recipes": _recipe_folder(plans), "Output": _absolute(output)}
    defaults = {name: default_below(folder, beside) for name, folder in folders.items()}
    job = JobTemplate(
        name=_job_name(plans),
        chunks=_chunks(plans, chunk or chunk_size(of_run["devices"][0]), folders["Recipes"]),
        recipes=defaults["Recipes"],
        output=defaults["Output"],
        detail=detail,
        options=_words(of_run),
        gpus=_gpus(of_run["devices"]),
    )
    _write(job, template)
    for name, folder in folders.items():
        if defaults[name] is None:
            why = f"which has no default, as it is not below {beside}"
            click.echo(f"caution: submit the job with {name}={folder}, {why}", err=True)


farm_template.params += [option for option in run.params if option.name in {"detail", *OF_RUN}]


def _require_air(plans: Sequence[Plan], look: str | None) -> None:
    """Check that plans with a look that shows air have some."""
    if look != WITH_AIR:
        return
    files = [plan.recipe.file for plan in plans if not plan.recipe.physics.traits.has_air_particles]
    if files:
        needs = f"--look {WITH_AIR} needs model: kosaka, take one of {', '.join(LOOKS)}"
        raise Failure("\n".join(f"{file}: {needs}" for file in files), ExitCode.BAD_INPUT)


def _require_text(plans: Sequence[Plan]) -> None:
    problems = []
    for plan in plans:
        try:
            plan.recipe.file.encode("utf-8")
        except UnicodeEncodeError:
            shown = plan.recipe.file.encode("utf-8", "backslashreplace").decode()
            problems.append(f"{shown}: the path is not UTF-8, which a job template needs")
    if problems:
        raise Failure("\n".join(problems), ExitCode.BAD_INPUT)


def _template_folder(template: Path | None) -> Path:
    """Return the folder of the template, absolute, from which its folders are seen."""
    from balloon_usd.farm import ENDINGS  # noqa: PLC0415

    if template is None:
        return Path.cwd()
    require_readable_name(template)
    if template.suffix.lower() not in ENDINGS:
        raise Failure(f"{template}: expected a file {', '.join(ENDINGS)}", ExitCode.BAD_INPUT)
    if is_folder(template):
        raise Failure(f"{template}: a folder is in the way", ExitCode.BAD_INPUT)
    return _absolute(template.parent)


def _absolute(path: Path) -> Path:
    return Path(os.path.abspath(path))  # noqa: PTH100  # without dots, and with the links that people see


def _recipe_folder(plans: Sequence[Plan]) -> Path:
    from balloon_usd.farm import recipe_folder  # noqa: PLC0415

    try:
        return recipe_folder(plans)
    except ValueError as error:
        raise Failure(f"recipes: expected all below one folder ({error})", ExitCode.BAD_INPUT) from error


def _job_name(plans: Sequence[Plan]) -> str:
    more = f" and {len(plans) - 1} more" if len(plans) > 1 else ""
    return f"{plans[0].recipe.name}{more}"


def _chunks(plans: Sequence[Plan], size: int, folder: Path) -> str:
    from balloon_usd.farm import chunk_lines, in_chunks  # noqa: PLC0415

    return chunk_lines(
        [_absolute(Path(plan.recipe.file)).relative_to(folder) for plan in chunk]
        for chunk in in_chunks(plans, size)
    )


def _words(of_run: dict[str, Any]) -> tuple[str, ...]:
    """Return options of `run` as words of its command line, but for those that are as they are by default."""
    words: list[str] = []
    for option in run.params:
        value = of_run.get(option.name or "")
        if isinstance(value, tuple):
            value = ",".join(value)
        if value and value != option.default:
            words += [option.opts[0]] if value is True else [option.opts[0], str(value)]
    return tuple(words)


def _gpus(devices: Sequence[str]) -> int:
    """Return how many GPUs a machine must have that makes them on devices: cuda:1 is the second."""
    if devices == ("all",):
        return 1
    named = [device.partition(":") for device in devices]
    return max(int(number or 0) + 1 if kind == "cuda" else 0 for kind, _, number in named)


def _write(job: JobTemplate, template: Path | None) -> None:
    from balloon_usd.farm import template_text, write_template  # noqa: PLC0415

    if template is None:
        click.echo(template_text(job.document()), nl=False)
        return
    try:
        write_template(job.document(), template)
    except OSError as error:
        text = f"{template}: cannot be written ({error.strerror or error})"
        raise Failure(text, ExitCode.NOT_WRITTEN) from error
    click.echo(f"job template {template}: {job.tasks} {'task' if job.tasks == 1 else 'tasks'}")
