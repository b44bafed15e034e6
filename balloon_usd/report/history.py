"""What every bubble and every flat tail did, frame after frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.report.step_marks import StepMark, step_marks
from balloon_usd.solver.flat_tails import FlatTails

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.quality.crossing_history import CrossingHistory
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]


class History:
    """Gathers the frames of one sculpture into a few numbers each; no mesh is kept."""

    def __init__(
        self, plan: Plan, meshes: Sequence[BalloonMesh], crossings: CrossingHistory | None = None
    ) -> None:
        """Begin with nothing seen.

        Args:
            plan: of the sculpture.
            meshes: one a balloon, in the order of `Plan.strips`.
            crossings: filled by who counts them; None where nobody does.
        """
        self.plan = plan
        self.crossings = crossings
        self._tails = FlatTails(plan, meshes)
        self._owners = _owners(plan, meshes)
        self._time_codes: list[int] = []
        self._pressure: list[Floats] = []
        self._volume: list[Floats] = []
        self._stretch: list[Floats] = []
        self._tail: list[list[float]] = []
        self._contact: list[Floats] = []
        self._undone: dict[str, int] = {}

    def add(self, frame: Frame) -> None:
        """Take in the next frame; it may be changed or thrown away afterwards."""
        self._time_codes.append(frame.time_code)
        self._pressure.append(frame.pressure.astype(np.float64))
        self._volume.append(frame.volume.astype(np.float64))
        highest = np.zeros(len(self.plan.bubbles))
        for balloon, owner in enumerate(self._owners):
            highest[owner.bubbles] = np.maximum.reduceat(frame.forced(balloon)[owner.order], owner.starts)
        self._stretch.append(highest)
        if frame.contact is not None:
            self._contact.append(frame.contact.astype(np.float64))
        for name in frame.undone:
            self._undone.setdefault(name, frame.time_code)
        self._tail.append(self._tails.left(frame))

    @property
    def time_codes(self) -> tuple[int, ...]:
        """Numbers of the frames, from 1 for the first of the animation."""
        return tuple(self._time_codes)

    @property
    def times(self) -> Floats:
        """Time of every frame since the start of the animation, (N,) float64, s."""
        return (np.array(self._time_codes, dtype=np.float64) - 1.0) / self.plan.recipe.fps

    @property
    def bubble_names(self) -> tuple[str, ...]:
        """Bubbles in plan order, as the columns of what follows."""
        return tuple(bubble.name for bubble in self.plan.bubbles)

    @property
    def pressure(self) -> Floats:
        """Gauge pressure of every bubble, (N, bubbles) float64, Pa."""
        return np.array(self._pressure).reshape(len(self._time_codes), -1)

    @property
    def volume(self) -> Floats:
        """Gas of every bubble, (N, bubbles) float64, m3."""
        return np.array(self._volume).reshape(len(self._time_codes), -1)

    @property
    def stretch(self) -> Floats:
        """Largest principal stretch of every bubble's wall, but where it is led out of others, (N, bubbles)
        float64.
        """
        return np.array(self._stretch).reshape(len(self._time_codes), -1)

    @property
    def contact(self) -> Floats | None:
        """Force with which walls press on every bubble, (N, bubbles) float64, N; None of a model without."""
        return np.array(self._contact) if self._contact else None

    @property
    def undone(self) -> tuple[tuple[str, int], ...]:
        """Locks that slipped and joints that came undone, each with the first frame that shows it."""
        return tuple(self._undone.items())

    @property
    def tail_names(self) -> tuple[str, ...]:
        """Balloons that have a tail: only tubes do."""
        return self._tails.names

    @property
    def tail(self) -> Floats:
        """Flat rubber at the tip of every such balloon, (N, tails) float64, m."""
        return np.array(self._tail).reshape(len(self._time_codes), len(self.tail_names))

    @property
    def marks(self) -> tuple[StepMark, ...]:
        """Steps that are seen in the frames; the first of them may have begun before."""
        if not self._time_codes:
            return ()
        first, last = self._time_codes[0], self._time_codes[-1]
        marks = [mark for mark in step_marks(self.plan) if mark.time_code <= last]
        over = [mark for mark in marks if mark.time_code <= first]
        return tuple(marks[max(len(over) - 1, 0) :])

    @property
    def events(self) -> tuple[StepMark, ...]:
        """Steps that are seen in the frames, and what came undone, in time."""
        undone = [StepMark(code, None, f"comes undone: {name}") for name, code in self.undone]
        return tuple(sorted([*self.marks, *undone], key=lambda mark: mark.time_code))


class _Owners(NamedTuple):
    """The vertices of one balloon by the bubbles that they belong to."""

    order: NDArray[np.int64]
    """Vertices (V,), those of each bubble together."""
    starts: NDArray[np.int64]
    """Where those of each bubble begin."""
    bubbles: NDArray[np.int64]
    """The bubbles in plan order, without such as have no vertex."""


def _owners(plan: Plan, meshes: Sequence[BalloonMesh]) -> list[_Owners]:
    """Return the vertices of every balloon by bubbles."""
    owners, before = [], 0
    for strip, mesh in zip(plan.strips.values(), meshes, strict=True):
        ends = np.array([bubble.rest_end for bubble in strip.bubbles[:-1]])
        owner = before + np.searchsorted(ends, mesh.along, side="left")
        order = np.argsort(owner, kind="stable")
        bubbles, starts = np.unique(owner[order], return_index=True)
        owners.append(_Owners(order, starts, bubbles))
        before += len(strip.bubbles)
    return owners
