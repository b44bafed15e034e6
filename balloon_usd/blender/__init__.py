# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import > Balloon recipe (.yaml): a Blender extension.

It runs `balloon-usd` as a program of its own and imports the stage that it writes. Nothing of the
package is imported here, nor does the package import this: Blender's Python is another one, and
this folder is under Blender's licence, see LICENSE in it.
"""

from __future__ import annotations

from typing import Any

import bpy

from .dropped_recipe import DroppedRecipe
from .import_recipe import ImportRecipe
from .preferences import Preferences

CLASSES = (Preferences, ImportRecipe, DroppedRecipe)


def register() -> None:
    """Add the operator and its place in the menu."""
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.TOPBAR_MT_file_import.append(_menu_entry)


def unregister() -> None:
    """Take both away again."""
    bpy.types.TOPBAR_MT_file_import.remove(_menu_entry)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


def _menu_entry(menu: Any, _context: Any) -> None:
    menu.layout.operator(ImportRecipe.bl_idname, text="Balloon recipe (.yaml)")
