"""The air that balloons are filled with and stand in."""

from __future__ import annotations

GAS_CONSTANT = 8.314462618
"""Molar gas constant, J/(mol K) (CODATA 2018)."""
ATMOSPHERE = 101325.0
"""Standard atmosphere, Pa (ISO 2533)."""
ROOM_TEMPERATURE = 293.15
"""Temperature of the gas, K. It stays isothermal: walls are thin and moves are slow."""
MOLAR_MASS = 0.0289652
"""Molar mass of dry air, kg/mol (ISO 2533)."""
OUTSIDE_DENSITY = ATMOSPHERE * MOLAR_MASS / (GAS_CONSTANT * ROOM_TEMPERATURE)
"""Density of the air that balloons stand in, kg/m3."""
AIR_DENSITY = 1.29
"""Density of air at room temperature and 7 kPa gauge, kg/m3."""
