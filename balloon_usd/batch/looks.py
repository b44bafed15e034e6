"""The looks that may be asked for."""

from __future__ import annotations

LOOKS = ("recipe", "clear", "chrome", "clay", "print", "stress")
"""Looks of every stage."""
WITH_AIR = "thesis"
"""Look of stages of the model kosaka only; it needs a texture."""
