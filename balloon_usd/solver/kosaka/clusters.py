"""Clusters: air and faces of one bubble, parted where a ring has frozen (Kosaka 2008, 3.6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.kosaka.scene import KosakaScene

BLOCK = 256
"""Particles whose distances to all faces are taken at a time: bounds the memory."""


class Clusters:
    """Which bubble every particle and every face belongs to."""

    def __init__(self, scene: KosakaScene) -> None:
        self.scene = scene
        self.of_air = scene.air_cluster.numpy().copy()
        """Segment of every particle, (P,): the first of an undivided run."""
        self._of_quads = scene.quad_cluster.numpy()
        self._segments = scene.quad_segment.numpy()
        self._quads = scene.quads.numpy()
        self.of_segment = self._segment_runs()
        """Cluster of every segment, (S,)."""
        self._frozen = scene.frozen.numpy().astype(bool)
        self._ends = scene.end_joint.numpy()

    @property
    def closed(self) -> bool:
        """Whether any ring is frozen."""
        return bool(self._frozen.any())

    def part(self, closing: NDArray[np.bool_]) -> None:
        """Part the clusters at rings that have frozen since; `closing`: rings being drawn together, (J,)."""
        if not (closing & ~self._frozen).any():
            return
        frozen = self.scene.frozen.numpy().astype(bool)
        fresh = np.flatnonzero(frozen & ~self._frozen)
        self._frozen = frozen
        if len(fresh):
            # The state that was read back refers to the old array.
            self.of_air = self.of_air.copy()
        for joint in fresh:
            ending = np.flatnonzero(self._ends == joint)
            if len(ending):
                self._part_after(int(ending[0]))
        if len(fresh):
            self.of_segment = self._segment_runs()
            self.scene.quad_cluster.assign(self._of_quads)
            self.scene.air_cluster.assign(self.of_air)

    def _segment_runs(self) -> NDArray[np.int64]:
        runs = np.zeros(len(self.scene.segment_quad), dtype=np.int64)
        runs[self._segments] = self._of_quads
        return runs

    def _part_after(self, segment: int) -> None:
        """Give what lies beyond a segment in its run a number of its own; air follows the nearest face."""
        s = self.scene
        segments = self._segments
        run = int(self._of_quads[np.flatnonzero(segments == segment)[0]])
        members = np.flatnonzero(self._of_quads == run)
        beyond = segments[members] > segment
        self._of_quads[members[beyond]] = segment + 1
        middles = s.x.numpy()[self._quads[members]].mean(axis=1)
        air = s.air.numpy()
        inside = np.flatnonzero(self.of_air == run)
        for start in range(0, len(inside), BLOCK):
            block = inside[start : start + BLOCK]
            distance = ((air[block, None] - middles[None]) ** 2).sum(axis=2)
            self.of_air[block] = np.where(beyond[distance.argmin(axis=1)], segment + 1, run)
