"""A shot: the sculpture by reference, on a studio's ground, with lights and cameras.

Asset and shot are two files, so that a sculpture that is used elsewhere brings no lights along.
"""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Kind, Sdf, Usd
from balloon_usd.stage.error import writing
from balloon_usd.stage.layer_metadata import set_time_range, set_units
from balloon_usd.stage.shot_camera import frame_box
from balloon_usd.stage.studio import author_camera, author_ground, author_lights

if TYPE_CHECKING:
    from pathlib import Path

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take
    from balloon_usd.stage.workspace import Workspace

ROOT = Sdf.Path("/shot")
CAMERA = "camera"
"""Camera that sees the sculpture all the time: the flat tube is much longer than what is made of it."""
CLOSE = "camera_finished"
"""Camera that sees the finished sculpture from near by."""


def shot_name(stem: str) -> str:
    """File of the shot, beside the stage whose files are called so."""
    return f"{stem}_shot.usda"


def write_shot(description: StageDescription, take: Take, work: Workspace, opened: Path, file: str) -> Path:
    """Write the shot into a file beside the built stage, which is opened by its file `opened`; returns it.

    Raises:
        StageError: The file cannot be written.
    """
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, ROOT.name)
    set_time_range(layer, description.fps, take.first, take.last)
    layer.documentation = f"{description.title}, in a studio"
    _author_studio(Usd.Stage.Open(layer), take)
    # A stage that is open would look for the asset beside the layer, which has no place yet.
    sculpture = layer.GetPrimAtPath(ROOT.AppendChild("sculpture"))
    asset = PurePosixPath(work.built.name, opened)
    sculpture.referenceList.prependedItems.append(Sdf.Reference(f"./{asset}"))
    built, final = (path.with_name(file) for path in (work.built, work.final))
    with writing(final):
        layer.Export(str(built))
    return built


def _author_studio(stage: Any, take: Take) -> None:
    Usd.ModelAPI(stage.DefinePrim(ROOT, "Xform")).SetKind(Kind.Tokens.assembly)
    stage.DefinePrim(ROOT.AppendChild("sculpture"), "Xform")
    view = frame_box(take.extent)
    author_camera(stage, ROOT.AppendChild(CAMERA), view)
    author_camera(stage, ROOT.AppendChild(CLOSE), frame_box(take.final.extent))
    author_lights(stage, ROOT, take.extent, view.ahead)
    author_ground(stage, ROOT, take.extent, view.ahead)
