# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user sets once: the command."""

from __future__ import annotations

from typing import Any

import bpy

DEFAULT_COMMAND = "balloon-usd"
COMMAND = bpy.props.StringProperty(
    name="Command",
    description=(
        "Runs balloon-usd: its path, or words such as uvx balloon-usd. "
        "Blender does not know the virtual environments of your shell"
    ),
    default=DEFAULT_COMMAND,
)


class Preferences(bpy.types.AddonPreferences):
    """Shown where the extension is enabled."""

    bl_idname = __package__

    command: COMMAND

    def draw(self, _context: Any) -> None:
        """Show the command."""
        self.layout.prop(self, "command")


def command_of(context: Any) -> str:
    """Return the command that the user has set."""
    return str(context.preferences.addons[__package__].preferences.command)
