"""What can go wrong with files of meshes."""

from __future__ import annotations


class MeshFileError(Exception):
    """A mesh cannot be read or passed on as asked; the message is one line that says why."""
