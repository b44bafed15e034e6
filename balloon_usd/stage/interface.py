"""The interface: the thin layer on top that people open, whose variants bring the payloads."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from balloon_usd.openusd import Sdf, Vt
from balloon_usd.stage.detail_files import detail_files
from balloon_usd.stage.layer_metadata import set_provenance, set_units
from balloon_usd.stage.prim_paths import class_path, root_path
from balloon_usd.stage.provenance import KEY, failure_of
from balloon_usd.stage.variant_sets import DETAIL, FINISHED, MADE, STATE, add_variant
from balloon_usd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take
    from balloon_usd.stage.wanted import Wanted

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


def author_outcome(layer: Any, root: Any, take: Take, wanted: Wanted) -> None:
    """Say in the root layer what is known of the frames, and whether the simulation failed.

    The file has another name if it did.
    """
    if wanted.facts:
        set_provenance(layer, {**layer.customLayerData[KEY], **wanted.facts})
    if wanted.failed:
        set_provenance(layer, {**layer.customLayerData[KEY], **failure_of(wanted.failed, take.last)})
        ending = PurePosixPath(root.GetInfo("assetInfo")["identifier"].path).suffix
        set_asset_info(root, f"{wanted.file_stem(root.name)}{ending}")


def set_extents_hint(prim: Any, extent: NDArray[np.float32]) -> None:
    """Say how much room the sculpture takes over all time codes, for readers that leave the payload out."""
    hint = prim.attributes.get(EXTENTS_HINT)
    if hint is None:
        hint = Sdf.AttributeSpec(prim, EXTENTS_HINT, Sdf.ValueTypeNames.Float3Array)
    hint.default = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(extent))


def add_detail(root: Any, detail: str, extents: Extents) -> None:
    """Add a variant for one detail, with one for each state in it, which brings the payload and its room."""
    files = detail_files(detail)
    states = ((MADE, files.payload, extents.made), (FINISHED, files.finished, extents.finished))
    inside = add_variant(root, DETAIL, detail)
    for state, payload, extent in states:
        variant = add_variant(inside, STATE, state)
        variant.payloadList.prependedItems.append(Sdf.Payload(f"./{payload.as_posix()}"))
        set_extents_hint(variant, extent)


def read_extents(interface: Any, name: str, detail: str) -> Extents | None:
    """The rooms that `add_detail` stored in an interface layer; None where they are not."""
    inside = root_path(name).AppendVariantSelection(DETAIL, detail)
    paths = (inside.AppendVariantSelection(STATE, state) for state in (MADE, FINISHED))
    hints = [interface.GetAttributeAtPath(path.AppendProperty(EXTENTS_HINT)) for path in paths]
    if not all(hints):
        return None
    return Extents(*(np.array(hint.default, dtype=np.float32) for hint in hints))
