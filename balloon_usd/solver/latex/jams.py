"""Jams: bubbles that hands would bring past each other, and whose walls only press on each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.language.choices import all_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import Place

LONGEST_JAM = 0.75
"""Time after which a jam counts as failed, s. In 70 figures without crossings walls of a bubble could not be
kept apart for 0.3 s at most; in a net that closes over its spokes for 1.2 to 2.2 s, again and again, and each
such frame takes as long as a hundred others.
"""
SHARE_NAMED = 0.5
"""Share of that time from which on a bubble has a part in a jam."""
MOST_NAMED = 4
"""Bubbles that a message names."""


class Jams:
    """For how long the walls of every bubble of some plans could not be kept apart from others."""

    def __init__(self, plans: Sequence[Plan], places: Sequence[Place], fps: float) -> None:
        """Nothing is jammed yet; `places`: of every plan in the arrays of a frame."""
        self._plans, self._places = plans, places
        self._most = max(1, round(LONGEST_JAM * fps))
        self._frames = np.zeros(places[-1].bubbles.stop, dtype=np.int64)
        """Frames in a row until now, (bubbles,)."""

    def note(self, jammed: NDArray[np.int32]) -> None:
        """Take note of a frame; `jammed`: 1 for every bubble whose walls could not be kept apart in it."""
        self._frames = np.where(jammed > 0, self._frames + 1, 0)

    def causes(self) -> dict[int, str]:
        """Return the plans that are jammed by now, and what is in whose way."""
        if self._frames.max(initial=0) < self._most:
            return {}
        frames = [self._frames[place.bubbles] for place in self._places]
        return {k: self._cause(k, own) for k, own in enumerate(frames) if own.max(initial=0) >= self._most}

    def _cause(self, plan: int, frames: NDArray[np.int64]) -> str:
        longest = np.argsort(-frames, kind="stable")[:MOST_NAMED]
        bubbles = self._plans[plan].bubbles
        names = [bubbles[k].name for k in longest if frames[k] >= SHARE_NAMED * self._most]
        return (
            f"{all_of(names)} {'is' if len(names) == 1 else 'are'} jammed: for {LONGEST_JAM:g} s hands have "
            "pressed walls on each other that get past each other on no side; joints locked in another "
            "order, longer bubbles or a thinner balloon leave room"
        )
