"""Tables that are made of the code while the pages are built: they cannot be out of date."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from operation_pages import link, modifier_row, operation_page, says, table, written
from sphinx.util.docutils import SphinxDirective

from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.table import BY_WORD, OPERATIONS
from balloon_usd.quality.measures import MEASURES
from balloon_usd.recipe import Recipe
from balloon_usd.recipe.schema import model_schema
from balloon_usd.report.document import DIGITS, UNITS
from balloon_usd.solver.kernels.arrays import kosaka, latex, shared  # noqa: F401  # they fill the table
from balloon_usd.solver.kernels.arrays.table import ARRAYS, STRUCTS
from balloon_usd.stage.properties import PROPERTIES

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx


RECIPES = Path(__file__).parents[2] / "recipes"


class RecipeKeys(SphinxDirective):
    """`recipe-keys`: every key of a block of the recipe, out of the schema that editors get."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table of the block that is named: Balloon, Physics, Kosaka or a step."""
        keys = model_schema()["$defs"][self.arguments[0]]["properties"]
        rows = ((f"`{name}`", _allowed(key), _default(key), key["description"]) for name, key in keys.items())
        return self.parse_text_to_nodes(table(("key", "values", "default", "meaning"), rows))


class Operations(SphinxDirective):
    """`operations`: every operation as its example writes it, with what it does and a link to its page."""

    def run(self) -> list[nodes.Node]:
        """Return the table of all operations, in the order of their table."""
        rows = ((link(it.word), f"`{it.word}: {written(it)}`", says(it)) for it in OPERATIONS)
        return self.parse_text_to_nodes(table(("operation", "for example", "what is done"), rows))


class Gallery(SphinxDirective):
    """`gallery`: the picture of every recipe of a folder that has one, with its title and its file."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the pictures of a folder within `recipes`, in the order of their titles."""
        recipes = map(Recipe.load, (RECIPES / self.arguments[0]).glob("*.yaml"))
        pictures = Path(self.env.srcdir) / "pictures" / "gallery"
        shown = sorted((each.title, each) for each in recipes if (pictures / f"{each.name}.webp").exists())
        lines = [
            f"![{title}](/pictures/gallery/{each.name}.webp)\n\n**{title}**: `{_file(each)}`"
            for title, each in shown
        ]
        return self.parse_text_to_nodes("\n\n".join(lines))


def _file(recipe: Recipe) -> str:
    """Return where a recipe lies, from the folder above all recipes."""
    return Path(recipe.file).relative_to(RECIPES.parent).as_posix()


class OneOperation(SphinxDirective):
    """`operation`: the keys, an example, the moves and the sources of the operation that is named."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the page of an operation, but for what its author tells of it."""
        text = operation_page(BY_WORD[self.arguments[0]])
        return self.parse_text_to_nodes(text, allow_section_headings=True)


class Modifiers(SphinxDirective):
    """`modifiers`: what may stand beside operations, and beside which."""

    def run(self) -> list[nodes.Node]:
        """Return the table of all modifiers, in the order in which they are written."""
        return self.parse_text_to_nodes(table(("key", "with", "meaning"), map(modifier_row, MODIFIERS)))


class StageProperties(SphinxDirective):
    """`stage-properties`: what is true of every stage, and what to do where it is not."""

    def run(self) -> list[nodes.Node]:
        """Return the table of all properties by their numbers."""
        rows = ((str(number), it.says, it.where, it.remedy) for number, it in PROPERTIES.items())
        return self.parse_text_to_nodes(table(("", "property", "tested", "remedy"), rows))


class ReportUnits(SphinxDirective):
    """`report-units`: units of the numbers in a report, and how finely they are written."""

    def run(self) -> list[nodes.Node]:
        """Return the table of all quantities."""
        rows = ((f"`{name}`", unit, str(DIGITS[name])) for name, unit in UNITS.items())
        return self.parse_text_to_nodes(table(("quantity", "unit", "digits after the point"), rows))


class QualityMeasures(SphinxDirective):
    """`quality-measures`: what is measured of a finished figure, and its limits."""

    def run(self) -> list[nodes.Node]:
        """Return the table of all measures, in the order in which they are told."""
        rows = ((f"`{it.key}`", it.meaning, it.unit, f"{it.limit:g}") for it in MEASURES.values())
        return self.parse_text_to_nodes(table(("measure", "value", "unit", "limit"), rows))


class DeviceArrays(SphinxDirective):
    """`device-arrays`: every array on the device, in the structs in which kernels take them."""

    def run(self) -> list[nodes.Node]:
        """Return a table of each struct, those of all models first."""
        return self.parse_text_to_nodes("\n\n".join(map(_struct, STRUCTS.values())))


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


def _plain(_app: Sphinx, _context: object, lines: list[str]) -> None:
    """Take help texts of commands as they are: an asterisk is none of Sphinx's emphasis."""
    lines[:] = [line.replace("*", r"\*") for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell Sphinx of the directives."""
    app.add_directive("recipe-keys", RecipeKeys)
    app.add_directive("operations", Operations)
    app.add_directive("operation", OneOperation)
    app.add_directive("gallery", Gallery)
    app.add_directive("modifiers", Modifiers)
    app.add_directive("stage-properties", StageProperties)
    app.add_directive("report-units", ReportUnits)
    app.add_directive("quality-measures", QualityMeasures)
    app.add_directive("device-arrays", DeviceArrays)
    app.connect("sphinx-click-process-description", _plain)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
