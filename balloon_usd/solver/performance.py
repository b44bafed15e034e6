"""One plan performed: the simulation as an iterator of frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.simulation import simulate_many

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame
    from balloon_usd.solver.simulation import Simulation


class Performance:
    """The frames of one plan, each computed when it is asked for."""

    def __init__(self, simulation: Simulation) -> None:
        """Take over a simulation of one plan."""
        self._simulation = simulation
        self._frames = simulation.frames()

    @property
    def detail(self) -> str:
        """Level of detail."""
        return self._simulation.detail.name

    @property
    def plan(self) -> Plan:
        """What is performed."""
        return self._simulation.plans[0]

    @property
    def meshes(self) -> tuple[BalloonMesh, ...]:
        """One mesh a balloon, in the order of `Plan.strips`."""
        return self._simulation.meshes[0]

    @property
    def frame_count(self) -> int:
        """Number of frames; the first shows the flat balloons."""
        return self._simulation.frame_counts[0]

    def __iter__(self) -> Self:
        """Return the iterator itself: a performance can be watched once."""
        return self

    def __next__(self) -> Frame:
        """Compute the next frame.

        Raises:
            SimulationFailed: the physics broke down; no frame comes after this.
        """
        (outcome,) = next(self._frames)
        if isinstance(outcome, SimulationFailed):
            raise outcome
        assert outcome is not None, "one plan alone is over when its simulation is"
        return outcome


def simulate(plan: Plan, detail: str = "draft", device: str = "auto") -> Performance:
    """Return the frames of a plan, as they are computed.

    Args:
        plan: what is made.
        detail: draft, preview or full.
        device: cpu, cuda:N, or auto for the first CUDA device and else the CPU.

    Raises:
        DeviceUnavailable: there is no such device.
        ValueError: there is no such level of detail.
    """
    return Performance(simulate_many([plan], detail=detail, device=device))
