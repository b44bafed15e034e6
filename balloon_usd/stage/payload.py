"""What an asset brings as its payload: thin layers that stack materials, samples and geometry."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf
from balloon_usd.stage.detail_files import MATERIALS, detail_files
from balloon_usd.stage.layer_metadata import set_time_range, set_units
from balloon_usd.stage.looks import STRESS
from balloon_usd.stage.prim_paths import root_path
from balloon_usd.stage.stress import STILL
from balloon_usd.stage.variant_sets import LOOK, add_variant

if TYPE_CHECKING:
    from pathlib import Path

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take


def payload_layer(description: StageDescription, take: Take, detail: str) -> Any:
    """The layer that stacks materials over samples over geometry.

    The order matters: the geometry's default pose in a stronger layer would hide all samples.
    """
    files = detail_files(detail)
    layer = _stacked(description, MATERIALS, files.samples, files.geometry)
    set_time_range(layer, description.fps, take.first, take.last)
    _add_stress(layer, description, Sdf.Reference(_beside(files.stress)))
    return layer


def finished_layer(description: StageDescription, detail: str) -> Any:
    """The layer that stacks materials over geometry, whose default pose is the finished sculpture."""
    files = detail_files(detail)
    layer = _stacked(description, MATERIALS, files.geometry)
    still = Sdf.Path.absoluteRootPath.AppendChild(STILL)
    _add_stress(layer, description, Sdf.Reference(_beside(files.stress), still))
    return layer


def _stacked(description: StageDescription, *files: Path) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    layer.subLayerPaths = [_beside(file) for file in files]
    return layer


def _add_stress(layer: Any, description: StageDescription, colors: Any) -> None:
    """Bring the colours of stretch into the look that shows them, and into no other."""
    root = Sdf.CreatePrimInLayer(layer, root_path(description.name))
    add_variant(root, LOOK, STRESS).referenceList.prependedItems.append(colors)


def _beside(file: Path) -> str:
    """A file as its neighbours name it."""
    return f"./{file.name}"
