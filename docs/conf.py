"""How Sphinx builds these pages: `sphinx-build -W docs out/docs`."""

from __future__ import annotations

import sys
from pathlib import Path

from balloon_usd import __version__

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "balloon_usd"
author = "balloon_usd maintainers"
copyright = author  # noqa: A001
release = version = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_click", "generated_tables"]
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
