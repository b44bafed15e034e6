"""Tables, examples and galleries in the pages that are made of the code and the recipes.

`python docs/tables.py` writes them anew; a test holds that they are up to date. Each stands between
`<!-- generated: WHAT WORDS -->` and `<!-- end of generated -->`, so that pages read well unbuilt.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from operation_pages import modifier_row, operation_page, says, table, written

from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.table import BY_WORD, OPERATIONS
from balloon_usd.quality.measures import MEASURES
from balloon_usd.recipe import Recipe
from balloon_usd.recipe.schema import model_schema
from balloon_usd.report.document import DIGITS, UNITS
from balloon_usd.solver.kernels.arrays import kosaka, latex, shared
from balloon_usd.solver.kernels.arrays.table import ARRAYS, STRUCTS
from balloon_usd.stage.properties import PROPERTIES

if TYPE_CHECKING:
    from collections.abc import Callable

DOCS = Path(__file__).parent
RECIPES = DOCS.parent / "recipes"
GENERATED = re.compile(r"<!-- generated: (.+?) -->\n.*?<!-- end of generated -->", re.DOTALL)
LANGUAGES = {".py": "python", ".usda": "text", ".yaml": "yaml"}


def filled(page: Path) -> str:
    """Return a page with all that is generated in it written anew.

    Raises:
        KeyError: it asks for what nothing makes.
    """

    def made(found: re.Match[str]) -> str:
        what, *words = found[1].split()
        text = MAKERS[what](page, *words).strip()
        return f"<!-- generated: {found[1]} -->\n\n{text}\n\n<!-- end of generated -->"

    return GENERATED.sub(made, page.read_text(encoding="utf-8"))


def recipe_keys(_page: Path, block: str) -> str:
    """Return every key of a block of the recipe, Balloon, Physics or Kosaka, out of the schema."""
    keys = model_schema()["$defs"][block]["properties"]
    rows = ((f"`{name}`", _allowed(key), _default(key), key["description"]) for name, key in keys.items())
    return table(("key", "values", "default", "meaning"), rows)


def operations(page: Path) -> str:
    """Return every operation as its example writes it, with what it does and a link to its page."""
    rows = ((_link(page, it.word), f"`{it.word}: {written(it)}`", says(it)) for it in OPERATIONS)
    return table(("operation", "for example", "what is done"), rows)


def gallery(page: Path, folder: str) -> str:
    """Return the picture of every recipe of a folder that has one, with its title and its file."""
    recipes = map(Recipe.load, (RECIPES / folder).glob("*.yaml"))
    pictures = DOCS / "pictures" / "gallery"
    shown = sorted((each.title, each) for each in recipes if (pictures / f"{each.name}.webp").exists())
    lines = [
        f"![{title}]({_relative(page, pictures / f'{each.name}.webp')})\n\n**{title}**: `{_file(each)}`"
        for title, each in shown
    ]
    return "\n\n".join(lines)


def example(_page: Path, name: str) -> str:
    """Return a file of the examples."""
    file = DOCS / "examples" / name
    return f"```{LANGUAGES[file.suffix]}\n{file.read_text(encoding='utf-8').rstrip()}\n```"


def operation(_page: Path, word: str) -> str:
    """Return the keys, an example, the moves and the sources of an operation."""
    return operation_page(BY_WORD[word])


def modifiers(_page: Path) -> str:
    """Return what may stand beside operations, and beside which."""
    return table(("key", "with", "meaning"), map(modifier_row, MODIFIERS))


def stage_properties(_page: Path) -> str:
    """Return what is true of every stage, and what to do where it is not."""
    rows = ((str(number), it.says, it.where, it.remedy) for number, it in PROPERTIES.items())
    return table(("", "property", "tested", "remedy"), rows)


def report_units(_page: Path) -> str:
    """Return units of the numbers in a report, and how finely they are written."""
    rows = ((f"`{name}`", unit, str(DIGITS[name])) for name, unit in UNITS.items())
    return table(("quantity", "unit", "digits after the point"), rows)


def quality_measures(_page: Path) -> str:
    """Return what is measured of a finished figure, and its limits."""
    rows = ((f"`{it.key}`", it.meaning, it.unit, f"{it.limit:g}") for it in MEASURES.values())
    return table(("measure", "value", "unit", "limit"), rows)


def device_arrays(_page: Path) -> str:
    """Return every array on the device, in the structs that kernels take, those of all models first."""
    modules = [module.__name__ for module in (shared, latex, kosaka)]
    structs = (each for module in modules for each in STRUCTS.values() if each.cls.__module__ == module)
    return "\n\n".join(map(_struct, structs))


MAKERS: dict[str, Callable[..., str]] = {
    "device-arrays": device_arrays,
    "example": example,
    "gallery": gallery,
    "modifiers": modifiers,
    "operation": operation,
    "operations": operations,
    "quality-measures": quality_measures,
    "recipe-keys": recipe_keys,
    "report-units": report_units,
    "stage-properties": stage_properties,
}
"""What can be asked for, and what makes it, given the page and the words behind it."""


def _file(recipe: Recipe) -> str:
    """Return where a recipe lies, from the folder above all recipes."""
    return Path(recipe.file).relative_to(RECIPES.parent).as_posix()


def _link(page: Path, word: str) -> str:
    """Return a link from a page to that of an operation."""
    return f"[`{word}`]({_relative(page, DOCS / 'reference' / 'operations' / f'{word}.md')})"


def _relative(page: Path, file: Path) -> str:
    return Path(os.path.relpath(file, page.parent)).as_posix()


def _struct(struct: Any) -> str:
    """Return what a struct holds, with the table of its arrays."""
    specs = [ARRAYS[name] for name in struct.vars]
    rows = ((f"`{a.name}`", a.type_name, " x ".join(map(str, a.shape)), a.unit, a.meaning) for a in specs)
    says = f"**`{struct.key}`** (`{struct.cls.__module__.rpartition('.')[2]}`): {struct.cls.__doc__}"
    return f"{says}\n\n{table(('array', 'type', 'shape', 'unit', 'meaning'), rows)}"


def _allowed(key: dict[str, Any]) -> str:
    """Words, or a range of numbers."""
    if "enum" in key:
        return ", ".join(
            f"`{word}`" for word in key["enum"] if not isinstance(word, str) or not word.isdigit()
        )
    if "maximum" in key:
        return f"{key.get('minimum', 0):g} to {key['maximum']:g}"
    return {"boolean": "`true`, `false`", "string": "text"}.get(key.get("type", ""), "")


def _default(key: dict[str, Any]) -> str:
    default = key.get("default")
    return "" if default is None or isinstance(default, dict) else f"`{str(default).lower()}`"


def main() -> None:
    """Write all pages anew that are out of date, and tell which."""
    for page in sorted(DOCS.rglob("*.md")):
        text = filled(page)
        if text != page.read_text(encoding="utf-8"):
            page.write_text(text, encoding="utf-8")
            print(page.relative_to(DOCS.parent))  # noqa: T201


if __name__ == "__main__":
    main()
