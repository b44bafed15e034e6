"""The optional libraries that know other formats."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from balloon_usd.mesh_file.error import MeshFileError


def library(name: str) -> Any:
    """Import `meshio` or `h5py`.

    Raises:
        MeshFileError: it is not installed.
    """
    try:
        return import_module(name)
    except ImportError as error:
        raise MeshFileError(f"{name} is not installed: pip install 'balloon-usd[mesh]'") from error
