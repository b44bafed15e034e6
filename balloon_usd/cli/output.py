"""The output folder: refused before anything is computed for it."""

from __future__ import annotations

import tempfile
from typing import TYPE_CHECKING

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from balloon_usd.cli.form import Form


def require_writable(folder: Path) -> None:
    """Make the folder if need be and try to write in it.

    Raises:
        Failure: that is not possible, or its name is none that USD can read.
    """
    require_readable_name(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise Failure(
            f"{folder}: cannot write here ({error.strerror or error})", ExitCode.BAD_INPUT
        ) from error


def require_readable_name(path: Path) -> None:
    """Refuse a path by which USD can open no file.

    Raises:
        Failure: bytes of the path are not UTF-8, or control characters.
    """
    from balloon_usd.stage.on_disk import why_not_named  # noqa: PLC0415

    if why := why_not_named(path):
        raise Failure(why, ExitCode.BAD_INPUT)


def sheet_path(folder: Path, name: str) -> Path:
    """Return the file of a sculpture's contact sheet."""
    return folder / f"{name}.png"


def shot_path(folder: Path, name: str) -> Path:
    """Return the file of a sculpture's shot."""
    return folder / f"{name}_shot.usda"


def require_free(folder: Path, names: Sequence[str], form: Form, files: Iterable[Path] = ()) -> None:
    """Check that no file stands where a folder must go, nor a folder where a file must.

    `files`: what is written besides the stages of these names.

    Raises:
        Failure: with all that are in the way.
    """
    shots = [shot_path(folder, name) for name in names] if form.shot else []
    in_the_way = [f"{file}: a folder is in the way" for file in (*files, *shots) if file.is_dir()]
    for name in names:
        stage = form.stage(folder, name)
        if form.ending and stage.is_dir():
            in_the_way.append(f"{stage}: a folder is in the way")
        if not form.ending and stage.parent.exists() and not stage.parent.is_dir():
            in_the_way.append(f"{stage.parent}: a file is in the way")
    if in_the_way:
        raise Failure("\n".join(in_the_way), ExitCode.BAD_INPUT)
