"""How long every segment is at rest: closed necks hide rubber of the bubbles beside them, and turns draw more
into them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.latex.body import LatexBody

    Floats = NDArray[np.float32]
    Ints = NDArray[np.int32]


class HiddenRubber:
    """What the closed and wound necks of a scene hide."""

    def __init__(self, bodies: Sequence[LatexBody], start: Ints, end: Ints) -> None:
        """Take over which joints each segment of some bodies lies between, (S,), -1 for none, what a closed
        neck hides from it and what turns draw out of it.
        """
        self._joints = start, end
        self._hidden = np.concatenate(
            [_or_nothing(body.hidden, (len(body.segment_ends),)) for body in bodies]
        )
        self._drawn = np.concatenate(
            [_or_nothing(body.drawn, (len(body.segment_ends), 2)) for body in bodies]
        )

    def rest_length(self, closed: Floats, wound: Floats) -> Floats:
        """Return the length of every segment at rest, in that which it has between finished necks, (S,).

        `closed`: how far every joint is closed, (J,), 0 to 1; `wound`: how much is drawn in of what its turns
        draw in when it is finished, (J,), from 0 on.
        """
        opened, slack = np.zeros(len(self._hidden)), np.zeros(len(self._hidden))
        for joints, drawn in zip(self._joints, self._drawn.T, strict=True):
            opened += np.where(joints < 0, 0.0, 1.0 - closed[joints])
            slack += np.where(joints < 0, 0.0, drawn * (1.0 - wound[joints]))
        return np.asarray(1.0 + self._hidden * opened + slack, dtype=np.float32)


def _or_nothing(shares: NDArray[np.float64] | None, shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.zeros(shape) if shares is None else shares
