"""Where a stage came from: facts that name the recipe and the solver, and nothing of the run."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

SCHEMA = 3
"""Version of the layout of prims, attributes and files."""

KEY = "balloon_usd"
"""Key in customLayerData, and namespace of the package's own attributes."""

GIVEN = ("recipe", "recipe_sha256", "solver")
"""Facts that a description must bring."""

COMPLETE = (*GIVEN, "detail", "fps", "schema", "version")
"""Facts that every written layer carries."""

# Facts of the run would make two files of one recipe differ.
RUN_DEPENDENT = frozenset(
    {"created", "cwd", "date", "duration", "elapsed", "folder", "host", "hostname", "machine", "modified"}
    | {"pid", "timestamp", "user"}
)

ABSOLUTE = re.compile(r"[/\\]|[A-Za-z]:[/\\]|[a-z]+://")


def provenance_of(
    given: Mapping[str, str | int | float], fps: float, detail: str
) -> dict[str, str | int | float]:
    """Provenance for the layers of one detail: the facts that were given and the writer's own."""
    own: dict[str, str | int | float] = {"detail": detail, "fps": float(fps), "schema": SCHEMA}
    return {"version": __version__, **given, **own}


def failure_of(cause: str, last: int) -> dict[str, str | int | float]:
    """What the root layer says besides, if the simulation failed: why, and the last frame before that."""
    return {"failed": cause, "last_good_frame": last}


def problems(facts: Mapping[str, object], required: tuple[str, ...]) -> Iterator[str]:
    """What is missing from the facts, or must not be among them, one sentence each."""
    for key in required:
        if key not in facts:
            yield f'provenance has no "{key}"'
    for key, value in facts.items():
        if RUN_DEPENDENT & set(key.lower().split("_")):
            yield f'provenance "{key}" depends on the run'
        if isinstance(value, str) and ABSOLUTE.match(value):
            yield f'provenance "{key}" holds an absolute path: {value}'
