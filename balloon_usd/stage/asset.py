"""The layered asset: a small interface file over a payload of materials, samples and geometry."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, Usd
from balloon_usd.stage.built import Built
from balloon_usd.stage.detail_files import MATERIALS, PAYLOAD, TEXTURE, detail_files
from balloon_usd.stage.earlier import Earlier, carry_over, find_earlier, orphaned_texture
from balloon_usd.stage.error import writing
from balloon_usd.stage.geometry import author_geometry
from balloon_usd.stage.interface import Extents, add_detail, author_outcome, author_root, set_asset_info
from balloon_usd.stage.layer_metadata import set_provenance, set_time_range, set_units
from balloon_usd.stage.looks import looks_of
from balloon_usd.stage.materials import author_materials
from balloon_usd.stage.payload import finished_layer, payload_layer
from balloon_usd.stage.prim_paths import root_path
from balloon_usd.stage.printed import author_print_variant
from balloon_usd.stage.provenance import provenance_of
from balloon_usd.stage.samples import Layers
from balloon_usd.stage.stretch_color import ramp_legend
from balloon_usd.stage.variant_sets import DETAIL, LOOK, MADE, STATE, add_variant
from balloon_usd.stage.wire_texture import wire_png

if TYPE_CHECKING:
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take
    from balloon_usd.stage.wanted import Wanted
    from balloon_usd.stage.workspace import Workspace


def begin_asset(description: StageDescription, wanted: Wanted, work: Workspace) -> Layers:
    """Make the layers that take the samples.

    Raises:
        StageError: The folder cannot be written.
    """
    files = detail_files(wanted.detail)
    with writing(work.final):
        (work.built / PAYLOAD).mkdir(parents=True)
        layers = Layers(*(Sdf.Layer.CreateNew(str(work.built / f)) for f in (files.samples, files.stress)))
    for layer in layers.all:
        set_units(layer, description.name)
        set_provenance(layer, provenance_of(description.provenance, description.fps, wanted.detail))
    layers.stress.documentation = ramp_legend(description.highest_stretch)
    return layers


def complete_asset(
    layers: Layers, take: Take, description: StageDescription, wanted: Wanted, work: Workspace
) -> Built:
    """Save the samples, write the other layers, and take over what the asset's folder holds already.

    Raises:
        StageError: A file cannot be written.
    """
    detail, files = wanted.detail, detail_files(wanted.detail)
    interface = Path(f"{wanted.file_stem(description.name)}.usda")
    with writing(work.final):
        layers.save()
        payload_layer(description, take, detail).Export(str(work.built / files.payload))
        finished_layer(description, detail).Export(str(work.built / files.finished))
        _geometry_layer(description, take).Export(str(work.built / files.geometry))
        _materials_layer(description).Export(str(work.built / MATERIALS))
        earlier = Earlier()
        if not wanted.failed:
            earlier = find_earlier(work.final, work.built, description.name, detail)
        _interface_layer(description, take, wanted, earlier).Export(str(work.built / interface))
        stale = [file for other in earlier.stale for file in detail_files(other)]
        if description.airs:
            (work.built / TEXTURE).write_bytes(wire_png())
        else:
            stale += orphaned_texture(work.final)
        if not wanted.failed:
            carry_over(work.final, work.built, stale)
    textures = (TEXTURE,) if description.airs else ()
    return Built((interface, *files, MATERIALS, *textures), stale=earlier.stale)


def _geometry_layer(description: StageDescription, take: Take) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    stage = Usd.Stage.Open(layer)
    author_geometry(stage, description, take.final)
    author_print_variant(stage, description)
    return layer


def _materials_layer(description: StageDescription) -> Any:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer, description.name)
    author_materials(Usd.Stage.Open(layer), description, looks_of(description))
    # Defining a material has made a typeless def of the root above it.
    layer.GetPrimAtPath(root_path(description.name)).specifier = Sdf.SpecifierOver
    return layer


def _interface_layer(description: StageDescription, take: Take, wanted: Wanted, earlier: Earlier) -> Any:
    """The layer that people open: it selects the detail just written and offers the earlier ones."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_time_range(layer, description.fps, take.first, take.last)
    root = author_root(
        layer, description, provenance_of(description.provenance, description.fps, wanted.detail)
    )
    set_asset_info(root, f"{description.name}.usda")
    author_outcome(layer, root, take, wanted)
    # The first set is the strongest, and so is what a layer over the asset says of a look; and those who do
    # not load the payload know the looks.
    for look in looks_of(description):
        add_variant(root, LOOK, look)
    written = Extents(take.extent, take.final.extent)
    for name, extents in sorted({**earlier.kept, wanted.detail: written}.items()):
        add_detail(root, name, extents)
    root.variantSelections.update({DETAIL: wanted.detail, STATE: MADE, LOOK: wanted.look})
    return layer
