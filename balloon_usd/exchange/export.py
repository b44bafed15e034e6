"""From a stage to files of other formats: whole or not at all."""

from __future__ import annotations

from math import ceil, floor
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args
from xml.etree import ElementTree as ET

import numpy as np

from balloon_usd.exchange.error import NotExportedError
from balloon_usd.exchange.merged_mesh import merged_mesh
from balloon_usd.exchange.still_formats import write_still
from balloon_usd.exchange.xdmf_series import require_triangles_and_quads, write_series
from balloon_usd.language.choices import unknown
from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.mesh_file.libraries import library
from balloon_usd.openusd import Tf, usd_access
from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.read_stage import read_stage
from balloon_usd.stage.error import StageError
from balloon_usd.stage.on_disk import file_of
from balloon_usd.stage.workspace import Workspace

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.exchange.merged_mesh import MergedMesh

Format = Literal["obj", "ply", "vtu", "xdmf"]
FORMATS: tuple[Format, ...] = get_args(Format)

MOST = 1_000_000
"""Frames that are exported unasked: a stage that claims more may be a damaged one."""


@usd_access()
def export_stage(
    stage: str | Path, folder: str | Path, form: Format, *, frames: Sequence[int] | None = None
) -> tuple[Path, ...]:
    """Write the meshes of a USD stage, joined, into files of another format and return those files.

    `stage`: a file, or a folder NAME as `run` writes it. `frames`: whole time codes; None for all of them, or
    for the only moment of a stage without animation.
    OBJ, PLY and VTU get a file for each moment, VTU an index `NAME.pvd` besides; XDMF gets one for all.
    Memory does not grow with the number of frames. Lengths are in metres, z points up.

    Raises:
        MeshFileError: the stage cannot be read or has no such frame, or the format cannot hold it.
        NotExportedError: the disk is full, or a folder is in the way.
        ValueError: there is no such format.
        TypeError: frames are no whole numbers.
    """
    if form not in FORMATS:
        raise ValueError(unknown("format", form, FORMATS))
    codes = None if frames is None else [index(frame) for frame in frames]
    for name in ("meshio", "h5py") if form == "xdmf" else ("meshio",):
        library(name)
    stage = file_of(Path(stage))
    merged = _read(stage)
    name, home = stage.stem, Path(folder)
    moments = _time_codes(merged, str(stage), codes)
    if form == "xdmf":
        require_triangles_and_quads(merged)
        files: dict[Path, float] = {home / f"{name}.xdmf": moments[0], home / f"{name}.h5": moments[0]}
    elif _moves(merged):
        files = {home / f"{name}.{code:04.0f}.{form}": code for code in moments}
    else:
        files = {home / f"{name}.{form}": moments[0]}
    guide = [home / f"{name}.pvd"] if form == "vtu" and _moves(merged) else []
    try:
        # What a damaged stage holds may be no numbers.
        with np.errstate(invalid="ignore"):
            return _publish(merged, moments, files, guide)
    except Tf.ErrorException as error:
        raise MeshFileError(f"{stage} is damaged and cannot be read") from error


@usd_access()
def stage_range(stage: str | Path) -> tuple[int, int]:
    """Return the first and last whole time code of a stage.

    Raises:
        MeshFileError: the stage cannot be read.
    """
    scene = _read(stage).scene
    return ceil(scene.start), floor(scene.end)


def _read(stage: str | Path) -> MergedMesh:
    try:
        return merged_mesh(read_stage(stage))
    except PreviewError as error:
        raise MeshFileError(str(error)) from error
    except Tf.ErrorException as error:
        raise MeshFileError(f"{stage} is damaged and cannot be read") from error


def _publish(
    merged: MergedMesh, codes: Sequence[float], files: dict[Path, float], index: list[Path]
) -> tuple[Path, ...]:
    """Make all files in a hidden folder, then give them their names."""
    targets = (*index, *files)
    for target in targets:
        if target.is_dir():
            raise NotExportedError(f"{target} could not be written: a folder is in the way")
    try:
        with Workspace(targets[0]) as work:
            _make(merged, codes, {work.built.with_name(file.name): code for file, code in files.items()})
            for file in index:
                _write_index(merged, files, work.built.with_name(file.name))
            work.publish(beside=[target.name for target in targets[1:]])
    except StageError as error:
        raise NotExportedError(str(error)) from error
    except PreviewError as error:
        raise MeshFileError(str(error)) from error
    except OSError as error:
        raise NotExportedError(f"{targets[0]} could not be written: {error.strerror or error}") from error
    return targets


def _make(merged: MergedMesh, codes: Sequence[float], files: dict[Path, float]) -> None:
    first = next(iter(files))
    if first.suffix == ".xdmf":
        write_series(merged, codes, first)
        return
    for file, code in files.items():
        write_still(merged, code, file)


def _write_index(merged: MergedMesh, files: dict[Path, float], file: Path) -> None:
    """Write what ParaView opens as one animation, in seconds."""
    root = ET.Element("VTKFile", type="Collection", version="0.1")
    collection = ET.SubElement(root, "Collection")
    for moment, code in files.items():
        ET.SubElement(collection, "DataSet", timestep=repr(merged.seconds(code)), file=moment.name)
    ET.indent(root)
    ET.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


def _moves(merged: MergedMesh) -> bool:
    return merged.scene.end > merged.scene.start


def _time_codes(merged: MergedMesh, stage: str, frames: Sequence[int] | None) -> tuple[float, ...]:
    scene = merged.scene
    if frames is None:
        if scene.end - scene.start > MOST:
            raise MeshFileError(f"{stage} has frames {scene.start:g} to {scene.end:g}, name some of them")
        return tuple(range(ceil(scene.start), floor(scene.end) + 1)) if _moves(merged) else (scene.start,)
    if not frames or min(frames) < scene.start or max(frames) > scene.end:
        raise MeshFileError(f"{stage} has frames {scene.start:g} to {scene.end:g} only")
    return tuple(sorted(set(frames)))
