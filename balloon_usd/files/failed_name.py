"""The name of what a simulation leaves that has failed."""

from __future__ import annotations


def failed_name(name: str) -> str:
    """Return what stands in place of a sculpture's name in all its files; no sculpture can be called so."""
    return f"{name}.failed"
