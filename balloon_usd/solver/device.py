"""Devices by name."""

from __future__ import annotations

import os
import sys
import tempfile
from contextlib import contextmanager
from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.solver.errors import DeviceUnavailable

if TYPE_CHECKING:
    from collections.abc import Iterator

DRIVER_MISSING = b"Could not find or load the NVIDIA CUDA driver"
"""Warp prints this on every computer without a CUDA device, where it is no news."""


def start_warp() -> None:
    """Start Warp without its chatter.

    Raises:
        OSError: the folder for compiled kernels cannot be made.
    """
    wp.config.log_level = wp.LOG_WARNING
    with _without_driver_warning():
        wp.get_devices()


def has_backend(device: str) -> bool:
    """Tell whether Warp runs kernels on a device: a build for GPUs alone lists the CPU too."""
    return device != "cpu" or wp.is_cpu_available()


def device_named(name: str) -> str:
    """Return the device of a name: auto is the first CUDA device, else the CPU; cuda is the first one.

    Raises:
        DeviceUnavailable: there is no such device.
    """
    there: list[str] = [device.alias for device in wp.get_devices()]
    cuda = [alias for alias in there if alias.startswith("cuda")]
    wanted = {"auto": (cuda or there)[0], "cuda": (cuda or ["cuda"])[0]}.get(name, name)
    if wanted not in there:
        raise DeviceUnavailable(name, there)
    return wanted


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
