"""Walls of a task as any solver takes them: points, faces, gas, and what hands hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.bench.held import Held
    from balloon_usd.bench.pinch_task import Floats, Ints


@dataclass(frozen=True)
class Walls:
    """Closed walls and what is done to them."""

    points: Floats
    """Vertices at the start, (V, 3), m."""
    rest: Floats
    """Vertices unstressed, (V, 3), m."""
    quads: Ints
    """Faces, (Q, 4)."""
    chambers: Ints
    """The faces cut in two, about the gas of each chamber, (C, T, 3)."""
    held: Held
    """What hands hold."""
    frames: int

    @property
    def triangles(self) -> Ints:
        """The triangles of all chambers, (T, 3)."""
        return self.chambers.reshape(-1, 3)
