"""Spins: rigid turns of sets of vertices, and of every vertex the spin that turns it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from balloon_usd.solver.hands import fill_row

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.solver.latex.scene import LatexScene


@dataclass(frozen=True, eq=False)
class VertexSet:
    """Some vertices of a scene; two sets are the same if they are one object."""

    indices: slice | NDArray[np.int64]
    """Of the scene; a slice, which copies nothing, where they are one run."""

    @classmethod
    def of(cls, chosen: NDArray[np.int64]) -> Self:
        """Return the set of some vertices."""
        chosen = np.sort(chosen)
        run = len(chosen) > 0 and chosen[-1] - chosen[0] + 1 == len(chosen)
        return cls(slice(int(chosen[0]), int(chosen[-1]) + 1) if run else chosen)

    def meets(self, run: slice) -> bool:
        """Return whether any of them is in a run of vertices."""
        if isinstance(self.indices, slice):
            return bool(self.indices.start < run.stop and run.start < self.indices.stop)
        first, end = np.searchsorted(self.indices, (run.start, run.stop))
        return bool(first < end)


class Spins:
    """The spins of a scene in the coming frame."""

    def __init__(self, scene: LatexScene) -> None:
        """Turn nothing yet."""
        self.rows = scene.spins.numpy().copy()
        self.of_vertex = scene.vertex_spin.numpy().copy()
        """Row + 1 of the spin of every vertex, 0 for none, (V,)."""
        self._on: dict[VertexSet, Mapping[str, Any]] = {}
        """What turns in the coming frame, and the fields of its `Spin`."""
        self._row: dict[VertexSet, int] = {}
        """Rows of the sets that `of_vertex` has."""
        self._free = list(range(len(self.rows)))[::-1]

    def turn(self, vertices: VertexSet, fields: Mapping[str, Any]) -> None:
        """Turn some vertices in the coming frame; where sets overlap, the one that began last counts.

        `fields`: of a `Spin`; those that are not given are 0.
        """
        self._on[vertices] = fields

    def moves(self, run: slice) -> bool:
        """Return whether it moves any vertex of a run of them in the coming frame."""
        return any(vertices.meets(run) for vertices in self._on)

    def shift(self, vertices: VertexSet, drift: NDArray[np.floating[Any]]) -> None:
        """Displace some vertices in the coming frame as they are, at a velocity (3,), m/s."""
        # Any axis: nothing turns.
        self.turn(vertices, {"axis": np.array([1.0, 0.0, 0.0]), "drift": drift})

    def stop(self) -> None:
        """Turn nothing."""
        self._on.clear()

    def settle(self) -> bool:
        """Write the rows of the coming frame; return whether other vertices turn than in the last one.

        Raises:
            ValueError: more sets than rows.
        """
        gone = [vertices for vertices in self._row if vertices not in self._on]
        come = [vertices for vertices in self._on if vertices not in self._row]
        self._free += [self._row.pop(vertices) for vertices in gone]
        if len(come) > len(self._free):
            raise ValueError(f"{len(self._on)} spins but room for {len(self.rows)}")
        self._row.update((vertices, self._free.pop()) for vertices in come)
        for vertices, fields in self._on.items():
            fill_row(self.rows, self._row[vertices], fields)
        if gone or come:
            self.of_vertex[:] = 0
            for vertices, row in self._row.items():
                self.of_vertex[vertices.indices] = row + 1
        return bool(gone or come)
