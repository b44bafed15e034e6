"""What came of a comparison with Blender; known to processes without it, which end badly once they load both."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Comparison:
    """What was compared and what differs."""

    findings: tuple[str, ...]
    selections: int
    frames: int
    """Frames of all selections."""
    seconds: float
    """Time of the processor."""
