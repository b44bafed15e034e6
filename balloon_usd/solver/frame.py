"""Frames: what a simulation gives out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEAST_SLOWNESS = 0.01
"""How slow a vertex is kept at least that only a reaction presses, and forces move as elsewhere, s/m."""


@dataclass(frozen=True)
class Frame:
    """One frame of one sculpture."""

    time_code: int
    """Number of the frame, from 1."""
    points: tuple[NDArray[np.float32], ...]
    """Vertex positions of every balloon, (V, 3) float32, m."""
    stretch: tuple[NDArray[np.float32], ...]
    """Largest principal stretch at every vertex of every balloon, (V,) float32."""
    pressure: NDArray[np.float32]
    """Gauge pressure of every bubble in plan order, (bubbles,) float32, Pa."""
    volume: NDArray[np.float32]
    """Gas volume of every bubble in plan order, (bubbles,) float32, m3."""
    doing: str
    """What the hands do."""
    contact: NDArray[np.float32] | None = None
    """Force with which walls press on the wall of every bubble, (bubbles,) float32, N; None in the model
    kosaka, whose walls are moved apart without a force.
    """
    undone: tuple[str, ...] = ()
    """Locks that have slipped and joints that have come undone so far."""
    air: tuple[NDArray[np.float32], ...] = ()
    """Air particles of every balloon, (P, 3) float32, m; empty where the air is no particles."""
    cluster: tuple[NDArray[np.int32], ...] = ()
    """Bubble of every particle, (P,) int32 in plan order; an undivided run has the number of its first."""
    shift: NDArray[np.float32] | None = None
    """Farthest that the wall of every bubble was led out of others in this frame, (bubbles,) float32, m; None
    in the model kosaka.
    """
    slowness: tuple[NDArray[np.float32], ...] = ()
    """How slow every vertex of every balloon is kept that is led out of other walls, (V,) float32, s/m: 0
    where forces alone move it. Empty in the model kosaka.
    """
    joint_force: NDArray[np.float32] | None = None
    """Largest force of friction that keeps two bubbles where they lie, of those that meet at the start and at
    the end of every bubble, (bubbles, 2) float32, N; 0 where no neck is wound about others, None in the model
    kosaka.
    """

    def forced(self, balloon: int) -> NDArray[np.float32]:
        """Return the stretch at every vertex of a balloon, (V,) float32, and 0 where it is led out of other
        walls: that stretches walls for a few frames, with no force that latex would bear.
        """
        stretch = self.stretch[balloon]
        if not self.slowness:
            return stretch
        return np.where(self.slowness[balloon] > np.float32(LEAST_SLOWNESS), np.float32(0.0), stretch)

    def copy(self) -> Frame:
        """Return the same in arrays of its own."""
        return replace(
            self,
            points=tuple([points.copy() for points in self.points]),
            stretch=tuple([stretch.copy() for stretch in self.stretch]),
            pressure=self.pressure.copy(),
            volume=self.volume.copy(),
            contact=None if self.contact is None else self.contact.copy(),
            air=tuple([air.copy() for air in self.air]),
            cluster=tuple([cluster.copy() for cluster in self.cluster]),
            shift=None if self.shift is None else self.shift.copy(),
            slowness=tuple([slowness.copy() for slowness in self.slowness]),
            joint_force=None if self.joint_force is None else self.joint_force.copy(),
        )
