"""How upright a figure is that was put on the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.operations.moves import SetDown
from balloon_usd.operations.parting import parts_of
from balloon_usd.quality.bubbles import vertices_of_bubbles
from balloon_usd.quality.measures import MEASURES
from balloon_usd.solver.levelling import TOUCHES, feet_of
from balloon_usd.solver.placement import turn_facing
from balloon_usd.solver.rotations import rotation_onto

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]


class Standing:
    """Takes the frames of one sculpture; keeps the points of that before hands set it down, and the last."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out when it is set down, if it is; `meshes`: one a balloon, in the order of `Plan.strips`."""
        carries = (m for m in plan.choreography.moves if isinstance(m, SetDown) and m.pose == "stand")
        # Of what has come apart each part stands as it can.
        self._carry = next(carries, None) if len(parts_of(plan.recipe.piece)) == 1 else None
        self._bubbles = vertices_of_bubbles(plan, meshes) if self._carry else {}
        # Frames may show the mirror image of what hands carry.
        self._shown = np.array([1.0, -1.0 if plan.mirrored else 1.0, 1.0])
        # The time of a frame is (code - 1) / fps.
        self._before = 1 + int(self._carry.start * plan.recipe.fps) if self._carry else 0
        self._last = plan.frame_count
        self._kept: dict[int, list[Floats]] = {}

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        if self._carry and frame.time_code in (self._before, self._last):
            self._kept[frame.time_code] = [self._shown * points for points in frame.points]

    def results(self) -> dict[str, dict[str, Any]]:
        """Return the lean, once the last frame is taken; none of what stands nowhere, or not as one."""
        if self._carry is None:
            return {"lean": MEASURES["lean"].result(None)}
        held, stands = (np.concatenate(self._kept[code]) for code in (self._before, self._last))
        middle = held.mean(axis=0)
        facing = turn_facing(self._carry.front, self._carry.top, middle, self._middle)
        up = rotation_onto(stands - stands.mean(axis=0), held - middle) @ facing[2]
        lean = float(np.degrees(np.arccos(np.clip(up[2], -1.0, 1.0))))
        return {"lean": MEASURES["lean"].result(lean, {"feet": self._feet()})}

    def _feet(self) -> list[str]:
        """Return the bubbles that touch the ground in the last frame."""
        stands = self._kept[self._last]
        walls = {name: stands[balloon][vertices] for name, (balloon, vertices) in self._bubbles.items()}
        return list(feet_of(walls, (), TOUCHES, TOUCHES))

    def _middle(self, bubble: str) -> Floats:
        """Return the middle of a bubble before it is set down, (3,), m."""
        balloon, vertices = self._bubbles[bubble]
        middle: Floats = self._kept[self._before][balloon][vertices].mean(axis=0)
        return middle
