"""How Sphinx builds these pages: `sphinx-build -W docs out/docs`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd import __version__

if TYPE_CHECKING:
    from sphinx.application import Sphinx

project = "balloon_usd"
author = "balloon_usd maintainers"
copyright = author  # noqa: A001
release = version = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_click"]
exclude_patterns = ["_build", "examples"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4

# Docstrings write code in single backticks.
default_role = "code"
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = f"balloon_usd {release}"


def _plain(_app: Sphinx, _context: object, lines: list[str]) -> None:
    """Take help texts of commands as they are: an asterisk is none of Sphinx's emphasis."""
    lines[:] = [line.replace("*", r"\*") for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell Sphinx what to do with help texts."""
    app.connect("sphinx-click-process-description", _plain)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
