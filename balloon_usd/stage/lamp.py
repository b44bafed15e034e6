"""Rectangular lamps of a studio, as seen from the camera."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Lamp:
    """A rectangular lamp that faces the sculpture; radiances do not depend on the scene's size."""

    name: str
    azimuth: float
    """From behind the camera, positive to its right (rad)."""
    elevation: float
    """Above the horizon (rad)."""
    width: float
    """Half opening angle to the side, seen from the sculpture (rad)."""
    height: float
    """Half opening angle upwards (rad)."""
    radiance: float
    """Relative to a white wall."""
