"""Devices: the option, and starting Warp without its chatter."""

from __future__ import annotations

import re
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from collections.abc import Iterator


def device_name(text: str) -> str:
    """Read auto, cpu, cuda or cuda:N.

    Raises:
        click.BadParameter: it is none of these.
    """
    if not re.fullmatch(r"auto|cpu|cuda(:\d{1,3})?", text, re.ASCII):
        raise click.BadParameter(f'"{text}" is no device, expected auto, cpu, cuda or cuda:N')
    return text


def devices_named(text: str) -> tuple[str, ...]:
    """Read auto, cpu, all, or CUDA devices with commas between them.

    Raises:
        click.BadParameter: it is none of these, or a device is named twice.
    """
    names = tuple(text.split(","))
    if text in {"auto", "cpu", "all", "cuda"}:
        return names
    if not all(re.fullmatch(r"cuda:\d{1,3}", name, re.ASCII) for name in names):
        expected = "auto, cpu, cuda or cuda:N, several with commas, or all"
        raise click.BadParameter(f'"{text}" is no device, expected {expected}')
    if len(set(names)) < len(names):
        raise click.BadParameter(f'"{text}" names a device twice')
    return names


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
    from balloon_usd.solver.device import device_named, start_warp  # noqa: PLC0415
    from balloon_usd.solver.errors import DeviceUnavailable  # noqa: PLC0415

    try:
        start_warp()
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
