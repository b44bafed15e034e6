"""Layout: where every sculpture lies in a flat state."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.checks import FARTHEST
from balloon_usd.solver.frame_arrays import Extent, Place

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.solver.scene import Scene


class Layout:
    """Vertices, bubbles and rings of the sculptures of a scene."""

    def __init__(self, scene: Scene, bodies: Sequence[range], particles: Sequence[int] | None = None) -> None:
        """Look them up once; `bodies`: of every sculpture; `particles`: air particles of every body."""
        of_world = [np.concatenate([scene.bubbles_of(b) for b in run]) for run in bodies]
        self.bubbles = np.concatenate(of_world)
        """Segments that are bubbles, sculpture by sculpture."""
        air = None if particles is None else sum(particles)
        self.extent = Extent(int(scene.vertex_start[-1]), len(self.bubbles), air)
        """Of all sculptures."""
        walls = _spans(np.diff(scene.vertex_start).tolist())
        airs = None if particles is None else _spans(particles)
        self.places = [
            Place(tuple(walls[b] for b in run), bubbles, () if airs is None else tuple(airs[b] for b in run))
            for run, bubbles in zip(bodies, _spans([len(b) for b in of_world]), strict=True)
        ]
        self._ring_world = np.repeat(scene.worlds, np.diff(scene.joint_start))

    def astray(self, middle: NDArray[np.float32]) -> NDArray[np.bool_]:
        """Tell which sculptures have flown apart, so that hands find their rings no more, (W,).

        `middle`: of all rings, (J, 3), m.
        """
        lost = np.zeros(len(self.places), dtype=bool)
        near = (np.abs(middle[: len(self._ring_world)]) < FARTHEST).all(axis=1)
        lost[self._ring_world[~near]] = True
        return lost


def _spans(sizes: Sequence[int]) -> list[slice]:
    """Return where things of these sizes lie, one after another."""
    return [slice(end - size, end) for size, end in zip(sizes, accumulate(sizes), strict=True)]
