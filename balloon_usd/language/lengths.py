"""Lengths as artists read them: in centimetres, to the millimetre."""

from __future__ import annotations

import math

_ROUND_OFF = 1e-6


def cm(length: float) -> str:
    """Return a length (m) rounded to the nearest millimetre: `7 cm`, `36.7 cm`."""
    return _text(round(length * 1e3))


def at_most(length: float) -> str:
    """Return a length (m) rounded down, so that what is written still fits."""
    return _text(math.floor(length * 1e3 + _ROUND_OFF))


def at_least(length: float) -> str:
    """Return a length (m) rounded up, so that what is written is enough."""
    return _text(math.ceil(length * 1e3 - _ROUND_OFF))


def _text(millimetres: int) -> str:
    return f"{millimetres / 10.0:g} cm"
