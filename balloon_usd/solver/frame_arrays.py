"""The arrays of a frame, flat over all sculptures, and where each sculpture lies in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from balloon_usd.solver.frame import Frame

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray


class Extent(NamedTuple):
    """Sizes of the arrays."""

    vertices: int
    bubbles: int
    particles: int | None = None
    """Of air; None in the model latex, whose air is no particles."""

    @classmethod
    def of(cls, parts: Sequence[Extent]) -> Extent:
        """Return the extent of several things together, all of one model."""
        vertices, bubbles = (sum(part[k] or 0 for part in parts) for k in range(2))
        if any(part.particles is None for part in parts):
            return cls(vertices, bubbles)
        return cls(vertices, bubbles, sum(part.particles or 0 for part in parts))

    @property
    def nothing(self) -> Extent:
        """The extent of nothing, in the same model."""
        return Extent(0, 0, None if self.particles is None else 0)

    def frame_arrays(self, make: Callable[[tuple[int, ...], Any], NDArray[Any]] = np.empty) -> FrameArrays:
        """Return arrays to write into.

        `make`: returns a C-contiguous array of a shape and a type, such as one in shared memory.
        """
        walls = make((self.vertices, 3), np.float32), make((self.vertices,), np.float32)
        pressure, volume = (make((self.bubbles,), np.float32) for _ in range(2))
        if self.particles is None:
            contact, shift = (make((self.bubbles,), np.float32) for _ in range(2))
            slowness, joint_force = make((self.vertices,), np.float32), make((self.bubbles, 2), np.float32)
            return FrameArrays(*walls, pressure, volume, contact, None, None, shift, slowness, joint_force)
        air, cluster = make((self.particles, 3), np.float32), make((self.particles,), np.int32)
        return FrameArrays(*walls, pressure, volume, None, air, cluster)


class Place(NamedTuple):
    """Where one sculpture lies in the arrays of a frame."""

    walls: tuple[slice, ...]
    """Vertices of every balloon."""
    bubbles: slice
    air: tuple[slice, ...] = ()
    """Air particles of every balloon; empty where the air is no particles."""

    def after(self, before: Extent) -> Place:
        """Return the place behind all that lies before it."""
        return Place(
            tuple(_later(span, before.vertices) for span in self.walls),
            _later(self.bubbles, before.bubbles),
            tuple(_later(span, before.particles or 0) for span in self.air),
        )


@dataclass(frozen=True)
class FrameArrays:
    """Flat arrays of all sculptures, one after another."""

    points: NDArray[np.float32]
    """Vertex positions, (V, 3) float32, m."""
    stretch: NDArray[np.float32]
    """Largest principal stretch at every vertex, (V,) float32."""
    pressure: NDArray[np.float32]
    """Gauge pressure of every bubble, (bubbles,) float32, Pa."""
    volume: NDArray[np.float32]
    """Gas volume of every bubble, (bubbles,) float32, m3."""
    contact: NDArray[np.float32] | None = None
    """Force with which walls press on the wall of every bubble, (bubbles,) float32, N; None in the model
    kosaka.
    """
    air: NDArray[np.float32] | None = None
    """Air particles, (P, 3) float32, m; None in the model latex, as what follows."""
    cluster: NDArray[np.int32] | None = None
    """Bubble of every particle, (P,) int32, as in a `Frame`."""
    shift: NDArray[np.float32] | None = None
    """Farthest that the wall of every bubble was led out of others in this frame, (bubbles,) float32, m; None
    in the model kosaka.
    """
    slowness: NDArray[np.float32] | None = None
    """How slow every vertex is kept that is led out of other walls, (V,) float32, s/m, as in a `Frame`; None
    in the model kosaka.
    """
    joint_force: NDArray[np.float32] | None = None
    """Force of friction in the joints of every bubble, (bubbles, 2) float32, N, as in a `Frame`; None in the
    model kosaka.
    """

    def copy_to(self, other: FrameArrays) -> None:
        """Copy all arrays into others of the same extent."""
        for mine, its in zip(self._arrays(), other._arrays(), strict=True):
            if mine is not None and its is not None:
                np.copyto(its, mine)

    def places_of(self, place: Place) -> list[NDArray[np.float32]]:
        """Return the points of the walls and of the air of one sculpture: views of these arrays."""
        air = () if self.air is None else tuple([self.air[span] for span in place.air])
        return [*(self.points[span] for span in place.walls), *air]

    def part(self, before: Extent, extent: Extent) -> FrameArrays:
        """Return views of the parts of an extent that follow those of another, `before`."""
        walls = slice(before.vertices, before.vertices + extent.vertices)
        bubbles = slice(before.bubbles, before.bubbles + extent.bubbles)
        air = slice(before.particles or 0, (before.particles or 0) + (extent.particles or 0))
        spans = (walls, walls, bubbles, bubbles, bubbles, air, air, bubbles, walls, bubbles)
        arrays: list[Any] = [
            None if array is None else array[span] for array, span in zip(self._arrays(), spans, strict=True)
        ]
        return FrameArrays(*arrays)

    def frame(self, place: Place, time_code: int, doing: str = "", undone: tuple[str, ...] = ()) -> Frame:
        """Return the frame of one sculpture: views of these arrays."""
        air, cluster, contact, shift = self.air, self.cluster, self.contact, self.shift
        slowness, joint_force = self.slowness, self.joint_force
        return Frame(
            time_code,
            tuple([self.points[span] for span in place.walls]),
            tuple([self.stretch[span] for span in place.walls]),
            self.pressure[place.bubbles],
            self.volume[place.bubbles],
            doing,
            None if contact is None else contact[place.bubbles],
            undone,
            () if air is None else tuple([air[span] for span in place.air]),
            () if cluster is None else tuple([cluster[span] for span in place.air]),
            None if shift is None else shift[place.bubbles],
            () if slowness is None else tuple([slowness[span] for span in place.walls]),
            None if joint_force is None else joint_force[place.bubbles],
        )

    def _arrays(self) -> tuple[Any, ...]:
        return (
            self.points,
            self.stretch,
            self.pressure,
            self.volume,
            self.contact,
            self.air,
            self.cluster,
            self.shift,
            self.slowness,
            self.joint_force,
        )


def _later(span: slice, by: int) -> slice:
    return slice(span.start + by, span.stop + by)
