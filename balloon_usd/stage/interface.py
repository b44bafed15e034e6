"""The two thin layers on top: the interface that people open, and the payload's list of layers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from pxr import Sdf, Vt

from balloon_usd import __version__
from balloon_usd.stage.layer_metadata import set_provenance, set_time_range, set_units
from balloon_usd.stage.looks import STRESS
from balloon_usd.stage.looks import VARIANT_SET as LOOKS
from balloon_usd.stage.prim_paths import class_path, root_path
from balloon_usd.stage.stress import STILL

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take

VARIANT_SET = "detail"
"""Variant set of the root prim: how fine the mesh is."""
STATE = "state"
"""Variant set within each detail: the sculpture as it is made, or as it is in the end."""
MADE = "made"
"""The whole animation."""
FINISHED = "finished"
"""The final pose alone, without any time sample."""
EXTENTS_HINT = "extentsHint"


class Extents(NamedTuple):
    """Room that one detail takes: smallest and largest corner (2, 3) [m]."""

    made: NDArray[np.float32]
    """Over all time codes."""
    finished: NDArray[np.float32]
    """In the end."""


def author_root(layer: Any, description: StageDescription, facts: Mapping[str, str | int | float]) -> Any:
    """Author the head of the layer and the root prim as a component; returns the root's spec.

    `layer` may hold the root already.
    """
    name = description.name
    set_units(layer, name)
    set_provenance(layer, facts)
    layer.documentation = description.title
    Sdf.CreatePrimInLayer(layer, class_path(name))
    for path in class_path(name).GetPrefixes():
        layer.GetPrimAtPath(path).specifier = Sdf.SpecifierClass
    root = Sdf.CreatePrimInLayer(layer, root_path(name))
    root.specifier, root.typeName, root.kind = Sdf.SpecifierDef, "Xform", "component"
    root.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=["GeomModelAPI"]))
    root.inheritPathList.prependedItems.append(class_path(name))
    return root


def set_asset_info(root: Any, file_name: str) -> None:
    """Name the asset and the file that stands for it."""
    identifier = Sdf.AssetPath(f"./{file_name}")
    root.SetInfo("assetInfo", {"identifier": identifier, "name": root.name, "version": __version__})


def set_extents_hint(prim: Any, extent: NDArray[np.float32]) -> None:
    """Say how much room the sculpture takes over all time codes, for readers that leave the payload out."""
    hint = Sdf.AttributeSpec(prim, EXTENTS_HINT, Sdf.ValueTypeNames.Float3Array)
    hint.default = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(extent))


def add_detail(root: Any, detail: str, extents: Extents) -> None:
    """Add a variant for one detail, with one for each state in it, which brings the payload and its room."""
    inside = _variant(root, VARIANT_SET, detail)
    for state, ending, extent in ((MADE, "", extents.made), (FINISHED, f"_{FINISHED}", extents.finished)):
        variant = _variant(inside, STATE, state)
        variant.payloadList.prependedItems.append(Sdf.Payload(f"./payload/{detail}{ending}.usda"))
        set_extents_hint(variant, extent)


def read_extents(interface: Any, name: str, detail: str) -> Extents | None:
    """The rooms that `add_detail` stored in an interface layer; None where they are not."""
    inside = root_path(name).AppendVariantSelection(VARIANT_SET, detail)
    paths = (inside.AppendVariantSelection(STATE, state) for state in (MADE, FINISHED))
    hints = [interface.GetAttributeAtPath(path.AppendProperty(EXTENTS_HINT)) for path in paths]
    if not all(hints):
        return None
    return Extents(*(np.array(hint.default, dtype=np.float32) for hint in hints))


def _variant(prim: Any, variant_set: str, variant: str) -> Any:
    """The spec of a prim within a new variant."""
    if variant_set not in prim.variantSets:
        Sdf.VariantSetSpec(prim, variant_set)
        prim.variantSetNameList.prependedItems.append(variant_set)
    return Sdf.VariantSpec(prim.variantSets[variant_set], variant).primSpec


def payload_layer(description: StageDescription, take: Take, detail: str) -> Any:
    """The layer that stacks materials over samples over geometry.

    The order matters: the geometry's default pose in a stronger layer would hide all samples.
    """
    layer = _stacked(description, "./materials.usda", f"./{detail}_sim.usdc", f"./{detail}_geo.usdc")
    set_time_range(layer, description.fps, take.first, take.last)
    _add_stress(layer, description, Sdf.Reference(f"./{detail}_stress.usdc"))
    return layer


def finished_layer(description: StageDescription, detail: str) -> Any:
    """The layer that stacks materials over geometry, whose default pose is the finished sculpture."""
    layer = _stacked(description, "./materials.usda", f"./{detail}_geo.usdc")
    still = Sdf.Path.absoluteRootPath.AppendChild(STILL)
    _add_stress(layer, description, Sdf.Reference(f"./{detail}_stress.usdc", still))
    return layer


def _stacked(description: StageDescription, *files: str) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    layer.subLayerPaths = list(files)
    return layer


def _add_stress(layer: Any, description: StageDescription, colors: Any) -> None:
    """Bring the colours of stretch into the look that shows them, and into no other."""
    root = Sdf.CreatePrimInLayer(layer, root_path(description.name))
    _variant(root, LOOKS, STRESS).referenceList.prependedItems.append(colors)
