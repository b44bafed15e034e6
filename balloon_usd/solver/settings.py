"""Settings of a scene."""

from __future__ import annotations

from dataclasses import dataclass

from balloon_usd.balloon.air import ATMOSPHERE


@dataclass(frozen=True)
class SceneSettings:
    """Settings shared by everything in a scene."""

    dt: float
    """Time step, s."""
    atmosphere: float = ATMOSPHERE
    """Ambient pressure, Pa."""
    drag: float = 5.0
    """Air drag as a rate, 1/s."""
    gravity: float = 0.0
    """Gravity towards -z, m/s2."""
    friction: float = 0.8
    """Coulomb coefficient of rubber on rubber."""
    fingers: bool = True
    """Whether fingers may ever press on a wall."""
    scale_mass: bool = True
    """Whether masses are raised until the time step is stable."""
    contact_offset: float = 1.5e-3
    """Distance at which walls begin to press, m."""
    contact_pressure: float = 1.0e4
    """Pressure that each of two walls adds at zero distance, Pa; more where more gas is behind them."""
