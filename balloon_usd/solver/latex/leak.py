"""Leak: a finished sculpture loses gas through its walls for hours, shown in the seconds of the hold."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.leak import conductance
from balloon_usd.solver.corners import vector_areas

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.plan import Plan
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.scene import LatexScene

    Floats = NDArray[np.float64]


class Leak:
    """The sculptures of a scene that leak, and how fast their clocks run."""

    def __init__(
        self, plans: Sequence[Plan], scene: LatexScene, hands: LatexControls, bodies: Sequence[range]
    ) -> None:
        """Take note of the plans that want it; `bodies`: of every plan."""
        self.scene = scene
        self.hands = hands
        self._hosts = scene.host_segment.numpy()
        """Segment in which each segment lies, (S,); -1 for none."""
        self._worlds = [
            (
                plan.choreography.let_go,
                plan.choreography.seconds,
                leak,
                np.concatenate([scene.bubbles_of(b) for b in run]),
            )
            for plan, run in zip(plans, bodies, strict=True)
            if (leak := plan.recipe.physics.leak) is not None
        ]
        self._walls: dict[int, tuple[NDArray[np.int32], NDArray[np.float32]]] = {}
        """Quads of every bubble that leaks, (Q, 4), and the rubber of them between closed necks, (Q,), m3."""

    def advance(self, begin: float, end: float, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the gas that is lost in a frame from `begin` to `end` (s) out of every bubble; what lies in
        another loses it to that.
        """
        for let_go, over, leak, bubbles in self._worlds:
            shown = max(0.0, min(end, over) - max(begin, let_go))
            if shown > 0.0:
                lost = self._lost(bubbles, leak * shown / (over - let_go), state)
                self.hands.lose_gas(bubbles, lost)
                hosts = self._hosts[bubbles]
                for guest in np.flatnonzero(hosts >= 0):
                    self.hands.lose_gas(hosts[guest : guest + 1], -lost[guest : guest + 1])

    def _lost(self, bubbles: NDArray[np.int64], seconds: float, state: Mapping[str, NDArray[Any]]) -> Floats:
        """Return what some bubbles lose in a time as long as they keep their walls, (bubbles,), mol.

        What is left of the excess over the pressure of the room decays exponentially.
        """
        energy = float(self.scene.air.molar_energy)
        volume, pressure = state["volume"][bubbles].astype(float), state["pressure"][bubbles].astype(float)
        grown = self.hands.rest_length
        through = np.array([self._conductance(bubble, state["x"], grown[bubble]) for bubble in bubbles])
        share = -np.expm1(-through * energy / volume * seconds)
        return np.asarray(share * pressure * volume / energy)

    def _conductance(self, segment: int, x: NDArray[np.float32], grown: float) -> float:
        """Return how much air the wall of a segment lets through, mol/(s Pa).

        `grown`: its length at rest, as a share of that between closed necks.
        """
        quads, rubber = self._wall(segment)
        area = np.linalg.norm(vector_areas(x, quads), axis=1)
        return float(conductance(area, grown * rubber).sum())

    def _wall(self, segment: int) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """Return the wall of a segment: once it leaks it is bent no more."""
        if segment not in self._walls:
            s = self.scene
            faces = slice(int(s.segment_quad.numpy()[segment]), int(s.segment_quad_end.numpy()[segment]))
            rubber = s.rubber_volume.numpy()[faces] / s.rest_length.numpy()[segment]
            self._walls[segment] = s.quads.numpy()[faces].copy(), rubber
        return self._walls[segment]
