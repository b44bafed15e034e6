"""Devices: the option, and starting Warp without its chatter."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterator

DRIVER_MISSING = b"Could not find or load the NVIDIA CUDA driver"
"""Warp prints this on every computer without a CUDA device, where it is no news."""


def device_name(text: str) -> str:
    """Read auto, cpu, cuda or cuda:N.

    Raises:
        click.BadParameter: it is none of these.
    """
    if not re.fullmatch(r"auto|cpu|cuda(:\d{1,3})?", text, re.ASCII):
        raise click.BadParameter(f'"{text}" is no device, expected auto, cpu, cuda or cuda:N')
    return text


device_option = click.option(
    "--device",
    type=device_name,
    metavar="auto|cpu|cuda:N",
    default="auto",
    show_default=True,
    help="Where to compute; auto is the first CUDA device, else the CPU.",
)
"""Adds `--device` to a command."""


def start_device(name: str) -> str:
    """Start Warp and return the name of the device that was asked for.

    Raises:
        Failure: there is no such device; the message lists those that there are. Or the folder for compiled
            kernels cannot be made.
    """
    import warp as wp  # noqa: PLC0415

    from balloon_usd.solver.device import device_named  # noqa: PLC0415
    from balloon_usd.solver.errors import DeviceUnavailable  # noqa: PLC0415

    wp.config.log_level = wp.LOG_WARNING
    try:
        with _without_driver_warning():
            wp.get_devices()
    except OSError as error:
        raise _no_cache(error) from error
    try:
        return device_named(name)
    except DeviceUnavailable as error:
        raise Failure(str(error), ExitCode.BAD_INPUT) from error


@contextmanager
def compiling() -> Iterator[None]:
    """Tell in one line when the block cannot write compiled kernels.

    Raises:
        Failure: their folder cannot be written, or its disk is full.
    """
    import warp as wp  # noqa: PLC0415

    try:
        yield
    except OSError as error:
        cache = wp.config.kernel_cache_dir
        if cache is None or not str(error.filename or "").startswith(str(cache)):
            raise
        raise _no_cache(error) from error


def _no_cache(error: OSError) -> Failure:
    place = f"{error.filename}: " if error.filename else ""
    text = f"{place}compiled kernels cannot be kept here ({error.strerror or error})"
    return Failure(f"{text}, set WARP_CACHE_PATH to a folder that can be written", ExitCode.BAD_INPUT)


@contextmanager
def _without_driver_warning() -> Iterator[None]:
    """Hold back what native code writes to the error stream, and pass on all but the missing driver."""
    sys.stderr.flush()
    kept = os.dup(2)
    with tempfile.TemporaryFile() as held:
        os.dup2(held.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            held.seek(0)
            told = [line for line in held if DRIVER_MISSING not in line]
            os.write(2, b"".join(told))
