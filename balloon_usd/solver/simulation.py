"""Simulations: plans in, frames out, many sculptures in one flat state."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeVar

from balloon_usd.balloon.detail import Detail, detail_named
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.solver.device import device_named
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.kosaka.model import KosakaModel
from balloon_usd.solver.kosaka.parameters import SUBSTEPS as KOSAKA_SUBSTEPS
from balloon_usd.solver.latex.model import LatexModel
from balloon_usd.solver.watch import Watch

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.model import Model, ModelMaker

T = TypeVar("T")

NOMINAL_RATE = 24.0
"""Frame rate for which substeps are given, 1/s."""

MODELS: dict[str, ModelMaker] = {"latex": LatexModel, "kosaka": KosakaModel}
"""Physical models by the names that recipes give them."""


class Simulation:
    """Plans performed together, one frame at a time."""

    def __init__(self, plans: Sequence[Plan], detail: Detail, device: str) -> None:
        self.plans = tuple(plans)
        self.detail = detail
        self.device = device
        self.fps = _the_one("frame rate", [plan.recipe.fps for plan in plans])
        model = _the_one("model", [plan.recipe.physics.model for plan in plans])
        self.substeps = _substeps(
            self.plans, KOSAKA_SUBSTEPS if model == "kosaka" else detail.substeps, self.fps
        )
        self.meshes: list[tuple[BalloonMesh, ...]] = [
            tuple(mesh_of(strip, detail) for strip in plan.strips.values()) for plan in self.plans
        ]
        self.model: Model = MODELS[model](self.plans, self.meshes, self.fps, self.substeps, device)
        self.watches = [
            Watch(plan, m, self.fps, self.substeps) for plan, m in zip(self.plans, self.meshes, strict=True)
        ]

    @property
    def frame_counts(self) -> tuple[int, ...]:
        """Number of frames of every plan; the first shows the balloons before anything is done."""
        return tuple(1 + math.ceil(plan.choreography.seconds * self.fps - 1e-6) for plan in self.plans)

    def frames(self) -> Iterator[list[Frame | SimulationFailed | None]]:
        """Yield the next frame of every plan until all are finished.

        A plan that has failed yields its `SimulationFailed` once; a plan that is over yields None.
        """
        counts = self.frame_counts
        over = [False] * len(self.plans)
        for index in range(max(counts)):
            if index:
                self.model.advance((index - 1) / self.fps, index / self.fps)
            frames: list[Frame | SimulationFailed | None] = []
            self.model.look()
            for world, count in enumerate(counts):
                outcome = None if over[world] or index >= count else self._outcome(world, index)
                over[world] = over[world] or not isinstance(outcome, Frame)
                frames.append(outcome)
            if all(over):
                if any(frames):
                    yield frames
                return
            yield frames

    def _outcome(self, world: int, index: int) -> Frame | SimulationFailed:
        frame = self.model.frame(world, index + 1)
        cause = self.watches[world].failure(frame) or self.model.failure(world)
        if cause is None:
            return frame
        self.model.give_up(world)
        return SimulationFailed(frame.doing, index / self.fps, cause, index + 1)


def _the_one(what: str, values: Sequence[T]) -> T:
    """Return what all plans have in common."""
    if len(set(values)) != 1:
        raise ValueError(
            f"sculptures that advance together need one {what}, got {sorted(map(str, set(values)))}"
        )
    return values[0]


def _substeps(plans: Sequence[Plan], usual: int, fps: float) -> int:
    wanted = [plan.recipe.physics.substeps or math.ceil(usual * NOMINAL_RATE / fps) for plan in plans]
    return max(wanted) + max(wanted) % 2


def simulate_many(plans: Sequence[Plan], detail: str = "draft", device: str = "auto") -> Simulation:
    """Return a simulation of several plans that advance together.

    Raises:
        DeviceUnavailable: there is no such device.
        ValueError: the plans have different frame rates or models, or there is no such level of detail.
    """
    return Simulation(plans, detail_named(detail), device_named(device))
