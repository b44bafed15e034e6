"""The stage room: frames stream into a time-sampled USD asset that any DCC tool opens.

Knows no recipe, no plan and no solver: `write_stage` takes a description of the meshes, and of the
air in them where there is any, and an iterator of frames. `balloon_usd.stage.properties` holds what
is true of every stage written here.
"""

from __future__ import annotations

from balloon_usd.stage.description import AirDescription, MeshDescription, StageDescription, StageFrame
from balloon_usd.stage.error import StageError
from balloon_usd.stage.write import StageWriter, WrittenStage, write_stage

__all__ = [
    "AirDescription",
    "MeshDescription",
    "StageDescription",
    "StageError",
    "StageFrame",
    "StageWriter",
    "WrittenStage",
    "write_stage",
]
