"""The maker of the thesis's model: rings are drawn together by force and stay where they freeze."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import Pinch, Weld
from balloon_usd.plan.closing import smooth
from balloon_usd.solver.kosaka.memory import BEND_SET, LOOP_SET, set_bend
from balloon_usd.solver.maker import Maker

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.kosaka.scene import KosakaScene

Floats = NDArray[np.float32]

CLOSED_EARLY = 0.75
"""Share of a pinch's time in which the ring closes; in the rest it comes to coincide."""


class KosakaMaker(Maker):
    """Performs one plan on its balloons in a scene of the thesis's model."""

    scene: KosakaScene

    def __init__(self, plan: Plan, scene: KosakaScene, hands: Hands, first_body: int) -> None:
        super().__init__(plan, scene, hands, first_body)
        self._performers[Pinch] = self._pinch

    def _weld(self, k: int, move: Weld, share: float, fresh: bool, middle: Floats) -> None:
        super()._weld(k, move, share, fresh, middle)
        if fresh:
            self._keep_loop(move)

    def _pinch(self, k: int, move: Pinch, share: float, fresh: bool, middle: Floats) -> None:
        joint = self._ring[move.ring]
        if fresh:
            self._began[k] = np.array([self._ring_width(joint)])
            self.hands.clasp(joint, middle)
            self.hands.touch(self.body.values())
            self.hands.radius[joint] = self._began[k][0]
        wide, neck = float(self._began[k][0]), float(self.hands.neck[joint])
        self.hands.close(joint, neck + (wide - neck) * (1.0 - smooth(share / CLOSED_EARLY)))

    def _keep_bend(self, bubble: str) -> None:
        body, faces = self._faces(bubble)
        set_bend(self.scene, body, faces, BEND_SET)

    def _keep_loop(self, move: Weld) -> None:
        """Let a bubble whose own ends are twisted together keep its curve: a net has no other stiffness that
        would hold the loop open.
        """
        rings = self.plan.table.rings
        last = max(move.rings)
        if set(self.plan.table.ends(rings[last].bubble)) == set(move.rings):
            body, faces = self._faces(rings[last].bubble)
            set_bend(self.scene, body, faces, LOOP_SET)
