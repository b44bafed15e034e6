"""What can go wrong while meshes leave for other formats."""

from __future__ import annotations

from balloon_usd.mesh_file.error import MeshFileError


class NotExportedError(MeshFileError):
    """A file was made, but could not be put where it belongs."""
