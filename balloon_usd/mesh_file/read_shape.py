"""A balloon's unstressed shape from a mesh file."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.closed_shape import ClosedShape, shape_of_faces
from balloon_usd.mesh_file.closed_faces import closed_faces
from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.mesh_file.libraries import library

if TYPE_CHECKING:
    from balloon_usd.mesh_file.closed_faces import Floats, Ints

CORNERS = {"triangle": 3, "quad": 4}
"""Cells that make a wall."""
IGNORED = frozenset({"vertex", "line"})
"""Cells that stand for no wall."""
MOST_FACES = 20_000
"""Faces that a mesh may have."""


def read_shape(file: str | Path, scale: float) -> ClosedShape:
    """Return the closed surface in a mesh file of any format that meshio reads, turned outwards.

    `scale`: metres in one unit of the file. Triangles are cut into quads.

    Raises:
        MeshFileError: the file cannot be read, or its faces make no balloon; without the file's name.
    """
    points, faces = closed_faces(*_read(Path(file)))
    return shape_of_faces(scale * points, faces)


def _read(file: Path) -> tuple[Floats, list[Ints]]:
    """Return points (V, 3) and faces as they stand in a file."""
    if file.exists() and not file.is_file():
        raise MeshFileError("is no file but a folder, a pipe or a device, expected a mesh file")
    mesh = _meshio_mesh(file)
    points = np.asarray(mesh.points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] < 3:
        raise MeshFileError("no points in space, expected a closed surface of triangles or quads")
    count = sum(len(block.data) for block in mesh.cells)
    if count > MOST_FACES:
        raise MeshFileError(f"{count} faces, expected at most {MOST_FACES}: simplify it")
    faces: list[Ints] = []
    for block in mesh.cells:
        if block.type in CORNERS:
            faces += list(np.asarray(block.data, dtype=np.int32))
        elif block.type == "polygon":
            corners = len(block.data[0])
            raise MeshFileError(f"faces with {corners} corners, expected triangles and quads")
        elif block.type not in IGNORED:
            raise MeshFileError(f"cells of type {block.type}, expected triangles and quads")
    return points[:, :3], faces


def _meshio_mesh(file: Path) -> Any:
    """Read a file with meshio, which prints its errors and exits."""
    meshio = library("meshio")
    try:
        with file.open("rb"):
            pass
    except OSError as error:
        raise MeshFileError(f"cannot be read ({error.strerror or error})") from error
    if not any(suffix.lower() in meshio.extension_to_filetypes for suffix in file.suffixes[-1:]):
        raise MeshFileError(f'"{file.suffix}" is no known format, expected one such as .obj, .ply or .stl')
    silent = io.StringIO()
    try:
        with (
            contextlib.redirect_stdout(silent),
            contextlib.redirect_stderr(silent),
            np.errstate(all="ignore"),
        ):
            return meshio.read(file)
    except (Exception, SystemExit) as error:
        raise MeshFileError(f"cannot be read as {file.suffix.removeprefix('.').lower()}") from error
