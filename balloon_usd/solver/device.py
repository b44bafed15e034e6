"""Devices by name."""

from __future__ import annotations

import warp as wp

from balloon_usd.solver.errors import DeviceUnavailable


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
