"""What is promised of the speed, to stand beside what was measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.bench.timing import Timing


@dataclass(frozen=True)
class Target:
    """A value that is promised."""

    value: float
    unit: str
    least: bool = True
    """Whether the value is the least that is promised, else the most."""

    def beside(self, measured: float) -> str:
        """Return the target and whether a measured value keeps it."""
        kept = measured >= self.value if self.least else measured <= self.value
        sign = ">=" if self.least else "<="
        return f"{sign} {self.value:g}{self.unit}: {'kept' if kept else 'missed'}"


RATE, TIMES = " frames/s", " x one"

DOG_ON_CPU = Target(48.0, RATE)
"""The draft dog on one core: twice real time."""
DRAFT_DOG_ON_GPU = Target(600.0, RATE)
"""The draft dog on an H200: 25 times real time."""
FULL_DOG_ON_GPU = Target(240.0, RATE)
"""The full dog on an H200: ten times real time."""
BATCH_RATE_ON_GPU = Target(25_000.0, RATE)
"""256 draft dogs at once on an H200, over their whole animation."""
BATCH_ON_GPU = Target(50.0, TIMES)
"""256 draft dogs at once on an H200, against one after the other."""
CROWD_ON_GPU = Target(0.8, " of linear")
"""4096 draft dogs at once on an H200, against 256."""
CAPSULE_ON_CPU = Target(21.0, RATE)
"""The thesis's capsule on one core: what its author's GeForce GTX 280 did."""
CAPSULE_ON_GPU = Target(2000.0, RATE)
"""The thesis's capsule on an H200."""
PINCH = Target(8.0, " ms", least=False)
"""Pinch and turn of 1602 vertices, processor time for a frame."""
CROSSINGS = Target(0.0, " crossings", least=False)
"""Edges that pierce a wall after pinch and turn."""
FIRST_FRAME = Target(2.0, " s", least=False)
"""From the start of the process to the first frame, with compiled kernels."""
COMPILING = Target(15.0, " s", least=False)
"""The same without, on a CPU."""
MIXED_COST = Target(1.1, " x parts", least=False)
"""Time for different recipes together, in what they take one by one."""
WRITING = Target(2.0, " x plain", least=False)
"""Time to write a stage, in that of a plain write of as many bytes."""
READING = Target(20.0, " s", least=False)
"""Check of a stage of 40 000 vertices and 1000 frames, and its diff with another."""
MEMORY = Target(1.1, " x memory", least=False)
"""Memory for all frames, in that for a tenth of them."""
BATCH_ON_DISK = Target(8000.0, RATE)
"""256 draft dogs on an H200 with 16 cores: frames on disk, from the start of the process to its end."""
DOG_ON_DISK = Target(500.0, RATE)
"""One draft dog on an H200: frames on disk between the first and the last."""
CORES_SHARE = 0.95
"""Share of the cores' full throughput that a run on all of them reaches."""
PROCESSES_SHARE = 0.9
"""Share of the cores' full throughput that as many processes reach."""

BATCH, CROWD = 256, 4096
"""Copies of which a throughput is promised."""


def target_of(model: str, detail: str, timing: Timing, measured: Mapping[int, Timing], *, cuda: bool) -> str:
    """Return the target of a measurement and whether it is kept; empty where nothing is promised.

    `measured`: the same with other numbers of copies.
    """
    rates = {copies: one.rate for copies, one in measured.items()}
    if model == "kosaka" and timing.copies == 1 and timing.name == "20 cm":
        return (CAPSULE_ON_GPU if cuda else CAPSULE_ON_CPU).beside(timing.rate)
    if model == "latex" and timing.copies == 1:
        alone = {
            ("draft", False): DOG_ON_CPU,
            ("draft", True): DRAFT_DOG_ON_GPU,
            ("full", True): FULL_DOG_ON_GPU,
        }.get((detail, cuda))
        return alone.beside(timing.rate) if alone else ""
    if (model, detail, cuda) == ("latex", "draft", True):
        if timing.copies == BATCH:
            told = BATCH_RATE_ON_GPU.beside(timing.rate)
            return f"{told}, {BATCH_ON_GPU.beside(timing.rate / rates[1])}" if 1 in rates else told
        if timing.copies == CROWD and BATCH in rates:
            return CROWD_ON_GPU.beside(timing.rate / rates[BATCH])
    return ""
