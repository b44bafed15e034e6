"""Chunks: the recipes that one task of a job makes together.

A job carries its chunks as text, a line a chunk, each a JSON list of paths below the folder of the recipes.
"""

from __future__ import annotations

import json
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from balloon_usd.plan import Plan

CHUNK_ON_CPU = 16
"""Recipes of a task: about a minute of one core, so that little is lost with a machine."""
CHUNK_ON_CUDA = 256
"""Recipes of a task where a GPU makes them: fewer leave it idle."""


def chunk_size(device: str) -> int:
    """Return how many recipes a task should make on a device (auto, cpu, cuda or cuda:N)."""
    return CHUNK_ON_CUDA if device.startswith("cuda") else CHUNK_ON_CPU


def in_chunks(plans: Iterable[Plan], size: int) -> list[list[Plan]]:
    """Divide plans into chunks of at most `size`; like goes with like, and the longest come first."""
    # What has one model and frame rate advances together, and waits for the longest of its chunk.
    ordered = sorted(
        plans,
        key=lambda plan: (plan.recipe.physics.model, plan.recipe.fps, -plan.choreography.seconds),
    )
    return [ordered[first : first + size] for first in range(0, len(ordered), size)]


def chunk_lines(chunks: Iterable[Sequence[PurePath]]) -> str:
    """Return chunks of relative paths as text, a line each.

    No brace is left in it: pairs of them are what OpenJD fills in.
    """
    lines = (json.dumps([path.as_posix() for path in chunk], ensure_ascii=False) for chunk in chunks)
    return "".join(line.replace("{", r"\u007b").replace("}", r"\u007d") + "\n" for line in lines)


def chunk_of_line(text: str, number: int) -> list[Path]:
    """Return the paths of a chunk from the text of all.

    Args:
        text: a line a chunk, see `chunk_lines`.
        number: of the line, counted from 1.

    Raises:
        ValueError: there is no such line, or it is no list of paths.
    """
    # Not splitlines: names may hold what Unicode also takes for the end of a line.
    lines = text.removesuffix("\n").split("\n")
    if not 1 <= number <= len(lines):
        raise ValueError(f"there is no chunk {number}, expected 1 to {len(lines)}")
    try:
        names = json.loads(lines[number - 1])
    except ValueError:
        names = None
    if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
        raise ValueError(f"line {number} is no JSON list of paths")
    return [Path(name) for name in names]
