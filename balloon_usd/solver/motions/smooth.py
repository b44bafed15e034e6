"""How hands start and stop."""

from __future__ import annotations


def smooth(t: float) -> float:
    """Return a progress of 0 to 1 that starts and ends at rest, with no jump in acceleration."""
    t = min(max(t, 0.0), 1.0)
    return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t)
