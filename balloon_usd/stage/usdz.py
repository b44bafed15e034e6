"""One package for viewers on phones and headsets: a single layer, Y up, in a zip that is not compressed."""

from __future__ import annotations

import shutil
import struct
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, UsdGeom, Vt
from balloon_usd.stage.built import Built
from balloon_usd.stage.error import writing
from balloon_usd.stage.flat import author_rest, begin_single_layer
from balloon_usd.stage.interface import set_extents_hint
from balloon_usd.stage.prim_paths import parts_path, root_path

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Layers, Take
    from balloon_usd.stage.wanted import Wanted
    from balloon_usd.stage.workspace import Workspace

UP_FROM_Z = -90.0
"""Turn about the x axis that stands a sculpture upright where y is up (degrees)."""

OLDEST = (1980, 1, 1, 0, 0, 0)
"""Time that a zip can say at the earliest: packages of one recipe must not differ in it."""
UNIX = 3
"""System that a package says it was made on, whichever it was."""
LOCAL_HEADER = 30
"""Bytes before the name of a file in a zip."""
ALIGNMENT = 64
"""Multiple at which the data of a file in a usdz begins [B]."""
PADDING, PADDING_ID = struct.Struct("<HH"), 0x1986
"""Head of the field that fills up the space before: its kind, as USD's own packages have it, and length."""
CHUNK = 2**20
"""Bytes copied at a time."""


def begin_usdz(description: StageDescription, wanted: Wanted, work: Workspace) -> Layers:
    """Make the layer that is packed in the end.

    Raises:
        StageError: The folder cannot be written.
    """
    return begin_single_layer(description, wanted, work, _crate(work))


def complete_usdz(
    layers: Layers, take: Take, description: StageDescription, wanted: Wanted, work: Workspace
) -> Built:
    """Author what does not move, stand it upright and pack it.

    Raises:
        StageError: The file cannot be written.
    """
    author_rest(layers.samples, take, description, (wanted.look,), wanted)
    _stand_upright(layers.samples, description.name)
    set_extents_hint(layers.samples.GetPrimAtPath(root_path(description.name)), _upright(take.extent))
    with writing(work.final):
        layers.save()
        _pack(_crate(work), work.built)
    return Built((Path(),))


def _crate(work: Workspace) -> Path:
    return work.built.with_suffix(".usdc")


def _pack(crate: Path, package: Path) -> None:
    """Store a crate in a package, at a place where it can be mapped into memory.

    USD has a writer of its own, which stores the time of day and does not notice a full disk.
    """
    entry = zipfile.ZipInfo(crate.name, OLDEST)
    entry.create_system = UNIX
    entry.file_size = crate.stat().st_size
    before = LOCAL_HEADER + len(entry.filename) + PADDING.size
    padding = -before % ALIGNMENT
    entry.extra = PADDING.pack(PADDING_ID, padding) + bytes(padding)
    with (
        zipfile.ZipFile(package, "w", zipfile.ZIP_STORED) as archive,
        crate.open("rb") as source,
        archive.open(entry, "w") as target,
    ):
        shutil.copyfileobj(source, target, CHUNK)


def _upright(extent: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return a box (2, 3) [m] with y up, of one with z up."""
    (x, y, z), (right, far, top) = extent
    return np.array([[x, z, -far], [right, top, -y]], dtype=np.float32)


def _stand_upright(layer: Any, name: str) -> None:
    """Say that y is up, and turn what lies below the root: points keep their z, and who places the root anew
    does not lay it on its side.
    """
    layer.pseudoRoot.SetInfo("upAxis", UsdGeom.Tokens.y)
    parts = layer.GetPrimAtPath(parts_path(name).GetParentPath())
    parts.typeName = "Xform"
    turn = Sdf.AttributeSpec(parts, "xformOp:rotateX", Sdf.ValueTypeNames.Float)
    turn.default = UP_FROM_Z
    order = Sdf.AttributeSpec(
        parts, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, variability=Sdf.VariabilityUniform
    )
    order.default = Vt.TokenArray([turn.name])
