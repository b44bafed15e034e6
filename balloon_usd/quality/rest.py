"""How still a figure is after the hands let go."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.operations.moves import Fall
from balloon_usd.quality.measures import MEASURES
from balloon_usd.solver.status import coming_undone

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float32]

LATE = 0.5
"""Time before the end in which the largest speed is measured, s."""


class Rest:
    """Takes the frames of one sculpture; keeps the points at the let-go, at half the hold, and the last."""

    def __init__(self, plan: Plan) -> None:
        """Find out when to look."""
        fps, last = plan.recipe.fps, plan.frame_count
        self._falls_on = any(isinstance(m, Fall) and not m.ground for m in plan.choreography.moves)
        """Whether the figure still falls in the end, with no ground to land on."""
        # The time of a frame is (code - 1) / fps.
        self._let_go = min(1 + round(plan.choreography.let_go * fps), last)
        self._rested = plan.rested_frame
        self._half = (self._let_go + self._rested) // 2
        self._late = max(last - max(round(LATE * fps), 1), 1)
        self._fps = fps
        self._kept: dict[int, Floats] = {}
        self._before: Floats | None = None
        self._speed = self._creep = self._creep_late = 0.0
        self._undone: dict[str, None] = {}
        """Joints that have come undone, or begun to, in that order."""

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        code = frame.time_code
        self._undone |= dict.fromkeys([*frame.undone, *coming_undone(frame.doing)])
        kept = (self._let_go, self._half, self._rested)
        if code < self._late and code not in kept:
            return
        points = np.concatenate(frame.points)
        if code in kept:
            self._kept[code] = points
        if self._before is not None and code > self._late:
            self._speed = max(self._speed, self._fps * _farthest(self._before, points))
        self._before = points if code >= self._late else None
        if code == self._rested:
            self._creep = _farthest(self._kept[self._let_go], points)
            self._creep_late = _farthest(self._kept[self._half], points)

    def results(self) -> dict[str, dict[str, Any]]:
        """Return speed and creep, once the last frame is taken."""
        speed = None if self._falls_on else self._speed
        return {"speed": MEASURES["speed"].result(speed), "creep": self._creep_found()}

    def _creep_found(self) -> dict[str, Any]:
        """Return the creep; what comes undone goes where that leads it, which is none."""
        creep = MEASURES["creep"]
        if self._undone:
            return creep.result(None) | {"undone": list(self._undone)}
        return creep.result(self._creep, {"second_half": round(self._creep_late, creep.digits)})


def _farthest(before: Floats, now: Floats) -> float:
    """Return the largest way of a vertex between two frames, m."""
    way = now - before
    return float(np.sqrt(np.einsum("vi,vi->v", way, way).max(initial=0.0)))
