"""Bodies end to end: where each begins among the vertices, quads, segments and rings of all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.body import Body
    from balloon_usd.solver.settings import SceneSettings

Ints = NDArray[np.int64]


@dataclass
class FlatBodies:
    """Bodies of several sculptures; indices are global over all bodies."""

    bodies: tuple[Body, ...]
    worlds: tuple[int, ...]
    """Sculpture of every body."""
    settings: SceneSettings
    device: str
    vertex_start: Ints
    """First vertex of every body, (B + 1,); the same for the others."""
    quad_start: Ints
    """First quad of every body."""
    segment_start: Ints
    """First segment of every body."""
    joint_start: Ints
    """First ring of every body."""

    @classmethod
    def of(cls, bodies: Sequence[Any], worlds: Sequence[int], settings: SceneSettings, device: str) -> Self:
        """Return some bodies end to end; those of different `worlds` never touch."""
        sizes = (
            [len(b.points) for b in bodies],
            [len(b.quads) for b in bodies],
            [len(b.segment_ends) for b in bodies],
            [len(b.rings) for b in bodies],
        )
        vertices, quads, segments, joints = (np.concatenate([[0], np.cumsum(n)]) for n in sizes)
        return cls(tuple(bodies), tuple(worlds), settings, device, vertices, quads, segments, joints)

    def bubbles_of(self, body: int) -> Ints:
        """Segments that are the bubbles of one body: those after its spare ones."""
        return np.arange(
            self.segment_start[body] + self.bodies[body].spare_segments, self.segment_start[body + 1]
        )

    def vertices_of(self, body: int) -> slice:
        """Vertices of one body."""
        return slice(int(self.vertex_start[body]), int(self.vertex_start[body + 1]))

    @property
    def hosts(self) -> Ints:
        """The body in which each body lies, (B,); -1 for none."""
        first = self.by_world(np.arange(len(self.bodies) + 1))
        inside = (
            -1 if b.inside is None else first[w] + b.inside[0]
            for b, w in zip(self.bodies, self.worlds, strict=True)
        )
        return np.fromiter(inside, dtype=np.int64)

    def by_world(self, first: NDArray[Any]) -> NDArray[np.int32]:
        """Return the first thing of every sculpture and the end of the last, (W + 1,), given those of every
        body, (B + 1,).
        """
        body = np.searchsorted(np.asarray(self.worlds), np.arange(max(self.worlds) + 2))
        return first[body].astype(np.int32)
