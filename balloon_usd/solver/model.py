"""What a simulation asks of a model of rubber and air."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import Sight
    from balloon_usd.solver.layout import Layout


class Told(NamedTuple):
    """What is told of a sculpture in words."""

    doing: str
    """What the hands do."""
    undone: tuple[str, ...] = ()
    """Locks that have slipped and joints that have come undone so far."""


class Model(Protocol):
    """Sculptures of one physical model in one flat state, advanced together."""

    layout: Layout
    """Where every sculpture lies in its sights."""

    def advance(self, begin: float, end: float) -> None:
        """Let the makers act and start the physics from `begin` to `end` (s)."""

    def look(self) -> None:
        """Wait for the state that was reached last, of which all that follows tells until the next look."""

    def rest(self) -> None:
        """Wait until nothing is under way."""

    @property
    def sight(self) -> Sight:
        """What was looked at, of all sculptures; it stays as it is for two more looks."""

    @property
    def told(self) -> Sequence[Told]:
        """What was told of every sculpture by then."""

    @property
    def suspects(self) -> NDArray[np.int32]:
        """1 for every sculpture with walls that went too far or are stretched too much, (W,)."""

    def failures(self) -> dict[int, str]:
        """Return what is wrong with sculptures in a way that their frames do not show."""

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
