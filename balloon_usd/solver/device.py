"""Devices by name."""

from __future__ import annotations

from threading import Thread

import warp as wp

from balloon_usd.solver.errors import DeviceUnavailable

_waking: list[Thread] = []


def device_named(name: str) -> str:
    """Return the device of a name: auto is the first CUDA device, else the CPU; cuda is the first one.

    Raises:
        DeviceUnavailable: there is no such device.
    """
    while _waking:
        _waking.pop().join()
    there: list[str] = [device.alias for device in wp.get_devices()]
    cuda = [alias for alias in there if alias.startswith("cuda")]
    wanted = {"auto": (cuda or there)[0], "cuda": (cuda or ["cuda"])[0]}.get(name, name)
    if wanted not in there:
        raise DeviceUnavailable(name, there)
    return wanted


def wake(device: str) -> None:
    """Begin to start a GPU, which takes its driver some tenths of a second, while modules are loaded.

    It must not be used before the next call of `device_named`, such as that of a simulation.
    """
    if wp.get_device(device).is_cuda:
        thread = Thread(target=lambda: wp.get_device(device).context, daemon=True)
        thread.start()
        _waking.append(thread)
