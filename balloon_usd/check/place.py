"""Which file stands for what a user names."""

from __future__ import annotations

from pathlib import Path

from balloon_usd.check.opening import UnreadableError
from balloon_usd.stage.on_disk import file_of, why_not_named


def stage_file(name: str) -> Path:
    """Return the file to open: the one named, or NAME/NAME.usda for a folder NAME.

    Raises:
        UnreadableError: there is no such file, or the folder holds no stage.
    """
    path = Path(name)
    try:
        if why := why_not_named(path):
            raise UnreadableError(why)
        file = file_of(path)
        if name and file.is_file():
            return file
        if name and path.is_dir():
            raise UnreadableError(f"{name}: no stage in this folder, expected {file.name} in it")
    except (OSError, ValueError) as error:
        raise UnreadableError(f"{name}: {getattr(error, 'strerror', None) or error}") from error
    raise UnreadableError(f'"{name}": no such file or folder')
