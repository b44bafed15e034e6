"""Putting a picture where it was asked for, whole or not at all."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.files.whole_file import write_whole as write_whole_files
from balloon_usd.preview.error import PictureNotWrittenError, PreviewError

if TYPE_CHECKING:
    from PIL import Image

DEVICES = Path("/dev")
"""Where nothing is a file, even if it leads to one, as `/dev/stdout` may."""
COMPRESSION = 4
"""Of PNG files: takes 60 % of the time of zlib's usual level 6, for 20 % more bytes."""


def require_place(path: Path) -> None:
    """Look before anything is drawn whether a file may stand at a path.

    Raises:
        PreviewError: a folder, device or pipe is in the way, there is no folder to put it in, or its name is
            too long.
    """
    try:
        in_the_way, has_home = path.is_dir(), path.parent.is_dir()
        special = path.exists() and not (in_the_way or path.is_file())
    except OSError as error:
        raise PreviewError(f"{path} cannot be written: {error.strerror or error}") from error
    if in_the_way:
        raise PreviewError(f"{path} cannot be written: a folder is in the way")
    if not has_home:
        raise PreviewError(f"{path} cannot be written: {path.parent} is not a folder")
    # What takes the place of a file would take that of a device, too.
    if special or path.parent.resolve() == DEVICES:
        raise PreviewError(f"{path} cannot be written: it is a device or a pipe")


def write_png(image: Image.Image, path: Path) -> Path:
    """Write a picture whole or not at all.

    Raises:
        PictureNotWrittenError: the disk is full, or the folder cannot be written.
    """
    encoded = BytesIO()
    image.save(encoded, format="PNG", compress_level=COMPRESSION)
    return write_whole(encoded.getvalue(), path)


def write_whole(data: bytes, path: Path) -> Path:
    """Write a file beside its final name, then replace that: no half-written one is ever seen.

    Raises:
        PictureNotWrittenError: the disk is full, or the folder cannot be written.
    """
    try:
        write_whole_files({path: data})
    except OSError as error:
        raise PictureNotWrittenError(f"{path} cannot be written: {error.strerror or error}") from error
    return path
