"""Pressure in a ball of rubber that is blown up."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import MembraneLaw


def ball_pressure(rubber: MembraneLaw, swell: float, thinness: float) -> float:
    """Return the gauge pressure (Pa) in a ball of rubber that is stretched so many times.

    `thinness`: unstressed thickness of the wall over the unstressed radius.
    """
    stretch = max(swell, 1.0)
    return float(2.0 * thinness * rubber.nominal_stress(stretch, stretch)[0] / stretch**2)
