"""`balloon-usd preview`: a contact sheet of any stage."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from balloon_usd.batch.order import FrameRange
from balloon_usd.cli.child_memory import start_drawing
from balloon_usd.cli.device import device_option
from balloon_usd.cli.failure import EXIT_CODES_HELP, ExitCode, Failure
from balloon_usd.cli.frame_range import moments
from balloon_usd.cli.stage_path import stage_file, stage_home, stage_path

if TYPE_CHECKING:
    from balloon_usd.preview import View

VIEWS = ("side", "three-quarter", "front-quarter", "front", "top")
SMALLEST, LARGEST = 16, 4096
"""Sides that a picture may have (pixels)."""


@click.command(epilog=EXIT_CODES_HELP)
@click.argument("stage", metavar="STAGE", type=click.Path())
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="PNG",
    help="Default: NAME.png beside the stage.",
)
@click.option(
    "--frames",
    type=moments,
    metavar="A:B|A,B,C",
    help="Frames to draw, or a range to spread eight over. Default: the whole animation.",
)
@click.option(
    "--look",
    metavar="LOOK",
    help="Draw another look than the one selected in the stage: "
    "recipe, clear, chrome, clay, print, stress, thesis.",
)
@click.option("--view", type=click.Choice(VIEWS), default="three-quarter", show_default=True)
@click.option(
    "--columns", type=click.IntRange(1, 100), default=4, show_default=True, help="Pictures in a row."
)
@click.option(
    "--size",
    type=(click.IntRange(SMALLEST, LARGEST), click.IntRange(SMALLEST, LARGEST)),
    default=(480, 320),
    show_default=True,
    metavar="W H",
    help="Pixels of one picture.",
)
@device_option
def preview(
    stage: str,
    output: Path | None,
    frames: FrameRange | tuple[int, ...] | None,
    look: str | None,
    view: str,
    columns: int,
    size: tuple[int, int],
    device: str,
) -> None:
    """Draw a contact sheet of a USD stage, whoever made it.

    STAGE is a USD file, or a folder NAME as `run` writes it.
    """
    from balloon_usd.cli.child_process import read_in_child  # noqa: PLC0415

    if output is not None and output.suffix.lower() != ".png" and (output.is_file() or not output.exists()):
        raise Failure(f"{output}: expected a name that ends in .png", ExitCode.BAD_INPUT)
    unfinished = (output.parent, output.stem) if output else stage_home(stage)
    sheet = read_in_child(
        stage,
        unfinished,
        _draw,
        stage,
        output,
        frames,
        columns=columns,
        size=size,
        view=cast("View", view),
        look=look,
        device=device,
    )
    click.echo(f"contact sheet {sheet}")


def _draw(
    stage: str,
    output: Path | None,
    frames: FrameRange | tuple[int, ...] | None,
    *,
    columns: int,
    size: tuple[int, int],
    view: View,
    look: str | None,
    device: str,
) -> Path:
    """Draw the sheet, in a child process.

    Raises:
        Failure: the stage cannot be drawn.
    """
    path = stage_path(stage)
    file = stage_file(path)
    used = start_drawing(device)
    from balloon_usd.preview import (  # noqa: PLC0415
        PictureNotWrittenError,
        PreviewError,
        draw_contact_sheet,
    )

    try:
        return draw_contact_sheet(
            file,
            output or path.with_suffix(".png"),
            frames=_moments(file, frames),
            columns=columns,
            size=size,
            view=view,
            look=look,
            device=used,
        )
    except PictureNotWrittenError as error:
        raise Failure(str(error), ExitCode.NOT_WRITTEN) from error
    except PreviewError as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error


def _moments(file: Path, frames: FrameRange | tuple[int, ...] | None) -> tuple[float, ...] | None:
    """Return the time codes that were asked for, None for the usual ones.

    Raises:
        Failure: some are not in the stage.
    """
    from balloon_usd.preview import read_stage, spread_moments  # noqa: PLC0415

    if frames is None:
        return None
    scene = read_stage(file)
    first, last = scene.start, scene.end
    if isinstance(frames, FrameRange):
        first, last = max(first, frames.first or first), min(last, frames.last or last)
        found = spread_moments(first, last) if first <= last else ()
    else:
        found = tuple(float(code) for code in frames)
    if not found or min(found) < scene.start or max(found) > scene.end:
        raise Failure(f"{file} has frames {scene.start:g} to {scene.end:g} only", ExitCode.BAD_INPUT)
    return found
