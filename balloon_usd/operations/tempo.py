"""Tempo: how fast hands turn and lead, as a recipe asks."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

Tempo = Literal["calm", "brisk", "show"]

EASE = 0.25
"""Share of the time of a turn in which hands gather speed, and again in which they slow down."""

FASTEST_RIM = 1.1
"""Speed at the rim of a fold that a calm maker turns, m/s: a wide loop is turned more slowly."""


class Pace(NamedTuple):
    """How fast hands are."""

    turning: float
    """Fastest turning of a twist, turns/s."""
    leading: float
    """Speed of hands that bring joints somewhere, pinch and bend, over that of a calm maker."""

    def turning_seconds(self, turns: float, reach: float = 0.0) -> float:
        """Return how long so many turns take, s: with ease in and out.

        `reach`: largest distance from the axis of what is turned, m.
        """
        fastest = min(self.turning, self.leading * FASTEST_RIM / (2.0 * math.pi * max(reach, 1e-3)))
        return turns / (fastest * (1.0 - EASE))


PACES: dict[Tempo, Pace] = {
    # 40 degrees a frame at 24 frames/s: a turn of bubbles is seen as one, and three take 1.5 s as by hand.
    "calm": Pace(40.0 * 24.0 / 360.0, 1.0),
    "brisk": Pace(60.0 * 24.0 / 360.0, 1.5),
    "show": Pace(20.0 * 24.0 / 360.0, 0.6),
}


def eased(share: float) -> float:
    """Return the progress of a turn at a share of its time: speed rises and falls evenly at both ends."""
    share = min(max(share, 0.0), 1.0)
    if share > 0.5:
        return 1.0 - eased(1.0 - share)
    if share < EASE:
        return 0.5 * share * share / (EASE * (1.0 - EASE))
    return (share - 0.5 * EASE) / (1.0 - EASE)
