"""How hands start and stop, and start anew."""

from __future__ import annotations


def smooth(t: float) -> float:
    """Return a progress of 0 to 1 that starts and ends at rest, with no jump in acceleration."""
    t = min(max(t, 0.0), 1.0)
    return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t)


def round_at(share: float, rounds: int) -> tuple[int, float]:
    """Return which round it is, from 0, at a share of the time of all, and the share of it that is over."""
    number, over = divmod(min(rounds * share, rounds - 1e-9), 1.0)
    return int(number), over
