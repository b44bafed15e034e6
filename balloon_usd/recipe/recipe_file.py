"""Get the text of a recipe file, however unfit the file is."""

from __future__ import annotations

import os
from pathlib import Path

from balloon_usd.language.marks import Marks
from balloon_usd.language.problem import Place, RecipeError
from balloon_usd.language.yaml_reader import BYTES_LIMIT, place_in

FilePath = str | os.PathLike[str]


def read_recipe_file(path: FilePath) -> str:
    """Read a file of at most 256 KiB as UTF-8.

    Raises:
        RecipeError: if it is missing, a folder, unreadable, too long, or not UTF-8.
    """
    data = _bytes(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8-sig", "replace")
        what = f"byte 0x{data[error.start]:02X} is not UTF-8, expected a text file saved as UTF-8"
        raise _refusal(path, what, place_in(before + "?", len(before))) from error


def _bytes(path: FilePath) -> bytes:
    try:
        if Path(path).is_dir():
            raise _refusal(path, "is a folder, expected a recipe file")
        with Path(path).open("rb") as file:
            data = file.read(BYTES_LIMIT + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, RecipeError):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise _refusal(path, f"cannot be read ({reason}), expected a recipe file") from error
    if len(data) > BYTES_LIMIT:
        raise _refusal(path, f"the recipe is too long, expected at most {BYTES_LIMIT} bytes")
    return data


def _refusal(path: FilePath, text: str, at: Place | None = None) -> RecipeError:
    return RecipeError([Marks(str(path)).problem((), text, at)])
