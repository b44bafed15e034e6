"""What lies in the bubbles of a balloon, which hands carry along as they draw these together."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.sculpture import LatexSculpture
    from balloon_usd.solver.latex.spins import VertexSet


class CarryInside:
    """Balloons in another that go as the rings of their bubbles do: a neck that is drawn over one pierces it,
    and an ear of 14 cm is drawn along by 8 cm as it is pinched.
    """

    def __init__(self, sculpture: LatexSculpture, balloon: str) -> None:
        """Find what lies in a balloon."""
        self._sculpture = sculpture
        self._carried: list[tuple[VertexSet, list[int]]] = []
        """Vertices of each, and the joints of the scene at the ends of its bubble."""
        plan = sculpture.plan
        for vertices, host in sculpture.contents(balloon):
            rings = plan.table.ends(plan.strips[balloon].bubbles[host.bubble].name)
            joints = [sculpture.joints[ring] for ring in rings if ring is not None]
            self._carried.append((vertices, joints))
        self._before = self._middles()

    def _middles(self) -> list[NDArray[np.float32]]:
        """Return the middle between the ends of each bubble, (3,), m."""
        middle = self._sculpture.frame.middle
        return [middle[joints].mean(axis=0) for _, joints in self._carried]

    def advance(self) -> None:
        """Carry each in the coming frame as far as its bubble has gone in the last one."""
        begin, end, _ = self._sculpture.frame
        now = self._middles()
        for (vertices, _), here, before in zip(self._carried, now, self._before, strict=True):
            self._sculpture.hands.spins.shift(vertices, (here - before) / (end - begin))
        self._before = now
