"""Summary of a run: highest stretch against burst, flat tail left, what has come undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

FLAT_BELOW = 2.0
"""Hoop stretch below which rubber counts as flat: between the thin phase (1.15) and the bulged one (5.7)."""


class RunSummary:
    """Reduces the frames of one sculpture to a few numbers."""

    def __init__(self, plan: Plan, meshes: tuple[BalloonMesh, ...]) -> None:
        """Begin without frames."""
        self._plan = plan
        self._meshes = meshes
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
        pairs = zip(self._plan.strips.items(), self._meshes, self._last.points, strict=True)
        return {
            name: flat_tail(mesh, points, strip.bubbles[-1].rest_start, strip.size.radius)
            for (name, strip), mesh, points in pairs
            if strip.shape is None
        }


def flat_tail(mesh: BalloonMesh, points: NDArray[np.float32], beyond: float, radius: float) -> float:
    """Return the unstressed length (m) of the rubber beyond a place that is not inflated.

    Args:
        mesh: the balloon.
        points: (V, 3) m.
        beyond: unstressed distance from the knot (m).
        radius: unstressed tube radius (m).
    """
    rings = mesh.ring_start[:, None] + np.arange(mesh.around)
    corners = points[rings].astype(np.float64)
    girth = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum(axis=1)
    unstressed = 2.0 * mesh.around * np.tan(np.pi / mesh.around) * radius
    flat = (girth / unstressed < FLAT_BELOW) & (mesh.ring_along > beyond)
    last = len(flat) - 1
    while last >= 0 and flat[last]:
        last -= 1
    return float(mesh.ring_along[-1] + radius - mesh.ring_along[last]) if last < len(flat) - 1 else 0.0
