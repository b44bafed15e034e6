"""Batches: sculptures in one flat state, advanced, checked and given out one frame at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.turns import turn
from balloon_usd.solver.watch import Lookout

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.model import Model, ModelMaker

Outcome = Frame | SimulationFailed | None
"""What a frame brings for a plan: the frame, its failure, or nothing as it is over."""


class Batch:
    """Some plans performed together in one flat state."""

    def __init__(
        self,
        model: ModelMaker,
        plans: Sequence[Plan],
        meshes: Sequence[tuple[BalloonMesh, ...]],
        frame_counts: Sequence[int],
        substeps: int,
        device: str,
        *,
        ahead: bool,
    ) -> None:
        """Put plans of so many frames each into a state.

        `ahead`: make the next frame while one is checked and given out.
        """
        self._fps = plans[0].recipe.fps
        self._counts = tuple(frame_counts)
        self._over = [False] * len(plans)
        self._ahead = ahead
        with turn():
            self.model: Model = model(plans, meshes, self._fps, substeps, device)
        self._lookout = Lookout(plans, meshes, self._fps, substeps)

    def __len__(self) -> int:
        """Return the number of plans."""
        return len(self._counts)

    def frames(self) -> Iterator[list[Outcome]]:
        """Yield the next frame of every plan until all are finished or have failed."""
        try:
            for index in range(max(self._counts)):
                yield self._next(index)
                if not self._goes_on(index + 1):
                    return
        finally:
            # What was begun ahead ends before its arrays go.
            self.model.rest()

    def _next(self, index: int) -> list[Outcome]:
        """Return the frame of an index, after whose makers and physics those of the next have begun."""
        with turn():
            if index and not self._ahead:
                self._advance(index)
            self.model.look()
            # A plan that fails in this frame still takes part in the next one, unseen.
            if self._ahead and self._goes_on(index + 1):
                self._advance(index + 1)
            self._lookout.look(self.model.sight)
            return [self._outcome(world, index) for world in range(len(self))]

    def _advance(self, index: int) -> None:
        self.model.advance((index - 1) / self._fps, index / self._fps)

    def _goes_on(self, index: int) -> bool:
        return any(index < count and not over for count, over in zip(self._counts, self._over, strict=True))

    def _outcome(self, world: int, index: int) -> Outcome:
        if self._over[world] or index >= self._counts[world]:
            return None
        frame = self.model.frame(world, index + 1)
        cause = self._lookout.failure(world, frame) or self.model.failure(world)
        if cause is None:
            return frame
        self._over[world] = True
        self.model.give_up(world)
        return SimulationFailed(frame.doing, index / self._fps, cause, index + 1)
