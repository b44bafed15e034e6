"""How upright a figure is that was put on the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.operations.moves import SetDown
from balloon_usd.quality.measures import MEASURES
from balloon_usd.solver.placement import turn_of_sides
from balloon_usd.solver.rotations import rotation_onto

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]


class Standing:
    """Takes the frames of one sculpture; keeps the points of that before hands set it down, and the last."""

    def __init__(self, plan: Plan) -> None:
        """Find out when it is set down, if it is."""
        carries = (m for m in plan.choreography.moves if isinstance(m, SetDown) and m.pose == "stand")
        self._carry = next(carries, None)
        # The time of a frame is (code - 1) / fps.
        self._before = 1 + int(self._carry.start * plan.recipe.fps) if self._carry else 0
        self._last = plan.frame_count
        self._kept: dict[int, Floats] = {}

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        if self._carry and frame.time_code in (self._before, self._last):
            self._kept[frame.time_code] = np.concatenate(frame.points).astype(float)

    def results(self) -> dict[str, dict[str, Any]]:
        """Return the lean, once the last frame is taken; none of a figure that stands nowhere."""
        if self._carry is None:
            return {"lean": MEASURES["lean"].result(None)}
        kept = (self._kept[code] for code in (self._before, self._last))
        made, stands = (points - points.mean(axis=0) for points in kept)
        facing = turn_of_sides(self._carry.front, self._carry.top)
        up = rotation_onto(stands, made) @ facing[2]
        return {"lean": MEASURES["lean"].result(float(np.degrees(np.arccos(np.clip(up[2], -1.0, 1.0)))))}
