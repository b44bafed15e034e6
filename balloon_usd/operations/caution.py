"""Cautions: what a maker would warn of before taking the balloon in hand."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Caution:
    """A warning with its reason."""

    step: int | None
    """Index of the step it is about; None for the sculpture as a whole."""
    what: str
    why: str
    remedy: str
