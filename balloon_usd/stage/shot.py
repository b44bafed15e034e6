"""A shot: the sculpture by reference, on a studio's ground, with lights and cameras.

Asset and shot are two files, so that a sculpture that is used elsewhere brings no lights along.
"""

from __future__ import annotations

import math
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Gf, Kind, Sdf, Usd, UsdGeom
from balloon_usd.stage.error import writing
from balloon_usd.stage.layer_metadata import set_time_range, set_units
from balloon_usd.stage.shot_camera import frame_box
from balloon_usd.stage.studio import DECIMALS, author_camera, author_ground, author_lights

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


LOWERING_SECONDS = 1.0
"""Time in which a sculpture is set down that was held above the ground while it was made, s."""


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
    _author_studio(Usd.Stage.Open(layer), take, description.fps, lands=description.lands)
    # A stage that is open would look for the asset beside the layer, which has no place yet.
    sculpture = layer.GetPrimAtPath(ROOT.AppendChild("sculpture"))
    asset = PurePosixPath(work.built.name, opened)
    sculpture.referenceList.prependedItems.append(Sdf.Reference(f"./{asset}"))
    built, final = (path.with_name(file) for path in (work.built, work.final))
    with writing(final):
        layer.Export(str(built))
    return built


def _author_studio(stage: Any, take: Take, fps: float, *, lands: bool) -> None:
    Usd.ModelAPI(stage.DefinePrim(ROOT, "Xform")).SetKind(Kind.Tokens.assembly)
    sculpture = UsdGeom.Xform.Define(stage, ROOT.AppendChild("sculpture"))
    room = take.extent
    if lands:
        lift = max(-float(take.extent[0, 2]), 0.0)
        room = take.extent + np.array([[0.0, 0.0, lift]], np.float32)
        room[0, 2] = 0.0
        if take.below:
            _lift(sculpture, lift, take, fps)
    view = frame_box(room)
    author_camera(stage, ROOT.AppendChild(CAMERA), view)
    author_camera(stage, ROOT.AppendChild(CLOSE), frame_box(take.final.extent))
    author_lights(stage, ROOT, room, view.ahead)
    author_ground(stage, ROOT, room, view.ahead)


def _lift(sculpture: Any, lift: float, take: Take, fps: float) -> None:
    """Hold a sculpture so far above the ground (m) as long as anything would be below, and set it down."""
    last = min(take.below + math.ceil(LOWERING_SECONDS * fps), take.last)
    move = sculpture.AddTranslateOp()
    for time_code in range(take.below, last + 1):
        share = (time_code - take.below) / max(last - take.below, 1)
        height = lift * 0.5 * (1.0 + math.cos(math.pi * share)) if last > take.below else lift
        move.Set(Gf.Vec3d(0.0, 0.0, round(height, DECIMALS)), time_code)
