"""Which file stands for what a user names."""

from __future__ import annotations

from pathlib import Path

from balloon_usd.check.opening import UnreadableError


def stage_file(name: str) -> Path:
    """Return the file to open: the one named, or NAME/NAME.usda for a folder NAME.

    Raises:
        UnreadableError: there is no such file, or the folder holds no stage.
    """
    path = Path(name)
    try:
        name.encode("utf-8")
        if name and path.is_file():
            return path
        folder = path.resolve() if path.name in {"", ".."} else path
        if name and path.is_dir():
            file = folder / f"{folder.name}.usda"
            if file.is_file():
                return file
            raise UnreadableError(f"{name}: no stage in this folder, expected {file.name} in it")
    except UnicodeEncodeError as error:
        shown = name.encode("utf-8", "backslashreplace").decode()
        raise UnreadableError(f"{shown}: the path is not UTF-8, which USD needs") from error
    except (OSError, ValueError) as error:
        raise UnreadableError(f"{name}: {getattr(error, 'strerror', None) or error}") from error
    raise UnreadableError(f'"{name}": no such file or folder')
