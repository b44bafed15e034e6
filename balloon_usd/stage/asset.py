"""The layered asset: a small interface file over a payload of materials, samples and geometry."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pxr import Sdf, Usd

from balloon_usd.stage import looks
from balloon_usd.stage.built import Built
from balloon_usd.stage.earlier import (
    MATERIALS,
    TEXTURE,
    Earlier,
    carry_over,
    detail_files,
    find_earlier,
    orphaned_texture,
)
from balloon_usd.stage.error import writing
from balloon_usd.stage.geometry import author_geometry
from balloon_usd.stage.interface import VARIANT_SET, add_detail, author_root, payload_layer, set_asset_info
from balloon_usd.stage.layer_metadata import set_provenance, set_time_range, set_units
from balloon_usd.stage.materials import author_materials
from balloon_usd.stage.prim_paths import root_path
from balloon_usd.stage.provenance import provenance_of
from balloon_usd.stage.wire_texture import wire_png

if TYPE_CHECKING:
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take
    from balloon_usd.stage.workspace import Workspace


def begin_asset(description: StageDescription, detail: str, work: Workspace) -> Any:
    """Make the layer that takes the samples.

    Raises:
        StageError: The folder cannot be written.
    """
    file = work.built / detail_files(detail)[1]
    with writing(work.final):
        file.parent.mkdir(parents=True)
        layer = Sdf.Layer.CreateNew(str(file))
    set_units(layer, description.name)
    set_provenance(layer, provenance_of(description, detail))
    return layer


def complete_asset(
    layer: Any, take: Take, description: StageDescription, detail: str, work: Workspace
) -> Built:
    """Save the samples, write the other layers, and take over what the asset's folder holds already.

    Raises:
        StageError: A file cannot be written.
    """
    payload, samples, geometry = detail_files(detail)
    interface = Path(f"{description.name}.usda")
    with writing(work.final):
        layer.Save()
        payload_layer(description, take, detail).Export(str(work.built / payload))
        _geometry_layer(description, take).Export(str(work.built / geometry))
        _materials_layer(description).Export(str(work.built / MATERIALS))
        earlier = find_earlier(work.final, work.built, description.name, detail)
        interface_layer = _interface_layer(description, take, detail, earlier)
        interface_layer.Export(str(work.built / interface))
        stale = [file for other in earlier.stale for file in detail_files(other)]
        if description.airs:
            (work.built / TEXTURE).write_bytes(wire_png())
        else:
            stale += orphaned_texture(work.final)
        carry_over(work.final, work.built, stale)
    textures = (TEXTURE,) if description.airs else ()
    files = (interface, payload, samples, geometry, MATERIALS, *textures)
    return Built(files, stale=earlier.stale)


def _geometry_layer(description: StageDescription, take: Take) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    author_geometry(Usd.Stage.Open(layer), description, take.final)
    return layer


def _materials_layer(description: StageDescription) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    author_materials(Usd.Stage.Open(layer), description)
    # Defining a material has made a typeless def of the root above it.
    layer.GetPrimAtPath(root_path(description.name)).specifier = Sdf.SpecifierOver
    return layer


def _interface_layer(description: StageDescription, take: Take, detail: str, earlier: Earlier) -> Any:
    """The layer that people open: it selects the detail just written and offers the earlier ones."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_time_range(layer, description.fps, take.first, take.last)
    root = author_root(layer, description, provenance_of(description, detail))
    set_asset_info(root, f"{description.name}.usda")
    for name, extent in sorted({**earlier.kept, detail: take.extent}.items()):
        add_detail(root, name, extent)
    root.variantSelections[VARIANT_SET] = detail
    if description.airs:
        root.variantSelections[looks.VARIANT_SET] = looks.THESIS
    return layer
