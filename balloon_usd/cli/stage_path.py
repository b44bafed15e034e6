"""A stage as the command line names it: a file, or a folder NAME as `run` writes it."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.cli.output import require_readable_name
from balloon_usd.cli.sources import is_folder


def stage_path(stage: str) -> Path:
    """Return the path of a stage or of its folder, with a name.

    Raises:
        Failure: there is no name to go by.
    """
    path = Path(stage)
    if stage and path.name in {"", ".."}:
        path = path.resolve()
    if not stage or not path.name:
        raise Failure(f'"{stage}" is no stage, expected a USD file or a folder', ExitCode.BAD_INPUT)
    require_readable_name(path)
    return path


def stage_home(stage: str) -> tuple[Path, str]:
    """Return the folder that a stage lies in, and the name of what is made of it; "" if it has none."""
    path = Path(stage)
    with suppress(OSError):
        path = path if path.name not in {"", ".."} else path.resolve()
    return path.parent, path.stem if stage else ""


def stage_file(path: Path) -> Path:
    """Return the file of a stage, given by itself or by its folder."""
    from balloon_usd.stage.on_disk import file_of  # noqa: PLC0415

    return file_of(path) if is_folder(path) else path
