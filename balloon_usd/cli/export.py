"""`balloon-usd export`: a stage's meshes as files of other formats."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from balloon_usd.batch.order import FrameRange
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.frame_range import moments
from balloon_usd.cli.output import require_writable
from balloon_usd.cli.sources import is_folder
from balloon_usd.cli.stage_path import stage_file, stage_home, stage_path

if TYPE_CHECKING:
    from balloon_usd.exchange.export import Format

FORMATS = ("obj", "ply", "vtu", "xdmf")


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("stage", metavar="STAGE", type=click.Path())
@click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    required=True,
    help="A file for each frame, but one for all with xdmf. vtu and xdmf are for ParaView.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    default=Path(),
    metavar="DIR",
    help="Folder for the files; made if need be. Default: here.",
)
@click.option(
    "--frames", type=moments, metavar="A:B|A,B,C", help="Frames to export. Default: the whole animation."
)
def export(stage: str, form: str, output: Path, frames: FrameRange | tuple[int, ...] | None) -> None:
    """Write the meshes of a USD stage into files of another format, in metres.

    STAGE is a USD file, or a folder NAME as `run` writes it. All its meshes become one, with stretch
    and pressure as fields of the points, balloon and bubble as fields of the faces.
    Needs meshio: pip install 'balloon-usd[mesh]'.
    """
    from balloon_usd.cli.child_process import read_in_child  # noqa: PLC0415

    unfinished = output, stage_home(stage)[1]
    made = not is_folder(output)
    try:
        files = read_in_child(stage, unfinished, _export, stage, cast("Format", form), output, frames)
    except BaseException:
        with suppress(OSError):
            if made:
                # Nothing came into it.
                output.rmdir()
        raise
    others = f" and {len(files) - 1} more" if len(files) > 1 else ""
    click.echo(f"{form} {files[0]}{others}")


def _export(
    stage: str, form: Format, output: Path, frames: FrameRange | tuple[int, ...] | None
) -> tuple[Path, ...]:
    """Write the files, in a child process.

    Raises:
        Failure: the stage cannot be exported.
    """
    from balloon_usd.exchange.error import NotExportedError  # noqa: PLC0415
    from balloon_usd.exchange.export import export_stage  # noqa: PLC0415
    from balloon_usd.mesh_file.error import MeshFileError  # noqa: PLC0415

    file = stage_file(stage_path(stage))
    try:
        codes = _time_codes(file, frames)
        require_writable(output)
        return export_stage(file, output, form, frames=codes)
    except NotExportedError as error:
        raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
    except MeshFileError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error


def _time_codes(file: Path, frames: FrameRange | tuple[int, ...] | None) -> tuple[int, ...] | None:
    """Return the time codes that were asked for, None for all.

    Raises:
        MeshFileError: the stage has none of them.
    """
    from balloon_usd.exchange.export import stage_range  # noqa: PLC0415

    if not isinstance(frames, FrameRange):
        return frames
    start, end = stage_range(file)
    first, last = max(frames.first or start, start), min(frames.last or end, end)
    return tuple(range(first, last + 1))
