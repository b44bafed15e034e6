"""What a simulation asks of a model of rubber and air."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame
    from balloon_usd.solver.sight import Sight


class Model(Protocol):
    """Sculptures of one physical model in one flat state, advanced together."""

    def advance(self, begin: float, end: float) -> None:
        """Let the makers act and start the physics from `begin` to `end` (s)."""

    def look(self) -> None:
        """Wait for the state that was reached last; frames are made of it until the next look."""

    def rest(self) -> None:
        """Wait until nothing is under way."""

    @property
    def sight(self) -> Sight:
        """What was looked at, of all sculptures."""

    def frame(self, world: int, time_code: int) -> Frame:
        """Return what was looked at as a frame of one sculpture."""

    def failure(self, world: int) -> str | None:
        """Return what is wrong with a sculpture in a way that its frame does not show, or None."""

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
