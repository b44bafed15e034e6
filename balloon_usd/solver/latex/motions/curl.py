"""Rolling a bubble of latex up into a coil, of which it keeps nearly all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations import moves
from balloon_usd.solver.latex.coil import Disc, Helix
from balloon_usd.solver.latex.motions.curve import LatexCurve
from balloon_usd.solver.motions.curve import Row

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.latex.coil import Coil
    from balloon_usd.solver.motions.curve import Path

Floats = NDArray[np.float64]


class Curl(LatexCurve[moves.Curl]):
    """A bubble of latex that is rolled up, with what gas comes to fill of its flat tail meanwhile."""

    def path(self, move: moves.Curl, straight: tuple[int, int]) -> Path:
        """Return the coil."""
        row, axis = Row(self._began, straight), np.array(move.point)
        if move.growth > 0.0:
            self._coil: Coil = Disc(row, move.turns, axis, move.growth)
        else:
            self._coil = Helix(row, move.turns, axis, move.rise)
        return self._coil

    def take_flat(self, joints: Sequence[int]) -> None:
        """Take hold of the rings of the flat tail to which gas may come, and leave the tip alone."""
        super().take_flat(joints[:-1])

    def carried(self, goal: Floats) -> Floats:
        """Return where what hangs on its free end goes, (M, 3), m: it turns with that end."""
        arms = self._carried.places - self._began[0]
        found: Floats = goal[0] + arms @ self._coil.turned(self.progress).T
        return found

    def advance(self, share: float) -> None:
        """Roll the bubble on, and wind what gas has come to of the flat tail."""
        self._coil.measure(self._sculpture.frame.middle[self._joints].astype(np.float64))
        super().advance(share)
