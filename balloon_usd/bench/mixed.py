"""Different recipes in one batch, against each alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.bench.bench_recipes import MIXED
from balloon_usd.bench.timing import measure, planned

if TYPE_CHECKING:
    from balloon_usd.bench.timing import Timing


def mixed_timings(detail: str, device: str, most: int | None) -> tuple[list[Timing], Timing]:
    """Return the timings of every recipe alone and of all together, over the same frames."""
    plans = {name: planned(text) for name, text in MIXED.items()}
    whole = measure("together", list(plans.values()), detail, device, most)
    frames = whole.frames + 2
    return [measure(name, [plan], detail, device, frames, threads=1) for name, plan in plans.items()], whole
