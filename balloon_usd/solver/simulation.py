"""Simulations: plans in, frames out, many sculptures in one flat state."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.detail import Detail, detail_named
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.meshing import joint_places, mesh_of
from balloon_usd.solver.body import Body, tube_body
from balloon_usd.solver.device import device_named
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.hands import Hands
from balloon_usd.solver.maker import Maker
from balloon_usd.solver.scene import build_scene
from balloon_usd.solver.settings import SceneSettings
from balloon_usd.solver.stepper import Stepper
from balloon_usd.solver.struts import StrutLaw, Struts
from balloon_usd.solver.watch import SHORT_OF_GAS, Watch

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip

NOMINAL_RATE = 24.0
"""Frame rate for which the levels of detail give their substeps, 1/s."""
SPREAD = 0.14
"""Distance between two balloons of one sculpture before they are joined, m."""
SEALED_KNOT = 0.7
"""Pressure in the knot bead, in Maxwell pressures of its balloon."""
STRUTS_PER_JOINT = 12
"""Room for struts, per joint of the scene."""


class Simulation:
    """Plans performed together, one frame at a time."""

    def __init__(self, plans: Sequence[Plan], detail: Detail, device: str) -> None:
        self.plans = tuple(plans)
        self.detail = detail
        self.device = device
        self.fps = _one_rate(self.plans)
        self.substeps = _substeps(self.plans, detail, self.fps)
        self.meshes: list[tuple[BalloonMesh, ...]] = []
        bodies: list[Body] = []
        worlds: list[int] = []
        for world, plan in enumerate(self.plans):
            meshes = tuple(mesh_of(strip, detail) for strip in plan.strips.values())
            self.meshes.append(meshes)
            for k, (strip, mesh) in enumerate(zip(plan.strips.values(), meshes, strict=True)):
                bodies.append(_body(plan, strip, mesh, k - 0.5 * (len(meshes) - 1)))
                worlds.append(world)
        physics = self.plans[0].recipe.physics
        settings = SceneSettings(
            dt=1.0 / (self.fps * self.substeps),
            gravity=physics.gravity,
            friction=physics.friction,
            scale_mass=physics.mass_scaling == "selective",
        )
        rings = sum(len(b.rings) for b in bodies)
        self.scene = build_scene(bodies, worlds, settings, device, rings, STRUTS_PER_JOINT * rings)
        self.stepper = Stepper(self.scene, self.substeps, _reach(bodies, settings))
        self.hands = Hands(self.scene)
        self.struts = Struts(self.scene, StrutLaw())
        first = np.concatenate([[0], np.cumsum([len(m) for m in self.meshes])])
        self.makers = [
            Maker(plan, self.scene, self.hands, self.struts, int(first[w]))
            for w, plan in enumerate(self.plans)
        ]
        self._first_body = first
        self.watches = [Watch(plan, m, self.fps) for plan, m in zip(self.plans, self.meshes, strict=True)]

    @property
    def frame_counts(self) -> tuple[int, ...]:
        """Number of frames of every plan; the first shows the flat balloons."""
        return tuple(1 + math.ceil(plan.choreography.seconds * self.fps - 1e-6) for plan in self.plans)

    def frames(self) -> Iterator[list[Frame | SimulationFailed | None]]:
        """Yield the next frame of every plan until all are finished.

        A plan that has failed yields its `SimulationFailed` once; a plan that is over yields None.
        """
        counts = self.frame_counts
        over = [False] * len(self.plans)
        for index in range(max(counts)):
            if index:
                self._advance(index)
            frames: list[Frame | SimulationFailed | None] = []
            state = self._state()
            for world, count in enumerate(counts):
                outcome = None if over[world] or index >= count else self._outcome(world, index, state)
                over[world] = over[world] or not isinstance(outcome, Frame)
                frames.append(outcome)
            if all(over):
                if any(frames):
                    yield frames
                return
            yield frames

    def _advance(self, index: int) -> None:
        middle = self.scene.ring_middle.numpy()
        begin, end = (index - 1) / self.fps, index / self.fps
        for maker in self.makers:
            maker.act(begin, end, middle)
        self.hands.upload()
        self.stepper.advance(contact=bool(self.hands.touching.any()))
        self.hands.arrived()

    def _state(self) -> dict[str, np.ndarray]:
        """Fetch what frames are made of."""
        self.stepper.stretch()
        names = ("x", "stretch", "pressure", "volume", "most_hits", "amount")
        return {name: self.scene.arrays[name].numpy() for name in names}

    def _outcome(self, world: int, index: int, state: dict[str, np.ndarray]) -> Frame | SimulationFailed:
        s, maker = self.scene, self.makers[world]
        bodies = range(self._first_body[world], self._first_body[world + 1])
        spans = [slice(s.vertex_start[b], s.vertex_start[b + 1]) for b in bodies]
        # The lip and the knot bead come before the bubbles of every balloon.
        bubbles = np.concatenate([np.arange(s.segment_start[b] + 2, s.segment_start[b + 1]) for b in bodies])
        frame = Frame(
            index + 1,
            tuple(state["x"][span].copy() for span in spans),
            tuple(state["stretch"][span].copy() for span in spans),
            state["pressure"][bubbles],
            state["volume"][bubbles],
            maker.doing,
        )
        failed = self.watches[world].failure(frame, int(state["most_hits"][world])) or self._short_of_gas(
            maker, bodies, index, state["amount"]
        )
        if failed is not None:
            self.hands.give_up(bodies)
        return failed or frame

    def _short_of_gas(
        self, maker: Maker, bodies: range, index: int, amount: np.ndarray
    ) -> SimulationFailed | None:
        """Tell when inflating has ended without the gas that the plan asks for."""
        s = self.scene
        for b in bodies:
            if maker.inflated == index:
                got = float(amount[s.segment_start[b] + 2 : s.segment_start[b + 1]].sum())
                if got < SHORT_OF_GAS * self.hands.pump_goal[b]:
                    share = got / self.hands.pump_goal[b]
                    cause = f"the pump brought only {share:.0%} of the gas: give it more seconds"
                    return SimulationFailed(maker.doing, index / self.fps, cause)
        return None


def _one_rate(plans: Sequence[Plan]) -> float:
    rates = {plan.recipe.fps for plan in plans}
    if len(rates) != 1:
        raise ValueError(f"sculptures that advance together need one frame rate, got {sorted(rates)}")
    return float(rates.pop())


def _substeps(plans: Sequence[Plan], detail: Detail, fps: float) -> int:
    wanted = [
        plan.recipe.physics.substeps or math.ceil(detail.substeps * NOMINAL_RATE / fps) for plan in plans
    ]
    return max(wanted) + max(wanted) % 2


def _body(plan: Plan, strip: Strip, mesh: BalloonMesh, place: float) -> Body:
    pressure = SEALED_KNOT * maxwell_state(strip.rubber).p_star * strip.size.thickness / strip.size.radius
    guides = tuple(r.along for r in plan.table.rings if r.balloon == strip.balloon and not r.joint)
    body = tube_body(
        mesh, strip.rubber, strip.size.radius, strip.size.thickness, joint_places(strip), guides, pressure
    )
    body.points[:, 1] += np.float32(place * SPREAD)
    return body


def _reach(bodies: Sequence[Body], settings: SceneSettings) -> float:
    """Cell size of the contact search, m: the bulged size of a quad and the contact offset."""
    widest = max(2.0 * math.pi * b.radius / b.rings[0].around for b in bodies)
    return 5.0 * widest + 2.0 * settings.contact_offset


def simulate_many(plans: Sequence[Plan], detail: str = "draft", device: str = "auto") -> Simulation:
    """Return a simulation of several plans that advance together.

    Raises:
        DeviceUnavailable: there is no such device.
        ValueError: the plans have different frame rates, or there is no such level of detail.
    """
    return Simulation(plans, detail_named(detail), device_named(device))
