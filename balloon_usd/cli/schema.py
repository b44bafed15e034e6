"""`balloon-usd schema`: the recipe language for editors."""

from __future__ import annotations

import json

import click

from balloon_usd.cli.failure import EXIT_CODES_HELP


@click.command(epilog=EXIT_CODES_HELP)
def schema() -> None:
    """Print the JSON Schema of recipes, for completion and checks in editors.

    Save it beside the recipes and begin them with
    "# yaml-language-server: $schema=recipe.schema.json".
    """
    from balloon_usd.recipe import recipe_schema  # noqa: PLC0415

    click.echo(json.dumps(recipe_schema(), indent=2))
