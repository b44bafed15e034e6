"""Hands of the latex model: besides rings they mind the pump, the open necks and the spin of a twist."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.solver.hands import Floats, Hands
from balloon_usd.solver.kernels.gas import OPEN_PASSAGE
from balloon_usd.solver.kernels.motion import Spin

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene


class LatexHands(Hands):
    """What hands do to balloons of the latex model; uploaded once a frame."""

    scene: LatexScene

    def __init__(self, scene: LatexScene) -> None:
        super().__init__(scene)
        self.passage = np.where(self.closed, 0.0, OPEN_PASSAGE).astype(np.float32)
        self.passage_goal = self.passage.copy()
        self.pump_flow = np.zeros(len(scene.bodies), dtype=np.float32)
        self.pump_limit = np.ones(len(scene.bodies), dtype=np.float32)
        self.pump_goal = np.zeros(len(scene.bodies))
        self.spins = [Spin() for _ in scene.bodies]
        self._spun = False
        """Whether a spin has changed since the last upload."""
        self.upload()

    def squeeze(self, joint: int, radius: float, passage: float) -> None:
        """Set the radius (m) and the open area (m2) that a neck has at the end of the frame."""
        self.close(joint, radius)
        self.passage_goal[joint] = passage

    def set_softening(self, balloon: int, rate: float) -> None:
        """Set which share of a new largest energy the rubber of a balloon takes note of in one substep."""
        rates = self.scene.softening_rate.numpy()
        rates[balloon] = rate
        self.scene.softening_rate.assign(rates)

    def turn(self, balloon: int, point: Floats, beyond: float, rate: float) -> None:
        """Spin the part of a balloon farther than `beyond` (m along it) about its own axis through a point
        (3,), m, in this frame, at a rate (rad/s).
        """
        s = self.scene
        span = slice(int(s.vertex_start[balloon]), int(s.vertex_start[balloon + 1]))
        part = self.places[span][s.bodies[balloon].along > beyond]
        spin = Spin()
        spin.point = wp.vec3(*point)
        axis = part.mean(axis=0) - point
        spin.axis = axis / max(float(np.linalg.norm(axis)), 1e-12)
        spin.beyond, spin.rate = beyond, rate
        self.spins[balloon] = spin
        self._spun = True

    def stop_turning(self, balloon: int) -> None:
        """End the spin of a balloon."""
        if self.spins[balloon].rate:
            self.spins[balloon] = Spin()
            self._spun = True

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
        """Send the goals of the coming frame to the device."""
        super().upload()
        if self._spun:
            self.scene.spin.assign(self.spins)
            self._spun = False
        for name, values in (
            ("open_from", self.passage),
            ("open_to", self.passage_goal),
            ("pump_flow", self.pump_flow),
            ("pump_limit", self.pump_limit),
            ("pump_goal", self.pump_goal),
        ):
            self._send(name, values)

    def arrived(self) -> None:
        """Make this frame's goals the next frame's starts."""
        super().arrived()
        self.passage[:] = self.passage_goal
