"""Formats that hold one moment in a file: OBJ, PLY and VTU."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.mesh_file.libraries import library

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from balloon_usd.exchange.merged_mesh import MergedMesh


def write_still(merged: MergedMesh, time_code: float, file: Path) -> None:
    """Write one moment into a file; the ending says in which format.

    Raises:
        OSError: the file cannot be written.
    """
    writers = {".obj": _write_obj, ".ply": _write_ply, ".vtu": _write_vtu}
    writers[file.suffix](merged, time_code, file)


def meshio_mesh(merged: MergedMesh, time_code: float, *, fields: bool = True) -> Any:
    """Return one moment as a `meshio.Mesh`, with all fields or bare."""
    blocks = [(cells.kind, cells.corners) for cells in merged.cells]
    return library("meshio").Mesh(
        merged.points(time_code),
        blocks,
        point_data=merged.fields(time_code) if fields else {},
        cell_data=cell_fields(merged) if fields else {},
    )


def cell_fields(merged: MergedMesh) -> dict[str, list[Any]]:
    """Return what faces know, by name, an array (F,) for each block of cells."""
    bubble = {"bubble": [cells.bubble for cells in merged.cells]} if merged.has_bubbles else {}
    return {"balloon": [cells.balloon for cells in merged.cells], **bubble}


def _write_vtu(merged: MergedMesh, time_code: float, file: Path) -> None:
    library("meshio").vtu.write(str(file), meshio_mesh(merged, time_code))


def _write_ply(merged: MergedMesh, time_code: float, file: Path) -> None:
    mesh = meshio_mesh(merged, time_code)
    # PLY as meshio writes it has no fields of faces.
    mesh.cell_data = {}
    made = io.BytesIO()
    library("meshio").ply.write(made, mesh)
    head, _, dated = made.getvalue().partition(b"comment Created by meshio")
    # The rest of the line is a date: equal stages give equal bytes.
    body = dated.split(b"\n", 1)[1]
    comment = f"comment {_title(merged, time_code)}\n".encode("ascii", "replace")
    file.write_bytes(head + comment + body)


def _write_obj(merged: MergedMesh, time_code: float, file: Path) -> None:
    """Write objects named by balloons, and in them groups named by bubbles; OBJ has no fields."""
    made = io.StringIO()
    library("meshio").obj.write(made, meshio_mesh(merged, time_code, fields=False))
    lines = iter(made.getvalue().splitlines())
    # The first line is a date: equal stages give equal bytes.
    next(lines)
    with file.open("w", encoding="utf-8", newline="\n") as out:
        out.write(f"# {_title(merged, time_code)}\n")
        out.writelines(f"{next(lines)}\n" for _ in range(len(merged.points(time_code))))
        faces = np.array(list(lines), dtype=object)
        balloon = np.concatenate([cells.balloon for cells in merged.cells])
        bubble = np.concatenate([cells.bubble for cells in merged.cells])
        for number, name in enumerate(merged.balloons):
            out.write(f"o {name}\n")
            mine = balloon == number
            _write_groups(out, faces[mine], bubble[mine], merged.bubbles)


def _write_groups(out: Any, faces: NDArray[Any], bubble: NDArray[np.int32], names: tuple[str, ...]) -> None:
    """Write lines of faces (F,), those of each bubble together."""
    for number in np.unique(bubble):
        if 0 <= number < len(names):
            out.write(f"g {names[number]}\n")
        out.writelines(f"{face}\n" for face in faces[bubble == number])


def _title(merged: MergedMesh, time_code: float) -> str:
    return f"{merged.scene.title}, time code {time_code:g}, in metres, z up"
