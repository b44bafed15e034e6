"""The latex model of some plans: bodies, makers and stepper in one flat state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.meshing import joint_places
from balloon_usd.solver.body import body_ranges, places_beside
from balloon_usd.solver.checks import crowded, stretch_limits
from balloon_usd.solver.frame_arrays import FrameArrays
from balloon_usd.solver.kernels.arrays.rows import HITS
from balloon_usd.solver.latex.body import LatexBody, tube_body
from balloon_usd.solver.latex.controls import LatexControls
from balloon_usd.solver.latex.leak import Leak
from balloon_usd.solver.latex.maker import LatexMaker
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.latex.shape_body import shape_body
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.latex.struts import StrutLaw, Struts
from balloon_usd.solver.layout import Layout
from balloon_usd.solver.readback import Readback
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.model import Status

SEALED_KNOT = 0.7
"""Pressure in the knot bead, in Maxwell pressures of its balloon."""
STRUTS_PER_JOINT = 12
"""Capacity for struts, per joint of the scene."""
SHORT_OF_GAS = 0.98
"""Share of the wanted gas below which inflating counts as failed."""
READ_BACK = (
    "x",
    "stretch",
    "pressure",
    "volume",
    "most_hits",
    "amount",
    "ring_middle",
    "wall_load",
    "suspects",
)
"""Arrays that are read back for every frame."""


class LatexModel:
    """Sculptures of hyperelastic rubber and real gas."""

    def __init__(
        self,
        plans: Sequence[Plan],
        meshes: Sequence[Sequence[BalloonMesh]],
        fps: float,
        substeps: int,
        device: str,
    ) -> None:
        self._bodies = body_ranges([len(m) for m in meshes])
        bodies = [body for plan, m in zip(plans, meshes, strict=True) for body in _bodies(plan, m)]
        worlds = [world for world, run in enumerate(self._bodies) for _ in run]
        physics = plans[0].recipe.physics
        settings = SceneSettings(
            dt=1.0 / (fps * substeps),
            gravity=physics.gravity,
            friction=physics.friction,
            scale_mass=physics.mass_scaling == "selective",
        )
        rings = sum(len(b.rings) for b in bodies)
        self.scene = build_scene(bodies, worlds, settings, device, rings, STRUTS_PER_JOINT * rings)
        self.scene.stretch_limit.assign(stretch_limits(plans, self._bodies))
        self.stepper = Stepper(self.scene, substeps)
        self.hands = LatexControls(self.scene)
        self._struts = Struts(self.scene, StrutLaw())
        self.makers = [
            LatexMaker(plan, self.scene, self.hands, self._struts, run.start)
            for plan, run in zip(plans, self._bodies, strict=True)
        ]
        self._leak = Leak(plans, self.scene, self.hands, self._bodies)
        self._readback = Readback(self.scene, READ_BACK)
        self.layout = Layout(self.scene, self._bodies)
        self._state: dict[str, NDArray[Any]] = {}
        self.statuses: list[Status] = []
        """Status of every sculpture when the state was read back."""
        self._inflated: list[int] = []
        """Sculptures whose last balloon had just got its gas then."""
        self._start_readback()

    @staticmethod
    def usual_substeps(detail: Detail) -> int:
        """Return the substeps of a frame at 24 frames per second: a finer mesh needs more."""
        return detail.substeps

    def advance(self, begin: float, end: float) -> None:
        """Let the makers act and start the physics from `begin` to `end` (s)."""
        middle = self._state["ring_middle"].copy()
        self.hands.update(self._state)
        self.hands.lift_fingers()
        astray = self.layout.astray(middle)
        for maker, lost in zip(self.makers, astray, strict=True):
            if not lost:
                maker.act(begin, end, middle)
        self._leak.advance(begin, end, self._state)
        self._struts.put(middle)
        self.hands.upload()
        self.stepper.advance(contact=bool(self.hands.touching.any()), fingers=self.hands.pressing)
        self.hands.arrived()
        self._start_readback()

    def _start_readback(self) -> None:
        """Start reading back the present state, from which frames are made."""
        self.stepper.start_readback(self._readback, contact=bool(self.hands.touching.any()))

    def read_back(self) -> None:
        """Wait for the read-back of the latest state: what follows is of that state, until the next
        read-back.
        """
        self._state = self._readback.arrays()
        self.statuses = [maker.status for maker in self.makers]
        self._inflated = [world for world, m in enumerate(self.makers) if m.just_inflated]

    def rest(self) -> None:
        """Wait for the pending read-back, and so for all work before it."""
        self._readback.wait()

    @property
    def frame_arrays(self) -> FrameArrays:
        """Arrays of the state read back last, of all sculptures; valid for two more read-backs."""
        state, bubbles = self._state, self.layout.bubbles
        gas = (state[name][bubbles] for name in ("pressure", "volume", "wall_load"))
        return FrameArrays(state["x"], state["stretch"], *gas)

    @property
    def suspects(self) -> NDArray[np.int32]:
        """1 for every sculpture with walls that went too far or are stretched too much, (W,)."""
        suspects: NDArray[np.int32] = self._state["suspects"]
        return suspects

    def failures(self) -> dict[int, str]:
        """Return failures that the frames do not show, by sculpture."""
        found = {world: cause for world in self._inflated if (cause := self._short_of_gas(world))}
        most_hits = self._state["most_hits"]
        return found | {
            world: crowded(int(most_hits[world])) for world in np.flatnonzero(most_hits > HITS).tolist()
        }

    def give_up(self, world: int) -> None:
        """Leave a sculpture alone whose run has failed."""
        self.hands.give_up(self._bodies[world])

    def _short_of_gas(self, world: int) -> str | None:
        """Tell when inflating has ended without the gas that the plan asks for."""
        for b in self._bodies[world]:
            got = float(self._state["amount"][self.scene.bubbles_of(b)].sum())
            if got < SHORT_OF_GAS * self.hands.pump_goal[b]:
                share = got / self.hands.pump_goal[b]
                return f"the pump brought only {share:.0%} of the gas: give it more seconds"
        return None


def _bodies(plan: Plan, meshes: Sequence[BalloonMesh]) -> list[LatexBody]:
    """Return the balloons of a plan, side by side."""
    bodies = [_body(plan, strip, mesh) for strip, mesh in zip(plan.strips.values(), meshes, strict=True)]
    # A mesh lies where its file and the recipe say.
    beside = [body for body in bodies if body.rings]
    for body, place in zip(beside, places_beside(len(beside)), strict=True):
        body.points[:, 1] += place
    return bodies


def _body(plan: Plan, strip: Strip, mesh: BalloonMesh) -> LatexBody:
    if strip.shape is not None:
        return shape_body(mesh, strip.rubber, strip.size.thickness)
    pressure = SEALED_KNOT * maxwell_state(strip.rubber).p_star * strip.size.thickness / strip.size.radius
    guides = tuple(r.along for r in plan.table.rings if r.balloon == strip.balloon and not r.joint)
    return tube_body(
        mesh, strip.rubber, strip.size.radius, strip.size.thickness, joint_places(strip), guides, pressure
    )
