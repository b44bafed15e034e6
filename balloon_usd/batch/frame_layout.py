"""How frames of several sculptures lie in shared memory: array by array, in each sculpture by sculpture."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.solver.frame import Frame

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

NUMBER_BYTES = 4
"""Size of a float32 and of an int32 [B]."""


@dataclass(frozen=True)
class Counts:
    """Sizes of the arrays of one sculpture."""

    vertices: tuple[int, ...]
    """Of every balloon."""
    bubbles: int
    particles: tuple[int, ...] = ()
    """Of the air of every balloon; empty where the air is no particles."""
    has_contact: bool = True
    """Whether its frames hold the force with which walls press on each bubble."""

    @classmethod
    def of(cls, frame: Frame) -> Counts:
        """Count what a frame holds."""
        return cls(
            tuple(len(points) for points in frame.points),
            len(frame.pressure),
            tuple(len(points) for points in frame.air),
            frame.contact is not None,
        )

    @property
    def sizes(self) -> tuple[tuple[int, ...], ...]:
        """Numbers of 4 bytes of each array of `Frame`: one a balloon, or one a sculpture."""
        contact = (self.bubbles,) if self.has_contact else (0,)
        return (
            tuple(3 * vertices for vertices in self.vertices),
            self.vertices,
            (self.bubbles,),
            (self.bubbles,),
            contact,
            tuple(3 * particles for particles in self.particles),
            self.particles,
        )


class FrameLayout:
    """Places of all arrays of a frame of several sculptures in one float32 array."""

    def __init__(self, counts: Sequence[Counts]) -> None:
        """Lay out sculptures one behind the other in each array."""
        self._counts = tuple(counts)
        totals = [tuple(sum(part) for part in count.sizes) for count in counts]
        self._arrays = tuple(accumulate((sum(array) for array in zip(*totals, strict=True)), initial=0))
        within = zip(*(accumulate(array, initial=0) for array in zip(*totals, strict=True)), strict=True)
        self._starts = [
            tuple(start + place for start, place in zip(self._arrays, places, strict=False))
            for places in within
        ]
        self.numbers: int = self._arrays[-1]
        """Numbers of 4 bytes in a frame of all."""

    @property
    def frame_bytes(self) -> int:
        """Size of a frame of all sculptures [B]."""
        return NUMBER_BYTES * self.numbers

    def put(self, room: NDArray[np.float32], place: int, frame: Frame) -> None:
        """Copy a frame of the sculpture at a place into a room (numbers,) float32."""
        points, stretch, pressure, volume, contact, air, cluster = self._views(room, place)
        contacts = () if frame.contact is None else (frame.contact,)
        _copy(points, [array.reshape(-1) for array in frame.points])
        _copy(stretch, frame.stretch)
        _copy([*pressure, *volume], (frame.pressure, frame.volume))
        _copy(contact[: len(contacts)], contacts)
        _copy(air, [array.reshape(-1) for array in frame.air])
        _copy([view.view(np.int32) for view in cluster], frame.cluster)

    def get(self, room: NDArray[np.float32], place: int, time_code: int, undone: tuple[str, ...]) -> Frame:
        """Return a copy of the frame of the sculpture at a place."""
        copies = [[view.copy() for view in views] for views in self._views(room, place)]
        points, stretch, pressure, volume, contact, air, cluster = copies
        return Frame(
            time_code,
            tuple(array.reshape(-1, 3) for array in points),
            tuple(stretch),
            pressure[0],
            volume[0],
            "",
            contact[0] if self._counts[place].has_contact else None,
            undone,
            tuple(array.reshape(-1, 3) for array in air),
            tuple(array.view(np.int32) for array in cluster),
        )

    def _views(self, room: NDArray[np.float32], place: int) -> list[list[NDArray[np.float32]]]:
        """Views of the arrays of a sculpture, in the order of `Counts.sizes`."""
        return [
            [room[begin:end] for begin, end in pairwise(accumulate(sizes, initial=start))]
            for start, sizes in zip(self._starts[place], self._counts[place].sizes, strict=True)
        ]


def _copy(targets: Iterable[NDArray[Any]], sources: Iterable[NDArray[Any]]) -> None:
    for target, source in zip(targets, sources, strict=True):
        target[...] = source
