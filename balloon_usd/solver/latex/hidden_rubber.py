"""How long every segment is at rest: closed necks hide rubber of the bubbles beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.latex.body import LatexBody

    Ints = NDArray[np.int32]


class HiddenRubber:
    """What the closed necks of a scene hide."""

    def __init__(self, bodies: Sequence[LatexBody], start: Ints, end: Ints) -> None:
        """Take over which joints each segment of some bodies lies between, (S,), -1 for none, and what a neck
        hides from it.
        """
        self._joints = start, end
        shares = [np.zeros(len(body.segment_ends)) if body.hidden is None else body.hidden for body in bodies]
        self._shares = np.concatenate(shares)

    def rest_length(self, closed: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return the length of every segment at rest, in that which it has between closed necks, (S,).

        `closed`: how far every joint is closed, (J,), 0 to 1.
        """
        opened = np.zeros(len(self._shares))
        for joints in self._joints:
            opened += np.where(joints < 0, 0.0, 1.0 - closed[joints])
        return np.asarray(1.0 + self._shares * opened, dtype=np.float32)
