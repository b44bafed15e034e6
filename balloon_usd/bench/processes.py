"""Processes side by side, against one alone."""

from __future__ import annotations

from balloon_usd.bench.bench_recipes import CLASSIC_DOG
from balloon_usd.bench.child import Child, ChildTask

FRAMES = 48
"""Frames that every process is timed for unless others are asked for: two seconds of animation."""


def together(count: int, detail: str, device: str, frames: int | None) -> float:
    """Let so many processes simulate a dog each at once and return their frames per second in all."""
    task = ChildTask((CLASSIC_DOG,), detail, device, frames or FRAMES)
    children = [Child(task) for _ in range(count)]
    try:
        for child in children:
            child.first_frame()
        for child in children:
            child.run()
        slowest = max(child.seconds() for child in children)
    finally:
        for child in children:
            child.end()
    return count * task.frames / slowest
