"""How a stage is wanted."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from balloon_usd.files.failed_name import failed_name

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class Wanted:
    """What is chosen for one stage."""

    detail: str
    """Level of detail."""
    look: str
    """Look that is selected, or the only one of a stage in one file."""
    shot: bool = False
    """Whether a shot stands beside it."""
    failed: str = ""
    """Why the simulation ended before its last frame; "" if it did not."""
    facts: Mapping[str, int] = field(default_factory=dict)
    """What is known of the frames once all are written, for the root layer."""

    def file_stem(self, name: str) -> str:
        """Return what the files of a sculpture of this name are called, without an ending."""
        return failed_name(name) if self.failed else name
