"""The air that balloons are filled with and stand in."""

from __future__ import annotations

GAS_CONSTANT = 8.314462618
"""Molar gas constant, J/(mol K) (CODATA 2018)."""
ATMOSPHERE = 101325.0
"""Standard atmosphere, Pa (ISO 2533)."""
ROOM_TEMPERATURE = 293.15
"""Temperature of the gas, K. It stays isothermal: walls are thin and moves are slow."""
AIR_DENSITY = 1.29
"""Density of air at room temperature and 7 kPa gauge, kg/m3."""
