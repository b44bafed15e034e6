"""What a user does in Blender with the extension, and what is seen then."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np

from tests.blender.imported import attributes_of, show_frame

MODULE = "bl_ext.user_default.balloon_usd"


def install(archive: Path) -> bool:
    """Install from disk; whether the extension is enabled then."""
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.extensions.package_install_files(
        filepath=str(archive), repo="user_default", enable_on_install=True
    )
    return MODULE in bpy.context.preferences.addons


def begin(command: str) -> None:
    """Open an empty file, with the extension and its command."""
    bpy.ops.wm.read_homefile(use_empty=True)
    if MODULE not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=MODULE)
    bpy.context.preferences.addons[MODULE].preferences.command = command


def menu_entries() -> list[str]:
    """Modules that add to File > Import."""
    return [draw.__module__ for draw in bpy.types.TOPBAR_MT_file_import._dyn_ui_initialize()]


def default_command() -> str:
    """The command of a user who has set none."""
    bpy.ops.preferences.addon_enable(module=MODULE)
    return bpy.context.preferences.addons[MODULE].preferences.bl_rna.properties["command"].default


def import_recipes(command: str, *recipes: Path, **options: str) -> dict[str, object]:
    """Import recipes one after another into an empty file and look at the scene, or at the error."""
    begin(command)
    for recipe in recipes:
        try:
            bpy.ops.import_scene.balloon_recipe(filepath=str(recipe), **options)
        except RuntimeError as error:
            return {"error": str(error), "cursor": cursors(), "objects": len(bpy.data.objects)}
    return seen()


def import_among(variables: dict[str, str], command: str, recipe: Path, **options: str) -> dict[str, object]:
    """Import a recipe while Blender's own environment has more variables."""
    earlier = dict(os.environ)
    os.environ.update(variables)
    try:
        return import_recipes(command, recipe, **options)
    finally:
        os.environ.clear()
        os.environ.update(earlier)


def import_edited(command: str, recipe: Path, text: str) -> tuple[dict[str, object], dict[str, object]]:
    """Import a recipe, lift its figure, edit the file and import it again; what is seen before and after."""
    before = import_recipes(command, recipe)
    next(thing for thing in bpy.data.objects if thing.parent is None).location.z = 0.5
    recipe.write_text(text)
    bpy.ops.import_scene.balloon_recipe(filepath=str(recipe))
    return before, seen()


def bring_in(stage: Path) -> dict[str, object]:
    """Import a stage as the operator does once the command has written it."""
    begin("")
    import_module(f"{MODULE}.arrival").bring_in(stage)
    return seen()


def bring_in_again(stage: Path, changed: Path) -> dict[str, object]:
    """Import a stage by hand, replace its folder by a changed one, and import it as the operator does."""
    begin("")
    bpy.ops.wm.usd_import(filepath=str(stage))
    seen()
    stage.parent.rename(stage.parent.with_name("earlier"))
    changed.parent.rename(stage.parent)
    import_module(f"{MODULE}.arrival").bring_in(stage)
    return seen()


def mistake_beside_text_editor(command: str, recipe: Path) -> tuple[str, int]:
    """Import a recipe with a mistake while a text editor is open: the text in it and its topmost line."""
    begin(command)
    area = bpy.context.window_manager.windows[0].screen.areas[0]
    area.type = "TEXT_EDITOR"
    with suppress(RuntimeError):
        bpy.ops.import_scene.balloon_recipe(filepath=str(recipe))
    return area.spaces.active.text.name, area.spaces.active.top + 1


def mistakes(command: str, recipe: Path, *texts: str, typed: str = "") -> tuple[str, int]:
    """Import a recipe with one mistake after another, then type into its text; what Blender's text says."""
    begin(command)
    for text in texts:
        recipe.write_text(text)
        with suppress(RuntimeError):
            bpy.ops.import_scene.balloon_recipe(filepath=str(recipe))
        if typed:
            bpy.data.texts[0].cursor_set(0)
            bpy.data.texts[0].write(typed)
    [shown] = bpy.data.texts
    return shown.as_string(), shown.current_line_index + 1


def cursors() -> dict[str, tuple[int, int]]:
    """Line and column of the cursor of every text, from 1."""
    return {text.name: (text.current_line_index + 1, text.current_character + 1) for text in bpy.data.texts}


def seen() -> dict[str, object]:
    """The scene's time, and each mesh or cloud: modifiers, materials, place and its points at the last frame."""
    scene = bpy.context.scene
    things = {}
    for thing in bpy.data.objects:
        if thing.type in ("MESH", "POINTCLOUD"):
            levels = [(m.levels, m.render_levels) for m in thing.modifiers if m.type == "SUBSURF"]
            for modifier in thing.modifiers:
                modifier.show_viewport = modifier.type != "SUBSURF"
            points = attributes_of(thing, show_frame(scene.frame_end))["position"][2]
            smooth = thing.type == "MESH" and all(face.use_smooth for face in evaluated(thing).polygons)
            colors = [color_of(slot.material) for slot in thing.material_slots]
            homes = [home.name for home in thing.users_collection]
            height = thing.matrix_world.translation.z
            things[thing.name] = SimpleNamespace(
                levels=levels, points=points, smooth=smooth, colors=colors, homes=homes, height=height
            )
    rate = scene.render.fps / scene.render.fps_base
    return {
        "things": things,
        "range": (scene.frame_start, scene.frame_end),
        "rate": rate,
        "files": [file.name for file in bpy.data.cache_files],
        "materials": [material.name for material in bpy.data.materials],
    }


def evaluated(thing: bpy.types.Object) -> bpy.types.Mesh:
    return thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data


def color_of(material: bpy.types.Material) -> str | tuple[float, ...]:
    """The base colour, or the attribute that it comes from."""
    socket = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
    if socket.is_linked:
        return socket.links[0].from_node.attribute_name
    return tuple(np.float32(socket.default_value[:3]).tolist())


class Window:
    """Stands in for a window, which Blender has none of here; keeps what is shown in it."""

    def __init__(self) -> None:
        self.shown: list[str] = []
        self.shares: list[float] = []
        self.timers = 0
        self.window, self.window_manager, self.workspace = None, self, self
        self.preferences = bpy.context.preferences

    def event_timer_add(self, _every: float, *, window: object) -> str:
        self.timers += 1
        return "timer"

    def event_timer_remove(self, _timer: str) -> None:
        self.timers -= 1

    def modal_handler_add(self, _operator: object) -> None: ...

    def progress_begin(self, _low: float, _high: float) -> None: ...

    def progress_end(self) -> None: ...

    def progress_update(self, share: float) -> None:
        self.shares.append(share)

    def status_text_set(self, text: str) -> None:
        self.shown.append(text)


def operator_in_window(command: str, recipe: Path) -> tuple[object, Window]:
    """The operator, started in a window; Blender makes operators only where it runs them."""
    begin(command)
    written = vars(import_module(f"{MODULE}.import_recipe").ImportRecipe)
    reports: list[tuple[set[str], str]] = []
    methods = {name: value for name, value in written.items() if callable(value)}
    of_user = {"filepath": str(recipe), "folder": "", "detail": "draft", "look": "AS_IT_IS"}
    told = {"reports": reports, "report": lambda _self, kind, text: reports.append((kind, text))}
    operator, window = type("Operator", (), {**methods, **of_user, **told})(), Window()
    assert operator.start(window)
    assert operator.watch(window) == {"RUNNING_MODAL"}
    return operator, window


def invoke(*, dropped: bool) -> list[str]:
    """Choose the menu entry, or drop a recipe: what Blender is asked to show."""
    begin("")
    asked: list[str] = []
    written = vars(import_module(f"{MODULE}.import_recipe").ImportRecipe)
    manager = SimpleNamespace(
        invoke_props_dialog=lambda _operator, title: asked.append(title) or {"RUNNING_MODAL"},
        fileselect_add=lambda _operator: asked.append("a file browser"),
    )
    given = SimpleNamespace(is_property_set=lambda _name: dropped)
    operator = type(
        "Operator", (), {"invoke": written["invoke"], "filepath": "/a/bud.yaml", "properties": given}
    )
    assert operator().invoke(SimpleNamespace(window_manager=manager), None) == {"RUNNING_MODAL"}
    return asked


def takes_drops() -> tuple[str, str, list[bool]]:
    """Of the file handler: operator, extensions, and whether it takes a file over a 3D view, elsewhere, nowhere."""
    begin("")
    handler = import_module(f"{MODULE}.dropped_recipe").DroppedRecipe
    areas = (SimpleNamespace(type="VIEW_3D"), SimpleNamespace(type="OUTLINER"), None)
    taken = [handler.poll_drop(SimpleNamespace(area=area)) for area in areas]
    return handler.bl_import_operator, handler.bl_file_extensions, taken


def watch_to_the_end(command: str, recipe: Path, begun: Path) -> dict[str, object]:
    """Import in a window, waiting for the command; make a file once the window shows that it has begun."""
    operator, window = operator_in_window(command, recipe)
    outcome = {"PASS_THROUGH"}
    while outcome == {"PASS_THROUGH"}:
        time.sleep(0.02)
        assert operator.modal(window, SimpleNamespace(type="MOUSEMOVE")) == {"PASS_THROUGH"}
        outcome = operator.modal(window, SimpleNamespace(type="TIMER"))
        if window.shares[-1] > 0.0:
            begun.touch()
    return {
        "outcome": outcome,
        "reports": operator.reports,
        "progress": tuple(operator.making.progress),
        "shown": window.shown,
        "shares": window.shares,
        "timers": window.timers,
    }


def press_escape(command: str, recipe: Path, meanwhile: Path) -> dict[str, object]:
    """Import in a window, and press Esc as soon as the command has written a file: process ids, a line each."""
    operator, window = operator_in_window(command, recipe)
    while not (meanwhile.exists() and meanwhile.read_text().endswith("\n")):
        time.sleep(0.02)
        operator.modal(window, SimpleNamespace(type="TIMER"))
    outcome = operator.modal(window, SimpleNamespace(type="ESC"))
    return {
        "outcome": outcome,
        "reports": operator.reports,
        "alive": still_alive([int(pid) for pid in meanwhile.read_text().split()]),
        "timers": window.timers,
        "objects": len(bpy.data.objects),
    }


def still_alive(pids: list[int]) -> list[int]:
    """Those that still run after some seconds; a killed process takes a moment to go."""
    end = time.monotonic() + 5.0
    while time.monotonic() < end and any(map(is_alive, pids)):
        time.sleep(0.02)
    return [pid for pid in pids if is_alive(pid)]


def is_alive(pid: int) -> bool:
    """Whether a process runs; one that ended and waits for its parent does not."""
    state = Path(f"/proc/{pid}/stat")
    if Path("/proc/self").exists():
        return state.exists() and state.read_text().rpartition(")")[2].split()[0] != "Z"
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def folders(recipe: Path, saved: Path) -> list[str]:
    """Where stages go: before the .blend is saved, after it, and with a folder of the user's."""
    begin("")
    output_folder = import_module(f"{MODULE}.import_recipe").output_folder
    found = [output_folder(recipe, "")]
    bpy.ops.wm.save_as_mainfile(filepath=str(saved))
    found += [output_folder(recipe, ""), output_folder(recipe, "//stages")]
    return [str(folder) for folder in found]
