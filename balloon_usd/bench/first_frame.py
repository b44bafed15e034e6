"""How long the first frame takes: with compiled kernels, without, and whether anything is compiled twice."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from balloon_usd.bench.bench_recipes import CLASSIC_DOG, MOUSE, PAIR
from balloon_usd.bench.child import Child, ChildTask


@dataclass(frozen=True)
class Start:
    """One start of a process."""

    name: str
    seconds: float
    """From the start of the process to the first frame that was computed (s)."""
    compiled: int
    """Modules of kernels that were compiled for it."""


OTHERS = (
    ("the same again", (CLASSIC_DOG,), 0),
    ("another recipe", (MOUSE,), 0),
    ("more balloons", (CLASSIC_DOG, PAIR), 0),
    ("another detail", (CLASSIC_DOG,), 1),
)
"""Starts after the first: recipes that advance together, and which detail: that asked for or the other."""


def starts(detail: str, device: str) -> list[Start]:
    """Start processes one after the other that share a folder for kernels, empty at first."""
    found = []
    details = (detail, "preview" if detail == "draft" else "draft")
    with tempfile.TemporaryDirectory() as cache:
        for name, recipes, which in (("nothing compiled", (CLASSIC_DOG,), 0), *OTHERS):
            before = _modules(cache)
            child = Child(ChildTask(recipes, details[which], device), cache)
            seconds = child.first_frame()
            child.end()
            found.append(Start(name, seconds, len(_modules(cache) - before)))
    return found


def _modules(cache: str) -> set[str]:
    """Folders of compiled modules."""
    return {path.name for path in Path(cache).rglob("wp_*") if path.is_dir()}
