"""The two thin layers on top: the interface that people open, and the payload's list of layers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Sdf, Vt

from balloon_usd import __version__
from balloon_usd.stage.layer_metadata import set_provenance, set_time_range, set_units
from balloon_usd.stage.prim_paths import class_path, root_path

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take

VARIANT_SET = "detail"
"""Variant set of the root prim: how fine the mesh is."""
EXTENTS_HINT = "extentsHint"


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


def add_detail(root: Any, detail: str, extent: NDArray[np.float32]) -> None:
    """Add a variant that brings the payload of one detail, with the room that this detail takes."""
    if VARIANT_SET not in root.variantSets:
        Sdf.VariantSetSpec(root, VARIANT_SET)
        root.variantSetNameList.prependedItems.append(VARIANT_SET)
    variant = Sdf.VariantSpec(root.variantSets[VARIANT_SET], detail).primSpec
    variant.payloadList.prependedItems.append(Sdf.Payload(f"./payload/{detail}.usda"))
    set_extents_hint(variant, extent)


def payload_layer(description: StageDescription, take: Take, detail: str) -> Any:
    """The layer that stacks materials over samples over geometry.

    The order matters: the geometry's default pose in a stronger layer would hide all samples.
    """
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    set_time_range(layer, description.fps, take.first, take.last)
    layer.subLayerPaths = ["./materials.usda", f"./{detail}_sim.usdc", f"./{detail}_geo.usdc"]
    return layer
