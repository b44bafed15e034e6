# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""A recipe dropped on the 3D view is imported, too."""

from __future__ import annotations

from typing import Any

import bpy

from .import_recipe import ImportRecipe


class DroppedRecipe(bpy.types.FileHandler):
    """Takes recipes that are dragged from a file browser."""

    bl_idname = "IMPORT_FH_balloon_recipe"
    bl_label = "Balloon recipe"
    bl_import_operator = ImportRecipe.bl_idname
    bl_file_extensions = ".yaml;.yml"

    @classmethod
    def poll_drop(cls, context: Any) -> bool:
        """Only on the 3D view."""
        return context.area is not None and context.area.type == "VIEW_3D"
