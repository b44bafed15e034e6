"""The interface between a simulation and its physical model."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import FrameArrays
    from balloon_usd.solver.layout import Layout


class Status(NamedTuple):
    """What a sculpture is doing, for messages."""

    doing: str
    """What the hands do."""
    undone: tuple[str, ...] = ()
    """Locks that have slipped and joints that have come undone so far."""


class Model(Protocol):
    """Sculptures of one physical model in one flat state, advanced together."""

    layout: Layout
    """Where every sculpture lies in the arrays of a frame."""

    def advance(self, begin: float, end: float) -> None:
        """Let the performers act and start the physics from `begin` to `end` (s)."""

    def read_back(self) -> None:
        """Wait for the read-back of the latest state: what follows is of that state, until the next
        read-back.
        """

    def rest(self) -> None:
        """Wait for the pending read-back, and so for all work before it."""

    @property
    def frame_arrays(self) -> FrameArrays:
        """Arrays of the state read back last, of all sculptures; valid for two more read-backs."""

    @property
    def statuses(self) -> Sequence[Status]:
        """Status of every sculpture then."""

    @property
    def suspects(self) -> NDArray[np.int32]:
        """1 for every sculpture with walls that went too far or are stretched too much, (W,)."""

    def failures(self) -> dict[int, str]:
        """Return failures that the frames do not show, by sculpture."""

    def give_up(self, world: int) -> None:
        """Leave a sculpture alone whose run has failed."""


class ModelMaker(Protocol):
    """Puts plans into a new flat state of a model."""

    def usual_substeps(self, detail: Detail, /) -> int:
        """Return the substeps of a frame at 24 frames per second."""

    def __call__(
        self,
        plans: Sequence[Plan],
        meshes: Sequence[Sequence[BalloonMesh]],
        fps: float,
        substeps: int,
        device: str,
    ) -> Model:
        """Return the model, ready for its first frame."""
