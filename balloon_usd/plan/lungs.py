"""Who can blow up a balloon: the pressures at which a flat tube begins to grow, and what lungs do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_theory import gauge_pressure, inflated_rubber, maxwell_state, pressure_maximum

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize

WEAK_LUNGS, STRONG_LUNGS = 9.0e3, 14.6e3
"""Highest pressure that lungs breathe out against, Pa: the lower limit of normal and the mean of men of 30
(Evans & Whitelaw 2009: 92 and 149 cm of water).
"""


def opening_pressure(size: BalloonSize, rubber: Rubber, *, stretched: bool) -> float:
    """Return the gauge pressure (Pa) at which a flat tube begins to grow.

    `stretched`: whether hands stretched its start as far as gas will. That is softer then, and grows at less
    than the Maxwell pressure, at which the rest follows.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    law = inflated_rubber(rubber) if stretched else rubber
    return gauge_pressure(size, max(pressure_maximum(law).p_star, maxwell_state(rubber).p_star))


def blown_by(pressure: float) -> str:
    """Return in words what blows against a pressure (Pa)."""
    if pressure > STRONG_LUNGS:
        return "a pump"
    return "strong lungs" if pressure > WEAK_LUNGS else "most lungs"
