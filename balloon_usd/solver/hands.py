"""The hands: host arrays that say, frame by frame, what every joint's ring has to do."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.kernels.gas import OPEN_PASSAGE
from balloon_usd.solver.kernels.joints import CLASP_MODE, GRIP_MODE, LEAD_MODE
from balloon_usd.solver.kernels.motion import Spin
from balloon_usd.solver.state import WELD_SLOTS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.solver.scene import Scene

Floats = NDArray[np.float32]

LEAD_FORCE = 6.0
"""Largest force of a hand that leads a bubble, N: a light push."""
LEAD_STIFFNESS = 800.0
"""Stiffness of that hand, N/m, where the time step allows it."""
STEP_STIFFNESS = 0.1
"""Largest stiffness on a ring, in ring masses per squared time step."""


class Hands:
    """What hands do to the joints of a scene; uploaded once a frame."""

    def __init__(self, scene: Scene) -> None:
        joints = len(scene.joint_first)
        self.scene = scene
        self.mode = np.zeros(joints, dtype=np.int32)
        self.start = np.zeros((joints, 3), dtype=np.float32)
        self.goal = np.zeros((joints, 3), dtype=np.float32)
        self.free = np.zeros((joints, 3), dtype=np.float32)
        """Unit direction in which a leading hand does not hold; 0 for none."""
        self.force = np.full(joints, LEAD_FORCE, dtype=np.float32)
        limit = STEP_STIFFNESS * scene.joint_mass.numpy() / scene.settings.dt**2
        self.stiffness = np.minimum(LEAD_STIFFNESS, limit).astype(np.float32)
        closed = [r.closed for b in scene.bodies for r in b.rings]
        neck = [b.neck_radius for b in scene.bodies for _ in b.rings]
        self.neck = np.array(neck or [1.0], dtype=np.float32)
        self.closed = np.array(closed or [False])
        self.radius = np.where(self.closed, self.neck, 0.0).astype(np.float32)
        self.radius_goal = self.radius.copy()
        self.passage = np.where(self.closed, 0.0, OPEN_PASSAGE).astype(np.float32)
        self.passage_goal = self.passage.copy()
        self.pump_flow = np.zeros(len(scene.bodies), dtype=np.float32)
        self.pump_limit = np.ones(len(scene.bodies), dtype=np.float32)
        self.pump_goal = np.zeros(len(scene.bodies))
        self.spins = [Spin() for _ in scene.bodies]
        self.touching = np.zeros(len(scene.bodies), dtype=np.int32)
        """Balloons whose walls may touch something: those that have been folded."""
        self.welds: list[tuple[int, ...]] = []
        self.upload()

    def grip(self, joint: int, middle: Floats) -> None:
        """Take hold of a ring where it is."""
        if self.mode[joint] not in (GRIP_MODE, CLASP_MODE):
            self.mode[joint] = GRIP_MODE
            self.start[joint] = self.goal[joint] = middle[joint]

    def clasp(self, joint: int, middle: Floats) -> None:
        """Take hold of a ring so that, once closed, it does not turn either."""
        self.grip(joint, middle)
        self.mode[joint] = CLASP_MODE

    def lead(self, joint: int, middle: Floats) -> None:
        """Begin to lead a ring from where it is."""
        if self.mode[joint] == 0:
            self.mode[joint] = LEAD_MODE
            self.start[joint] = self.goal[joint] = middle[joint]
            self.free[joint] = 0.0

    def close(self, joint: int, radius: float, passage: float) -> None:
        """Set the radius (m) and the open area (m2) that a neck has at the end of the frame."""
        self.radius_goal[joint] = radius
        self.passage_goal[joint] = passage

    def set_drag(self, balloon: int, rate: float) -> None:
        """Set the air drag of a balloon (1/s)."""
        drag = self.scene.drag.numpy()
        drag[balloon] = rate
        self.scene.drag.assign(drag)

    def set_softening(self, balloon: int, rate: float) -> None:
        """Set which share of a new largest energy the rubber of a balloon takes note of in one substep."""
        rates = self.scene.softening_rate.numpy()
        rates[balloon] = rate
        self.scene.softening_rate.assign(rates)

    def touch(self, balloons: Iterable[int]) -> None:
        """Let the walls of these balloons touch from now on."""
        fresh = [b for b in balloons if not self.touching[b]]
        if fresh:
            self.touching[fresh] = 1
            self.scene.touching.assign(self.touching)

    def give_up(self, balloons: Iterable[int]) -> None:
        """Leave balloons alone whose run has failed."""
        self.touching[list(balloons)] = 0
        self.scene.touching.assign(self.touching)

    def let_go(self, joints: NDArray[np.int64]) -> None:
        """Take the hands from these rings."""
        self.mode[joints] = 0

    def turn(self, balloon: int, joint: int, beyond: float, rate: float) -> None:
        """Spin the part of a balloon farther than `beyond` (m along it) about its own axis in this frame,
        at a rate (rad/s).
        """
        s = self.scene
        span = slice(int(s.vertex_start[balloon]), int(s.vertex_start[balloon + 1]))
        part = s.x.numpy()[span][s.bodies[balloon].along > beyond]
        spin = Spin()
        spin.point = s.ring_middle.numpy()[joint]
        axis = part.mean(axis=0) - spin.point
        spin.axis = axis / max(float(np.linalg.norm(axis)), 1e-12)
        spin.beyond, spin.rate = beyond, rate
        self.spins[balloon] = spin
        s.spin.assign(self.spins)

    def stop_turning(self, balloon: int) -> None:
        """End the spin of a balloon."""
        if self.spins[balloon].rate:
            self.spins[balloon] = Spin()
            self.scene.spin.assign(self.spins)

    def weld(self, joints: tuple[int, ...]) -> None:
        """Hold joints together from now on, with everything already welded to them.

        Raises:
            ValueError: more joints than one weld can hold.
        """
        merged = set(joints)
        for group in [g for g in self.welds if merged & set(g)]:
            merged |= set(group)
            self.welds.remove(group)
        if len(merged) > WELD_SLOTS:
            raise ValueError(f"at most {WELD_SLOTS} joints can be twisted into one, got {len(merged)}")
        self.welds.append(tuple(sorted(merged)))
        self._upload_welds()

    def split_gas(self, joint: int) -> None:
        """Share the gas of the open chambers by volume, before a neck between them begins to close."""
        s = self.scene
        balloon = int(np.searchsorted(s.joint_start, joint, side="right")) - 1
        amount, volume, ends = s.amount.numpy(), s.volume.numpy().astype(float), s.end_joint.numpy()
        begin = int(s.segment_start[balloon])
        for k in range(begin, int(s.segment_start[balloon + 1])):
            border = ends[k]
            if border < 0 or self.passage[border] < OPEN_PASSAGE:
                run = slice(begin, k + 1)
                amount[run] = amount[run].sum() * volume[run] / volume[run].sum()
                begin = k + 1
        s.amount.assign(amount)

    def upload(self) -> None:
        """Send the goals of the coming frame to the device; its starts are where the last frame ended."""
        s = self.scene
        for name, values in (
            ("hand", self.mode),
            ("hand_from", self.start),
            ("hand_to", self.goal),
            ("hand_free", self.free),
            ("hand_force", self.force),
            ("hand_stiffness", self.stiffness),
            ("radius_from", self.radius),
            ("radius_to", self.radius_goal),
            ("open_from", self.passage),
            ("open_to", self.passage_goal),
            ("pump_flow", self.pump_flow),
            ("pump_limit", self.pump_limit),
            ("pump_goal", self.pump_goal),
        ):
            s.arrays[name].assign(values)

    def arrived(self) -> None:
        """Make this frame's goals the next frame's starts."""
        self.start[:] = self.goal
        self.radius[:] = self.radius_goal
        self.passage[:] = self.passage_goal

    def _upload_welds(self) -> None:
        s = self.scene
        rows = len(s.weld_size)
        if len(self.welds) > rows:
            raise ValueError(f"{len(self.welds)} welds but room for {rows}")
        joint = np.zeros((rows, WELD_SLOTS), dtype=np.int32)
        size = np.zeros(rows, dtype=np.int32)
        reach, gap = np.zeros(rows, dtype=np.float32), np.zeros(rows, dtype=np.float32)
        for k, group in enumerate(self.welds):
            joint[k, : len(group)] = group
            size[k] = len(group)
            neck = float(self.neck[list(group)].mean())
            gap[k], reach[k] = 2.0 * neck, 2.0 * neck / np.sin(np.pi / max(len(group), 2))
        for name, values in (
            ("weld_joint", joint),
            ("weld_size", size),
            ("weld_reach", reach),
            ("weld_gap", gap),
        ):
            s.arrays[name].assign(values)
