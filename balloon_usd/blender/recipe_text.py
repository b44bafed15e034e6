# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipe in Blender's text editor, at the place that a complaint means."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

if TYPE_CHECKING:
    from .complaint import Place

ABOVE = 5
"""Lines shown above the place."""


def show_recipe(recipe: Path, place: Place) -> Any:
    """Load the recipe, or take the one that is open, put the cursor at the place and scroll there."""
    text = _text_of(recipe)
    line = min(place.line, len(text.lines)) - 1
    text.cursor_set(line, character=min(place.column - 1, len(text.lines[line].body)))
    for screen in (window.screen for window in bpy.context.window_manager.windows):
        for area in screen.areas:
            if area.type == "TEXT_EDITOR":
                area.spaces.active.text = text
                area.spaces.active.top = max(0, line - ABOVE)
    return text


def _text_of(recipe: Path) -> Any:
    """Return the text of the file as it is now. What was edited in Blender and is not saved stays."""
    written = recipe.read_text(encoding="utf-8", errors="replace")
    for text in bpy.data.texts:
        if text.filepath and Path(bpy.path.abspath(text.filepath)) == recipe:
            if text.is_dirty or text.as_string() == written:
                return text
            bpy.data.texts.remove(text)
            break
    return bpy.data.texts.load(str(recipe))
