"""The latex model of some plans: bodies, performers and stepper in one flat state."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.operations.disjoint_sets import roots_of
from balloon_usd.operations.moves import Inflate, Press, Weld
from balloon_usd.plan.meshing import joint_places
from balloon_usd.plan.nesting import hosts_of
from balloon_usd.plan.parking import parked
from balloon_usd.solver.body import body_ranges
from balloon_usd.solver.checks import stretch_limits
from balloon_usd.solver.frame_arrays import FrameArrays
from balloon_usd.solver.kernels.arrays.rows import STRUT_SLOTS
from balloon_usd.solver.latex.body import LatexBody, tube_body
from balloon_usd.solver.latex.controls import LatexControls
from balloon_usd.solver.latex.friction import Friction
from balloon_usd.solver.latex.jams import Jams
from balloon_usd.solver.latex.joint_forces import JointForces
from balloon_usd.solver.latex.leak import Leak
from balloon_usd.solver.latex.motions.table import LATEX_MOTIONS
from balloon_usd.solver.latex.round_body import round_body
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.latex.sculpture import LatexSculpture
from balloon_usd.solver.latex.shape_body import shape_body
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.latex.struts import StrutLaw, Struts
from balloon_usd.solver.layout import Layout
from balloon_usd.solver.model import Model
from balloon_usd.solver.performer import Performer
from balloon_usd.solver.readback import Readback
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.latex.scene import LatexScene

SEALED_KNOT = 0.7
"""Pressure in the knot bead, in Maxwell pressures of its balloon."""
STRUTS_PER_JOINT = 12
"""Least capacity for struts, per joint of the scene."""
SHORT_OF_GAS = 0.98
"""Share of the wanted gas below which inflating counts as failed."""
READ_BACK = (
    "x",
    "stretch",
    "slowness",
    "pressure",
    "volume",
    "amount",
    "ring_middle",
    "wall_load",
    "segment_shift",
    "segment_jammed",
    "suspects",
    "strut_force",
)
"""Arrays that are read back for every frame."""


class LatexModel(Model):
    """Sculptures of hyperelastic rubber and real gas."""

    def __init__(
        self,
        plans: Sequence[Plan],
        meshes: Sequence[Sequence[BalloonMesh]],
        fps: float,
        substeps: int,
        device: str,
        threads: int = 1,
    ) -> None:
        runs = body_ranges([len(m) for m in meshes])
        bodies = [body for plan, m in zip(plans, meshes, strict=True) for body in _bodies(plan, m)]
        worlds = [world for world, run in enumerate(runs) for _ in run]
        physics = plans[0].recipe.physics
        settings = SceneSettings(
            dt=1.0 / (fps * substeps),
            friction=physics.friction,
            fingers=any(isinstance(move, Press) for plan in plans for move in plan.choreography.moves),
            scale_mass=physics.mass_scaling == "selective",
        )
        rings = sum(len(b.rings) for b in bodies)
        struts, slots = _room_for_struts(plans)
        # A tree of so many loose joints has one part more.
        parts = sum(2 * len(plan.loose) for plan in plans)
        self.scene = build_scene(
            bodies, worlds, settings, device, rings, max(struts, STRUTS_PER_JOINT * rings), slots, parts
        )
        self.scene.stretch_limit.assign(stretch_limits(plans, runs))
        self.stepper = Stepper(self.scene, substeps, threads)
        self.hands = LatexControls(self.scene)
        self._struts = Struts(self.scene, StrutLaw.of_friction(physics.friction))
        self._sculptures = [
            LatexSculpture(plan, self.scene, self.hands, self._struts, run.start)
            for plan, run in zip(plans, runs, strict=True)
        ]
        _join_necks(self.scene, self._sculptures)
        self._leak = Leak(plans, self.scene, self.hands, runs)
        self._reached = 0.0
        """End of the latest frame, s."""
        self._inflated: list[int] = []
        """Balloons that had just got their gas when the state was read back."""
        performers = [Performer(sculpture, LATEX_MOTIONS) for sculpture in self._sculptures]
        readback = Readback(self.scene, READ_BACK)
        super().__init__(self.hands, performers, runs, Layout(self.scene, runs), readback)
        self._jams = Jams(plans, self.layout.places, fps)
        self._forces = JointForces(self._sculptures, self._struts)
        self._start_readback()

    @staticmethod
    def usual_substeps(detail: Detail) -> int:
        """Return the substeps of a frame at 24 frames per second: a finer mesh needs more."""
        return detail.substeps

    def leave(self, over: NDArray[np.bool_]) -> None:
        """Leave sculptures alone whose runs have ended or failed, (W,)."""
        super().leave(over)
        self.stepper.leave(over)

    def _start_physics(self, begin: float, end: float, middle: NDArray[np.float32]) -> None:
        self._reached = end
        self._leak.advance(begin, end, self._state)
        self._struts.put(middle)
        self._forces.follow()
        self.hands.upload()
        self.stepper.advance(contact=self.hands.contact, fingers=self.hands.pressing)
        self.hands.arrived()
        self._start_readback()

    def _start_readback(self) -> None:
        """Start reading back the present state, from which frames are made."""
        self.stepper.start_readback(self._readback, contact=self.hands.contact)

    def read_back(self) -> None:
        """Wait for the read-back of the latest state: what follows is of that state, until the next
        read-back.
        """
        super().read_back()
        for bubble in chain.from_iterable(sculpture.open_bubbles for sculpture in self._sculptures):
            # What is open holds no volume, and how rags are stretched as they snap back loads no wall.
            self._state["volume"][bubble.segment] = 0.0
            self._state["stretch"][bubble.vertices] = 1.0
        self._jams.note(self._state["segment_jammed"][self.layout.bubbles])
        self._inflated = [
            b for s in self._sculptures for b, at in s.inflated_at.items() if at == self._reached
        ]

    @property
    def frame_arrays(self) -> FrameArrays:
        """Arrays of the state read back last, of all sculptures; valid for two more read-backs."""
        state, bubbles = self._state, self.layout.bubbles
        pressure, volume, contact, shift = (
            state[name][bubbles] for name in ("pressure", "volume", "wall_load", "segment_shift")
        )
        walls = state["x"], state["stretch"]
        joint_force = self._forces.at_ends(state["strut_force"])
        return FrameArrays(
            *walls, pressure, volume, contact, None, None, shift, state["slowness"], joint_force
        )

    def failures(self) -> dict[int, str]:
        """Return failures that the frames do not show, by sculpture."""
        short = {self.scene.worlds[b]: cause for b in self._inflated if (cause := self._short_of_gas(b))}
        return self._jams.causes() | short

    def _short_of_gas(self, balloon: int) -> str | None:
        """Tell when inflating has ended without the gas that the plan asks for."""
        goal = self.hands.pump_goal[balloon]
        got = float(self._state["amount"][self.scene.bubbles_of(balloon)].sum())
        if got >= SHORT_OF_GAS * goal:
            return None
        return short_of_gas(self._inflating(balloon), got / goal)

    def _inflating(self, balloon: int) -> Inflate:
        """Return the move that blows a balloon up."""
        return next(
            move
            for sculpture in self._sculptures
            for move in sculpture.plan.choreography.moves
            if isinstance(move, Inflate) and sculpture.body[move.balloon] == balloon
        )


def _join_necks(scene: LatexScene, sculptures: Sequence[LatexSculpture]) -> None:
    """Make one neck of joints that are meant to become one: where they meet rubber is folded up."""
    welds = (
        [sculpture.joints[ring] for ring in move.rings]
        for sculpture in sculptures
        for move in sculpture.plan.choreography.moves
        if isinstance(move, Weld)
    )
    # The last is for what lies in no neck.
    meant = np.array([*roots_of(len(scene.joint_first), welds), -1], dtype=np.int32)
    for necks in (scene.vertex_neck, scene.quad_neck):
        necks.assign(meant[necks.numpy()])


def _room_for_struts(plans: Sequence[Plan]) -> tuple[int, int]:
    """Return how many struts some plans have at most, all together and at one joint."""
    struts, slots = 0, STRUT_SLOTS
    for plan in plans:
        pairs = Friction(plan, range(len(plan.table.rings))).most_pairs()
        ends = Counter(chain.from_iterable(pairs))
        struts, slots = struts + len(pairs), max(slots, max(ends.values(), default=0))
    return struts, slots


def short_of_gas(move: Inflate, share: float) -> str:
    """Tell that a pump brought only a share of the gas, and what to write in the recipe."""
    balloon, longer = move.balloon, math.ceil(20.0 * move.seconds) / 10.0
    text = f"the pump brought only {share:.0%} of the gas of {balloon} in {move.seconds:.3g} s"
    return f"{text}: expected a step inflate: {balloon} with seconds: {longer:g}"


def _bodies(plan: Plan, meshes: Sequence[BalloonMesh]) -> list[LatexBody]:
    """Return the balloons of a plan, where they lie at the start."""
    bodies, places, hosts = [], parked(plan.strips), hosts_of(plan.strips)
    numbers = {name: number for number, name in enumerate(plan.strips)}
    for strip, mesh in zip(plan.strips.values(), meshes, strict=True):
        body = _body(plan, strip, mesh)
        body.points[:, 1] += places.get(strip.balloon, 0.0)
        if (host := hosts.get(strip.balloon)) is not None:
            body.points[:, 0] += host.along
            body = replace(body, inside=(numbers[host.balloon], host.bubble))
        bodies.append(body)
    return bodies


def _body(plan: Plan, strip: Strip, mesh: BalloonMesh) -> LatexBody:
    if strip.shape is not None:
        return shape_body(mesh, strip.rubber, strip.size.thickness)
    thinness = strip.size.thickness / strip.size.neck_radius
    pressure = SEALED_KNOT * maxwell_state(strip.rubber).p_star * thinness
    guides = tuple(r.along for r in plan.table.rings if r.balloon == strip.balloon and not r.joint)
    if strip.is_round:
        return round_body(mesh, strip.rubber, strip.size, joint_places(strip), guides, pressure)
    return tube_body(
        mesh,
        strip.rubber,
        strip.size.radius,
        strip.size.thickness,
        joint_places(strip),
        guides,
        pressure,
        strip.balls(),
        tuple(bubble.drawn[1] for bubble in strip.bubbles[:-1]),
        inverted=strip.inverted,
    )
