"""What the physical models share: sculptures in one flat state; hands, physics and read-back take turns."""

from __future__ import annotations

from abc import ABC, abstractmethod
from itertools import chain, compress
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from balloon_usd.solver.sculpture import ComingFrame

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import FrameArrays
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.layout import Layout
    from balloon_usd.solver.performer import Performer
    from balloon_usd.solver.placement import Placed
    from balloon_usd.solver.readback import Readback
    from balloon_usd.solver.severed import Severed
    from balloon_usd.solver.status import Status


class Model(ABC):
    """Sculptures of one physical model in one flat state, advanced together."""

    def __init__(
        self,
        hands: Hands,
        performers: Sequence[Performer],
        bodies: Sequence[range],
        layout: Layout,
        readback: Readback,
    ) -> None:
        """Begin before the first frame; `bodies`: those of every sculpture in the flat state."""
        self.performers = tuple(performers)
        self.layout = layout
        """Where every sculpture lies in the arrays of a frame."""
        self.statuses: list[Status] = []
        """Status of every sculpture when the state was read back."""
        self.placements: dict[int, Placed] = {}
        """Where frames show the sculptures that are not where they were made, as of that state."""
        self.severed: dict[int, tuple[Severed, ...]] = {}
        """What was cut off of sculptures, as of that state."""
        self._hands, self._bodies, self._readback = hands, bodies, readback
        self.over = np.zeros(len(self.performers), dtype=bool)
        """Sculptures that are left alone, since their runs have ended or failed, (W,)."""
        self._state: dict[str, NDArray[Any]] = {}
        """Arrays of the state read back last, by name."""

    def advance(self, begin: float, end: float) -> None:
        """Let the performers act and start the physics from `begin` to `end` (s)."""
        middle = self._state["ring_middle"].copy()
        self._hands.begin_frame(self._state)
        frame = ComingFrame(begin, end, middle)
        for world in np.flatnonzero(~self.over & ~self.layout.astray(middle)).tolist():
            self.performers[world].act(frame)
        self._start_physics(begin, end, middle)

    @abstractmethod
    def _start_physics(self, begin: float, end: float, middle: NDArray[np.float32]) -> None:
        """Upload what the hands do from `begin` to `end` (s), start the physics, and reading back its state.

        `middle`: where all rings are at the beginning, (J, 3), m.
        """

    def read_back(self) -> None:
        """Wait for the read-back of the latest state: what follows is of that state, until the next
        read-back.
        """
        self._state = self._readback.arrays()
        self.statuses = [performer.status for performer in self.performers]
        placed = enumerate(performer.sculpture.placed for performer in self.performers)
        self.placements = {world: where for world, where in placed if where is not None}
        cut = enumerate(tuple(performer.sculpture.severed.values()) for performer in self.performers)
        self.severed = {world: found for world, found in cut if found}

    def rest(self) -> None:
        """Wait for the pending read-back, and so for all work before it."""
        self._readback.wait()

    @property
    @abstractmethod
    def frame_arrays(self) -> FrameArrays:
        """Arrays of the state read back last, of all sculptures; valid for two more read-backs."""

    @property
    def suspects(self) -> NDArray[np.int32]:
        """1 for every sculpture with walls that went too far or are stretched too much, (W,)."""
        suspects: NDArray[np.int32] = self._state["suspects"]
        return suspects

    @abstractmethod
    def failures(self) -> dict[int, str]:
        """Return failures that the frames do not show, by sculpture."""

    def leave(self, over: NDArray[np.bool_]) -> None:
        """Leave sculptures alone whose runs have ended or failed, (W,)."""
        self.over = over
        self._hands.stop_touching(chain.from_iterable(compress(self._bodies, over)))


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
        threads: int,
    ) -> Model:
        """Return the model, ready for its first frame; `threads`: of a CPU that may advance it together."""
