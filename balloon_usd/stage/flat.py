"""One single-layer file with one look, for readers that do not compose: web viewers, mail."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, Usd
from balloon_usd.stage.built import Built
from balloon_usd.stage.error import writing
from balloon_usd.stage.geometry import author_geometry
from balloon_usd.stage.interface import author_outcome, author_root, set_asset_info, set_extents_hint
from balloon_usd.stage.looks import PRINT, STRESS, looks_of
from balloon_usd.stage.materials import author_materials
from balloon_usd.stage.prim_paths import root_path
from balloon_usd.stage.printed import author_print
from balloon_usd.stage.provenance import provenance_of
from balloon_usd.stage.samples import Layers
from balloon_usd.stage.wire_texture import FILE_NAME, wire_png

if TYPE_CHECKING:
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.samples import Take
    from balloon_usd.stage.wanted import Wanted
    from balloon_usd.stage.workspace import Workspace


def files_beside(description: StageDescription) -> tuple[str, ...]:
    """Names of the files that the one file needs beside it."""
    return (FILE_NAME,) if description.airs else ()


def begin_flat(description: StageDescription, wanted: Wanted, work: Workspace) -> Layers:
    """Make the one layer, with its root prim.

    Raises:
        StageError: The folder cannot be written.
    """
    return begin_single_layer(description, wanted, work, work.built)


def begin_single_layer(description: StageDescription, wanted: Wanted, work: Workspace, file: Path) -> Layers:
    """Make a file of one layer, with the root prim; the colours of stretch go into it if that is its look.

    Raises:
        StageError: The folder cannot be written.
    """
    with writing(work.final):
        layer = Sdf.Layer.CreateNew(str(file))
    root = author_root(
        layer, description, provenance_of(description.provenance, description.fps, wanted.detail)
    )
    set_asset_info(root, work.final.name)
    return Layers(layer, layer if wanted.look == STRESS else None)


def complete_flat(
    layers: Layers, take: Take, description: StageDescription, wanted: Wanted, work: Workspace
) -> Built:
    """Author what does not move beside the samples, and save.

    Raises:
        StageError: The file cannot be written.
    """
    author_rest(layers.samples, take, description, looks_of(description), wanted)
    with writing(work.final):
        layers.save()
        for name in files_beside(description):
            work.built.with_name(name).write_bytes(wire_png())
    return Built((Path(),))


def author_rest(
    layer: Any, take: Take, description: StageDescription, looks: tuple[str, ...], wanted: Wanted
) -> None:
    """Author all that does not move into the layer of the samples; `looks`: those that have materials."""
    root = layer.GetPrimAtPath(root_path(description.name))
    author_outcome(layer, root, take, wanted)
    set_extents_hint(root, take.extent)
    stage = Usd.Stage.Open(layer)
    author_geometry(stage, description, take.final)
    author_materials(stage, description, looks, wanted.look)
    if wanted.look == PRINT:
        author_print(stage, description)
