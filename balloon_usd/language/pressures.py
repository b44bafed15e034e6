"""Pressures as artists read them: in kilopascals, to a tenth."""

from __future__ import annotations


def kilopascals(pressure: float) -> str:
    """Return a pressure (Pa) rounded to a tenth: `7.1 kPa`."""
    return f"{pressure / 1e3:.1f} kPa"
