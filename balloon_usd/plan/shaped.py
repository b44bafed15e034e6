"""A balloon of any closed shape: its flat wall, and how far it is blown up."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.balloon.closed_shape import ClosedShape


@dataclass(frozen=True)
class Shaped:
    """A flat balloon of any closed shape, and how far it is blown up."""

    surface: ClosedShape = field(compare=False)
    """Its unstressed wall, with the faces of the file, where it lies at the start."""
    file_sha256: str
    """Hash of the file, hexadecimal."""
    swell: float
    """Size to which it is blown up, in that of a ball of the unstretched wall."""
    volume: float
    """Volume to which it is blown up, m3."""
    pressure: float
    """Gauge pressure of that ball when it is so large, Pa."""
    seconds: float
    """Time that this takes, s."""
