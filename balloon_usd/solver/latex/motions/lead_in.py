"""Leading a balloon of latex in to the figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.lead_in import LeadIn

if TYPE_CHECKING:
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexLeadIn(LeadIn):
    """A balloon of latex on its way in, displaced as it is: by its joints alone it would bend and swing."""

    _sculpture: LatexSculpture

    _hands: LatexControls

    def _take(self) -> None:
        start = self._sculpture.scene.vertex_start
        bodies = sorted({self._sculpture.body[self._sculpture.balloons[ring]] for ring in self._coming})
        runs = [np.arange(start[body], start[body + 1]) for body in bodies]
        self._vertices = VertexSet.of(np.concatenate(runs))
        self._turned = 0.0

    def _leave(self) -> None:
        pass

    def _lead(self, progress: float) -> None:
        begin, end, middle = self._sculpture.frame
        here = middle[self._joint]
        rate = self._way.angle * (progress - self._turned) / (end - begin)
        self._turned = progress
        drift = (self._way.place(progress) - here) / (end - begin)
        spin = {"point": here, "axis": self._way.axis, "rate": rate, "drift": drift}
        self._hands.spins.turn(self._vertices, spin)
