"""Layout: where every sculpture lies in a flat state."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.solver.watch import FARTHEST

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene


class Place(NamedTuple):
    """Where one sculpture lies."""

    walls: tuple[slice, ...]
    """Vertices of every balloon, among all vertices."""
    bubbles: slice
    """Its bubbles, among the bubbles of all sculptures."""


class Layout:
    """Vertices, bubbles and rings of the sculptures of a scene."""

    def __init__(self, scene: Scene, bodies: Sequence[range]) -> None:
        """Look them up once; `bodies`: of every sculpture."""
        of_world = [np.concatenate([scene.bubbles_of(b) for b in run]) for run in bodies]
        self.bubbles = np.concatenate(of_world)
        """Segments that are bubbles, sculpture by sculpture."""
        first = np.cumsum([0, *(len(bubbles) for bubbles in of_world)]).tolist()
        vertex = scene.vertex_start.tolist()
        self.places = [
            Place(tuple(slice(vertex[b], vertex[b + 1]) for b in run), slice(first[k], first[k + 1]))
            for k, run in enumerate(bodies)
        ]
        self._ring_world = np.repeat(scene.worlds, np.diff(scene.joint_start))

    def astray(self, middle: NDArray[np.float32]) -> list[bool]:
        """Tell which sculptures have flown apart, so that hands find their rings no more.

        `middle`: of all rings, (J, 3), m.
        """
        lost = np.zeros(len(self.places), dtype=bool)
        near = (np.abs(middle[: len(self._ring_world)]) < FARTHEST).all(axis=1)
        lost[self._ring_world[~near]] = True
        return lost.tolist()
