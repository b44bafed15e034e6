"""JSON Schema of the recipe language, for completion and checks in editors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.operations.modifiers import Entries

from .formula_schema import with_formulas
from .key_texts import key_texts
from .recipe import Recipe

if TYPE_CHECKING:
    from collections.abc import Iterator

SCHEMA_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def recipe_schema() -> dict[str, Any]:
    """JSON Schema of recipes as they are written, made from the models that check them."""
    return {"$schema": SCHEMA_DIALECT, **with_formulas(model_schema())}


def model_schema() -> dict[str, Any]:
    """Return the same of recipes that are written out, without named values, formulas and repeats."""
    found: dict[str, Any] = _without_null(Recipe.model_json_schema())
    models = {each.__name__: each for each in _models(Entries)}
    for name, definition in {Recipe.__name__: found, **found["$defs"]}.items():
        if name in models:
            for key, text in key_texts(models[name]).items():
                definition["properties"][key]["description"] = text
    return found


def _models(base: type[Entries]) -> Iterator[type[Entries]]:
    for each in base.__subclasses__():
        yield each
        yield from _models(each)


def _without_null(schema: Any) -> Any:
    """Let an optional entry be absent, but not null: editors then say what is wrong with a value."""
    if isinstance(schema, list):
        return [_without_null(entry) for entry in schema]
    if not isinstance(schema, dict):
        return schema
    entries = {key: _without_null(value) for key, value in schema.items() if value is not None}
    choices = entries.get("anyOf")
    if isinstance(choices, list) and {"type": "null"} in choices:
        kept = [choice for choice in choices if choice != {"type": "null"}]
        del entries["anyOf"]
        return {**kept[0], **entries} if len(kept) == 1 else {"anyOf": kept, **entries}
    return entries
