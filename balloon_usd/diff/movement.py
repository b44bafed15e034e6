"""How far a surface lies from where it lay, time code by time code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

STILL = 1e-9
"""Distance below which nothing has moved (m)."""


class Moment(NamedTuple):
    """A surface or one of its bubbles at one time code."""

    time_code: float | None
    """None for a surface that does not move."""
    distance: float
    """Largest distance between a point and itself in the other stage; of the extents' corners where the
    surfaces have unlike points (m)."""
    vertex: int
    """Where that is; -1 where the surfaces have unlike points."""
    rms: float | None
    """Distance of all points as the root of the mean square (m); None where they are unlike."""
    volumes: tuple[float, float] | None
    """In both stages (m3); None where there is none."""

    @property
    def growth(self) -> float:
        """Change of volume as a share; 0 where there is none."""
        return self.volumes[1] / self.volumes[0] - 1.0 if self.volumes else 0.0


@dataclass(frozen=True)
class Movement:
    """How far a surface or one of its bubbles lies from where it lay, at every time code that differs."""

    bubble: str
    """Name of the subset; empty for the whole surface."""
    moments: tuple[Moment, ...]
    """In the order of time."""

    @property
    def worst(self) -> Moment:
        """The moment of the largest distance, the first of several."""
        return max(self.moments, key=lambda moment: moment.distance)

    @property
    def rms(self) -> Moment:
        """The moment at which all points together are farthest, the first of several."""
        return max(self.moments, key=lambda moment: moment.rms or 0.0)
