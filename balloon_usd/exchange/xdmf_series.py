"""XDMF: one text file that describes an animation, and its numbers in one HDF5 file beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from balloon_usd.exchange.patient_file import PatientFile
from balloon_usd.exchange.still_formats import cell_fields
from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.mesh_file.libraries import library

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from balloon_usd.exchange.merged_mesh import MergedMesh


def require_triangles_and_quads(merged: MergedMesh) -> None:
    """Refuse faces that meshio cannot write as XDMF.

    Raises:
        MeshFileError: a face has more than four corners.
    """
    for cells in merged.cells:
        if cells.kind == "polygon":
            corners, name = cells.corners.shape[1], merged.balloons[cells.balloon[0]]
            raise MeshFileError(
                f"{name} has faces with {corners} corners, XDMF takes 3 or 4: use --format vtu, ply or obj"
            )


def write_series(merged: MergedMesh, time_codes: Sequence[float], file: Path) -> None:
    """Write moments into `file` and `file` with the ending `.h5`.

    Every moment has its own points and fields; faces and what they know stand in the HDF5 file once.

    Raises:
        OSError: a file cannot be written.
    """
    require_triangles_and_quads(merged)
    numbers = file.with_suffix(".h5")
    writer = library("meshio").xdmf.TimeSeriesWriter(file, data_format="HDF")
    # Entered as a context the writer would put the numbers into the working directory.
    writer.h5_filename = numbers.name
    still: list[Any] = []
    with numbers.open("w+b", buffering=0) as opened:
        out = PatientFile(opened)
        with library("h5py").File(out, "w") as writer.h5_file:
            for code in time_codes:
                grid = ET.SubElement(writer.collection, "Grid", Name=f"{code:g}", GridType="Uniform")
                still = still or _still_parts(writer, merged)
                # The writer would refer to them by an XInclude, which not all readers follow.
                grid.extend(still)
                writer.points(grid, merged.points(code))
                writer.point_data(merged.fields(code), grid)
                ET.SubElement(grid, "Time", Value=repr(merged.seconds(code)))
                out.require_whole()
        out.require_whole()
    ET.indent(writer.xdmf_file)
    ET.ElementTree(writer.xdmf_file).write(file, encoding="utf-8", xml_declaration=True)


def _still_parts(writer: Any, merged: MergedMesh) -> list[Any]:
    """Write the faces and their fields once; returns the elements that point there."""
    parts = ET.Element("Grid")
    writer.cells([(cells.kind, cells.corners) for cells in merged.cells], parts)
    writer.cell_data(cell_fields(merged), parts)
    return list(parts)
