"""Files that all get their names at the end, or none does."""

from __future__ import annotations

import os
import tempfile
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.language.problem import escaped
from balloon_usd.variation.error import VariationError, VariationNotWrittenError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator


@contextmanager
def hidden_folder(folder: Path) -> Iterator[Path]:
    """Make a folder, and within it a hidden one for the time of the block; what failed leaves no folder.

    Raises:
        VariationError: that is not possible.
    """
    made: list[Path] = []
    try:
        try:
            _make(folder, made)
            aside = tempfile.TemporaryDirectory(prefix=".variations.", dir=folder, ignore_cleanup_errors=True)
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or error
            raise VariationError([f"{escaped(str(folder))}: cannot write here ({why})"]) from error
        with aside as name:
            yield Path(name)
    except BaseException:
        for path in made:
            with suppress(OSError):
                path.rmdir()
        raise


def _make(folder: Path, made: list[Path]) -> None:
    """Make a folder and those above it; note the ones that were not there, the innermost first."""
    missing = [place for place in (folder, *folder.parents) if not os.path.lexists(place)]
    for place in reversed(missing):
        place.mkdir(exist_ok=True)
        made.insert(0, place)


def folder_problem(folder: Path) -> str | None:
    """Say what stands where the folder or one above it must."""
    for place in (folder, *folder.parents):
        if os.path.lexists(place):
            return None if place.is_dir() else f"{escaped(str(place))}: a file is in the way of the folder"
    return None


def write_text(file: Path, text: str) -> None:
    """Write UTF-8 with line ends as they stand.

    Raises:
        VariationNotWrittenError: it cannot be written.
    """
    try:
        file.write_bytes(text.encode("utf-8"))
    except OSError as error:
        what = f"{escaped(file.name)} cannot be written: {error.strerror or error}"
        raise VariationNotWrittenError([what]) from error


def give_names(aside: Path, folder: Path, names: Iterable[str]) -> None:
    """Move files out of the hidden folder, each in one step.

    Raises:
        VariationNotWrittenError: one cannot be moved.
    """
    for name in names:
        try:
            (aside / name).replace(folder / name)
        except OSError as error:
            what = f"{escaped(str(folder / name))} cannot be written: {error.strerror or error}"
            raise VariationNotWrittenError([what]) from error


def obstacles(
    files: Iterable[Path], text_of: Callable[[int], str], source: Path, *, overwrite: bool
) -> Iterator[str]:
    """Yield a line for each file that is there, and is not the one that would be written.

    Args:
        files: the files that would be written.
        text_of: returns the text of one by its number.
        source: the recipe itself, which nothing replaces.
        overwrite: let other files be replaced.
    """
    for at, file in enumerate(files):
        if not os.path.lexists(file):
            continue
        shown = escaped(str(file))
        if not file.is_file():
            yield f"{shown}: something that is no file is in the way"
        elif file.samefile(source):
            yield f"{shown}: is the recipe that is varied, expected another folder"
        elif not overwrite and _bytes(file) != text_of(at).encode("utf-8"):
            yield f"{shown}: is there already and differs, expected another folder, or --force to replace it"


def _bytes(file: Path) -> bytes | None:
    try:
        return file.read_bytes()
    except OSError:
        return None
