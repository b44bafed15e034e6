"""The kinds of stages that are written here, and which one a stage is."""

from __future__ import annotations

from enum import Enum
from typing import Any

from balloon_usd.openusd import Kind


class StageKind(Enum):
    """What a stage is for; stages of other software count as assets."""

    ASSET = "asset"
    """A sculpture in layers or in one file, Z up."""
    PACKAGE = "package"
    """A sculpture in one `.usdz`, Y up as viewers on phones want it."""
    SHOT = "shot"
    """A scene around sculptures: camera, lights, ground."""


UP_AXIS = {StageKind.ASSET: "Z", StageKind.PACKAGE: "Y", StageKind.SHOT: "Z"}
ROOT_KIND = {
    StageKind.ASSET: Kind.Tokens.component,
    StageKind.PACKAGE: Kind.Tokens.component,
    StageKind.SHOT: Kind.Tokens.assembly,
}
"""Kind of the root prim."""


def kind_of(stage: Any) -> StageKind:
    """Which kind a stage is: by the end of its file's name, and by the kind of its root prim."""
    if stage.GetRootLayer().identifier.lower().endswith(".usdz"):
        return StageKind.PACKAGE
    root = stage.GetDefaultPrim()
    if root and root.GetKind() == Kind.Tokens.assembly:
        return StageKind.SHOT
    return StageKind.ASSET
