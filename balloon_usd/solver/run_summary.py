"""Summary of a run: highest stretch against burst, flat tail left, what has come undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.flat_tails import FlatTails

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame


class RunSummary:
    """Reduces the frames of one sculpture to a few numbers."""

    def __init__(self, plan: Plan, meshes: tuple[BalloonMesh, ...]) -> None:
        """Begin without frames."""
        self._plan = plan
        self._meshes = meshes
        self._tails = FlatTails(plan, meshes)
        self._last: Frame | None = None
        self.highest_stretch = 0.0
        """Largest principal stretch of any wall so far."""
        self.highest_bubble = ""
        """Bubble in which it was."""

    def add(self, frame: Frame) -> None:
        """Add one more frame."""
        self._last = frame
        for stretch, mesh, strip in zip(frame.stretch, self._meshes, self._plan.strips.values(), strict=True):
            worst = int(np.argmax(stretch))
            if stretch[worst] > self.highest_stretch:
                self.highest_stretch = float(stretch[worst])
                self.highest_bubble = strip.bubble_at(float(mesh.along[worst])).name

    @property
    def undone(self) -> tuple[str, ...]:
        """Locks that have slipped and joints that have come undone."""
        return () if self._last is None else self._last.undone

    @property
    def bursts(self) -> bool:
        """Whether latex would not have borne the highest stretch; springs do not burst."""
        most = self._plan.recipe.physics.traits.burst_stretch
        return most is not None and self.highest_stretch > most

    @property
    def tails_left(self) -> dict[str, float]:
        """Flat rubber left at the tip of every tube in the last frame, m."""
        if self._last is None:
            return {}
        return dict(zip(self._tails.names, self._tails.left(self._last), strict=True))
