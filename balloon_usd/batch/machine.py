"""How many processes work on a batch, and how many sculptures advance together."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

SIMULATORS_PER_GPU = 2
"""While one sees to the hands of its sculptures, the other has the device. With a third one, 768 dogs took an
H200 7 % longer."""
TOGETHER = 128
"""Sculptures that advance together on a GPU at most: about one for each multiprocessor of an H100."""
ENOUGH_FOR_TWO = 96
"""Sculptures from which on two simulators with half of them each are as fast as one: fewer leave
multiprocessors idle."""
VERTEX_BYTES = 6000
"""Device memory for a vertex of a batch, with all that goes with it [B]."""
SHARE_OF_MEMORY = 0.4
"""Share of a device's free memory that one simulator may fill."""
MOST_DRAWERS = 2
"""Processes that draw contact sheets beside a GPU: each holds a context of it, some 260 MB, and waits for its
turn while others simulate."""
MOST_DRAWERS_ALONE = 12
"""The same when simulators and writers have ended, and left their memory."""
RECIPES_PER_WRITER = 4
"""Recipes below which another writer does not pay for its start."""
MOST_WRITERS = 16
"""Writers for each GPU at most, however many cores there are."""

GPU_DRIVERS = (Path("/dev/nvidiactl"), Path("/dev/dxg"))
"""What the driver of CUDA devices brings on Linux, and on Linux below Windows."""


def _has_gpu() -> bool:
    """Whether there may be a CUDA device; asking CUDA itself takes half a second."""
    return sys.platform == "win32" or any(driver.exists() for driver in GPU_DRIVERS)


@dataclass(frozen=True)
class Device:
    """A device that simulates."""

    name: str
    processors: int = 0
    """Multiprocessors; 0 of a CPU."""
    free_bytes: int = 0

    @property
    def is_gpu(self) -> bool:
        """Whether many sculptures advance on it together."""
        return self.processors > 0

    def together(self, vertices: int, recipes: int) -> int:
        """Return how many sculptures of so many vertices each make a batch, of so many recipes in all."""
        if not self.is_gpu:
            return 1
        fitting = int(SHARE_OF_MEMORY * self.free_bytes) // (VERTEX_BYTES * max(vertices, 1))
        batches = -(-recipes // TOGETHER)
        if batches == 1 and recipes >= ENOUGH_FOR_TWO:
            batches = 2
        return max(1, min(-(-recipes // batches), fitting))


@dataclass(frozen=True)
class Machine:
    """What a batch may use."""

    cores: int
    devices: tuple[str, ...] = ("auto",)
    """Names of devices; auto is the first CUDA device, else the CPU, all is every CUDA device."""

    def __post_init__(self) -> None:
        """Refuse a machine on which nothing can be made; raises `ValueError`."""
        if self.cores < 1:
            raise ValueError(f"{self.cores} cores make nothing, expected at least 1")
        if not self.devices:
            raise ValueError('no device, expected names of some, such as ("cpu",)')

    @property
    def may_fall_back(self) -> bool:
        """Whether the CPU takes over from a GPU that is gone."""
        return self.devices == ("auto",)

    def first_simulators(self, recipes: int) -> tuple[str, ...]:
        """Return devices on which so many recipes need a simulator in any case, before more is known."""
        if self.devices == ("cpu",) or (self.devices == ("auto",) and not _has_gpu()):
            return self.devices * min(self.cores, recipes)
        return self.devices * (SIMULATORS_PER_GPU if recipes >= ENOUGH_FOR_TWO * len(self.devices) else 1)

    def writers(self, recipes: int) -> int:
        """Return how many writers so many recipes keep busy: at most one for two cores, or for a GPU more."""
        wanted = -(-recipes // RECIPES_PER_WRITER)
        # How many GPUs all are is not known yet; a machine with several has many cores.
        for_gpus = self.cores if self.devices == ("all",) else MOST_WRITERS * len(self.devices)
        most = max(1, min(for_gpus, self.cores - SIMULATORS_PER_GPU - 1, -(-3 * self.cores // 4)))
        return max(1, min(wanted, most))

    def drawers(self, recipes: int, *, alone: bool = False) -> int:
        """Return how many processes draw contact sheets of so many recipes, where a GPU simulates.

        `alone`: nothing else is at work any more.
        """
        most = min(MOST_DRAWERS_ALONE, 3 * self.cores // 4) if alone else min(MOST_DRAWERS, self.cores // 4)
        return max(1, min(most, -(-recipes // RECIPES_PER_WRITER)))

    def threads(self, sculptures: int) -> int:
        """Return how many threads of a CPU make one sculpture, when so many are made or wait to be."""
        return max(1, self.cores // max(1, sculptures))

    def simulators(self, device: Device, batches: int) -> int:
        """Return how many simulators a device gets for so many batches."""
        most = SIMULATORS_PER_GPU if device.is_gpu else self.cores
        return max(1, min(batches, most))
