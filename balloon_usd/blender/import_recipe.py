# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator behind the menu entry."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy_extras.io_utils import ImportHelper

from .arrival import bring_in
from .command import CommandMissingError, run_words
from .complaint import BAD_INPUT, cautions, first_place
from .making import Making
from .preferences import command_of
from .recipe_text import show_recipe

EVERY = 0.2
"""Time between looks at the progress (s)."""
LINES_SHOWN = 12

Outcome = set[str]

RECIPES = bpy.props.StringProperty(default="*.yaml;*.yml", options={"HIDDEN"})
DETAIL = bpy.props.EnumProperty(
    name="Detail",
    description="How fine the mesh and the time steps are",
    items=(
        ("draft", "Draft", "To try a recipe: half a minute for a dog"),
        ("preview", "Preview", "Finer"),
        ("full", "Full", "For the final picture"),
    ),
    default="draft",
)
AS_IT_IS = "AS_IT_IS"
LOOK = bpy.props.EnumProperty(
    name="Look",
    description="What the balloons are made of",
    items=(
        (AS_IT_IS, "As it is", "The colours of the recipe; wire and air with the model kosaka"),
        ("recipe", "Latex", "The colours of the recipe"),
        ("clear", "Clear", "Latex that can be seen through"),
        ("chrome", "Chrome", "Foil"),
        ("clay", "Clay", "Matt, without colours"),
        ("print", "Print", "Latex with a print that shows how it turns"),
        ("stress", "Stress", "How far the rubber is stretched, as colours"),
    ),
    default=AS_IT_IS,
)
FOLDER = bpy.props.StringProperty(
    name="Output folder",
    description="Where the stage is kept; Blender reads its points from there. Empty: beside the .blend, "
    "or beside the recipe if that is not saved yet",
    default="",
)


class ImportRecipe(bpy.types.Operator, ImportHelper):
    """Make a balloon figure from a recipe, animated, and import it."""

    bl_idname = "import_scene.balloon_recipe"
    bl_label = "Import balloon recipe"
    bl_options = {"UNDO"}  # noqa: RUF012

    filename_ext = ".yaml"
    filter_glob: RECIPES
    detail: DETAIL
    look: LOOK
    folder: FOLDER

    def invoke(self, context: Any, event: Any) -> Outcome:
        """Let the user choose a file, or of a dropped one only how it is made."""
        if self.properties.is_property_set("filepath"):
            title = Path(self.filepath).name
            return set(context.window_manager.invoke_props_dialog(self, title=title))
        return set(ImportHelper.invoke(self, context, event))

    def execute(self, context: Any) -> Outcome:
        """Start the command; wait for it only where there is no window to go on working in."""
        if not self.start(context):
            return {"CANCELLED"}
        return self.end() if bpy.app.background else self.watch(context)

    def start(self, context: Any) -> bool:
        """Start the command, or report why it cannot be."""
        self.recipe = Path(bpy.path.abspath(self.filepath))
        if not self.recipe.is_file():
            self.report({"ERROR"}, f"{self.recipe}: no such file")
            return False
        try:
            folder = output_folder(self.recipe, self.folder)
            options = ["--detail", self.detail, "-o", str(folder)]
            options += [] if self.look == AS_IT_IS else ["--look", self.look]
            self.making = Making(run_words(command_of(context), self.recipe, options), self.recipe.parent)
        except (CommandMissingError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return False
        return True

    def watch(self, context: Any) -> Outcome:
        """Look at the progress from time to time, while the user goes on working."""
        self.timer = context.window_manager.event_timer_add(EVERY, window=context.window)
        context.window_manager.progress_begin(0.0, 1.0)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> Outcome:
        """Show the progress; Esc stops the command."""
        if event.type == "ESC":
            self.cancel(context)
            self.report({"INFO"}, "Stopped, nothing is imported")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self.making.running:
            self.put_away(context)
            return self.end()
        share, doing = self.making.progress.share, self.making.progress.doing
        context.window_manager.progress_update(share)
        context.workspace.status_text_set(f"{self.recipe.name}: {share:.0%}, {doing} (Esc stops it)")
        return {"PASS_THROUGH"}

    def cancel(self, context: Any) -> None:
        """Stop the command, also when the window closes or another file is opened."""
        self.making.cancel()
        self.put_away(context)

    def put_away(self, context: Any) -> None:
        """Take timer and progress off the window."""
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        for workspace in bpy.data.workspaces:
            workspace.status_text_set(None)

    def end(self) -> Outcome:
        """Import what the command has written, or tell why there is nothing."""
        code, told = self.making.wait(), self.making.told
        if code != 0 or self.making.stage is None:
            # Of a recipe that is right only notices have places.
            place = first_place(told) if code == BAD_INPUT else None
            if place is not None:
                show_recipe(self.recipe, place)
            shown = told[:LINES_SHOWN] or [f"the command ended with {code} and wrote no stage"]
            self.report({"ERROR"}, "\n".join(shown))
            return {"CANCELLED"}
        for line in cautions(told):
            self.report({"WARNING"}, line)
        try:
            arrived = bring_in(self.making.stage)
        except (RuntimeError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{arrived.name}: {arrived.frames} frames, {arrived.fps:g} frames/s")
        return {"FINISHED"}


def output_folder(recipe: Path, folder: str) -> Path:
    """Return the folder for the stage: the one given, else that of the .blend, else that of the recipe."""
    if folder:
        return Path(bpy.path.abspath(folder))
    return Path(bpy.data.filepath).parent if bpy.data.filepath else recipe.parent
