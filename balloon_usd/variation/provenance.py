"""Where a variation comes from: comments at its head, without dates and absolute paths."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.recipe.writer import flow_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.recipe import Recipe


def provenance_lines(recipe: Recipe, values: Mapping[str, object]) -> str:
    """Return comments with the recipe's file, the hash of its text, and what was set: YAML but for the #."""
    # A name that is not UTF-8 is escaped, as control characters are.
    lines = [f"variation of: {flow_text(Path(recipe.file).name)}", f"sha256: {recipe.sha256}"]
    lines += [f"{path}: {flow_text(value)}" for path, value in values.items()]
    return "".join(f"# {line}\n" for line in lines)
