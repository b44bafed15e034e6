"""Controls of the latex model: hands, pump, passages of necks, spins and softening."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.solver.hands import LEAD_FORCE, Floats, Hands
from balloon_usd.solver.kernels.physics.gas import OPEN_PASSAGE, WIDE_OPEN
from balloon_usd.solver.latex.spins import Spins

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.spins import VertexSet

PULL = 1.4
"""Largest force of a hand that pulls a bubble out between its ends, in forces of its gas on the end."""
SOFTENING_SECONDS = 0.1
"""Time in which stretched rubber softens, s: longer than the waves that hands send through a heavy mesh."""
Points = NDArray[np.float32] | NDArray[np.float64]


class LatexControls(Hands):
    """Hands, pump, passages, spins and softening of a scene; uploaded once a frame."""

    scene: LatexScene

    def __init__(self, scene: LatexScene) -> None:
        super().__init__(scene)
        self.passage = np.where(self.closed, 0.0, OPEN_PASSAGE).astype(np.float32)
        self.passage_goal = self.passage.copy()
        self.neck_closed = self.closed.astype(np.float32)
        """How far every joint is closed, and so hides the rubber of its neck, 0 to 1."""
        self.neck_wound = np.zeros(len(self.passage), dtype=np.float32)
        """How much of what the turns of every joint draw in is drawn in, 1 of a finished one."""
        self.neck_flow = np.zeros(len(self.passage), dtype=np.float32)
        """Gas that hands push through a neck in the coming frame, from before to behind it, mol/s."""
        self._pushing = False
        """Whether they push any."""
        self.beside = scene.joint_beside.numpy()
        """Segments before and after every ring, (J, 2)."""
        self._joint_body = np.repeat(np.arange(len(scene.bodies)), np.diff(scene.joint_start))
        """Balloon of every ring, (J,)."""
        self._ends = scene.end_joint.numpy()
        """Joint that ends every segment, (S,); -1 at the tip of a balloon."""
        self._edges = scene.flow_from.numpy().copy(), scene.flow_to.numpy().copy()
        """Segments that the edges along which gas flows lead from and to."""
        self.pump_flow = np.zeros(len(scene.bodies), dtype=np.float32)
        self.pump_limit = np.ones(len(scene.bodies), dtype=np.float32)
        self.pump_goal = np.zeros(len(scene.bodies))
        self.packed_drag = np.zeros(len(scene.bodies), dtype=np.float32)
        """Drag on the rubber of every balloon that is folded up in a neck, besides, 1/s."""
        self.gravity = scene.gravity.numpy().copy()
        """Pull of gravity on every balloon, (B, 3), m/s2."""
        self.spins = Spins(scene)
        self.softening = scene.softening_rate.numpy().copy()
        """Share of a new largest energy that the rubber of every balloon takes note of in a substep, (B,)."""
        self.amount, self.volume = scene.amount.numpy().copy(), scene.volume.numpy().copy()
        """Gas of every segment, mol, and its volume, m3."""
        self.pressure = scene.pressure.numpy().copy()
        """Gauge pressure of every segment, Pa."""
        self._passages = b"", b"", b""
        """How wide all necks are at both ends of the frame and what is pushed through, as last looked at."""
        self._necks: dict[str, NDArray[Any]] = {}
        """Arrays that follow from that."""
        self.upload()

    def _rarely_changed(self) -> tuple[str, ...]:
        return (*super()._rarely_changed(), "amount", "pressure", "vertex_spin")

    def begin_frame(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take over the state read back last, lift all fingers and stop all spins."""
        super().begin_frame(state)
        self.spins.stop()
        if self._pushing:
            self.neck_flow[:] = 0.0
            self._pushing = False
        self.amount, self.volume = state["amount"].copy(), state["volume"]
        self.pressure = state["pressure"]

    def pull(self, joint: int) -> None:
        """Pull a ring with a firm grip instead of leading it, until it is let go."""
        body = self.scene.bodies[self._joint_body[joint]]
        state = maxwell_state(body.rubber)
        pressure = state.p_star * float(np.median(body.thickness)) / body.radius
        self.force[joint] = PULL * pressure * np.pi * (state.bulged.a * body.radius) ** 2

    def let_go(self, joints: NDArray[np.int64]) -> None:
        """Take the hands from these rings."""
        super().let_go(joints)
        self.force[joints] = LEAD_FORCE

    def squeeze(self, joint: int, radius: float, passage: float) -> None:
        """Set the radius (m) and the open area (m2) that a neck has at the end of the frame."""
        self.close(joint, radius)
        self.passage_goal[joint] = passage

    def hide_rubber(self, joint: int, closed: float) -> None:
        """Let a neck hide its rubber from the bubbles beside it, as far as it is closed, 0 to 1."""
        self.neck_closed[joint] = closed

    def draw_rubber(self, joint: int, wound: float) -> None:
        """Let the turns of a neck draw a share of what they draw in all out of the bubbles beside it."""
        self.neck_wound[joint] = wound

    @property
    def rest_length(self) -> Floats:
        """Length at rest of every segment, as a share of that between finished necks, (S,)."""
        return self.scene.hidden_rubber.rest_length(self.neck_closed, self.neck_wound)

    def push_gas(self, joint: int, flow: float) -> None:
        """Push gas (mol/s) through a neck in the coming frame, from the chamber before it to that behind."""
        self.neck_flow[joint] = flow
        self._pushing = True

    def free_neck(self, joint: int) -> None:
        """Let a neck go that is as wide as its tube: the chambers beside it become one."""
        self.radius[joint] = self.radius_goal[joint] = 0.0
        self.passage[joint] = self.passage_goal[joint] = OPEN_PASSAGE
        self.neck_closed[joint] = self.neck_wound[joint] = 0.0

    def keep_from_softening(self, balloon: int) -> None:
        """Let a balloon's rubber not soften where it is stretched anew: gas that is pushed on has to move a
        mesh of artificial inertia, and stretches what is behind.
        """
        self.softening[balloon] = 0.0

    def let_soften(self, balloon: int) -> None:
        """Let a balloon's rubber soften where it is stretched anew."""
        self.softening[balloon] = self.scene.settings.dt / SOFTENING_SECONDS

    def turn(self, vertices: VertexSet, point: Floats, middle_of: VertexSet, rate: float) -> None:
        """Turn some vertices in this frame, at a rate (rad/s), about the axis from a point (3,), m, to the
        middle of others. Not at all where the rate is 0: velocities keep their last digit.
        """
        if rate == 0.0:
            return
        axis = _middle(self.places[middle_of.indices]) - point
        axis /= max(float(np.sqrt(axis.dot(axis))), 1e-12)
        self.spin(vertices, point, axis, rate)

    def spin(self, vertices: VertexSet, point: Points, axis: Points, rate: float) -> None:
        """Turn some vertices in this frame about a unit axis through a point, (3,), m, at a rate (rad/s)."""
        if rate != 0.0:
            self.spins.turn(vertices, {"point": point, "axis": axis, "rate": rate})

    def split_gas(self, joint: int) -> None:
        """Share the gas of the open chambers by volume, before a neck between them begins to close."""
        first, last = self.chambers()
        beside = self.beside[joint, 0]
        run = slice(first[beside], last[beside] + 1)
        volume = self.volume[run].astype(float)
        self.amount[run] = self.amount[run].sum() * volume / volume.sum()
        self._due["amount"] = self.amount

    def amount_before(self, joint: int) -> float:
        """Return the gas (mol) of the chamber before a joint."""
        first, last = self.chambers()
        beside = self.beside[joint, 0]
        return float(self.amount[first[beside] : last[beside] + 1].sum())

    def lose_gas(self, bubbles: NDArray[np.int64], lost: NDArray[np.float64]) -> None:
        """Take gas out of some segments, both (bubbles,), mol."""
        self.amount[bubbles] -= lost
        self._due["amount"] = self.amount

    def vent(self, segment: int, pressure: float) -> None:
        """Open a segment to the room: it has no gas of its own any more, and this gauge pressure, Pa."""
        self.amount[segment] = 0.0
        self.pressure = self.pressure.copy()
        self.pressure[segment] = pressure
        self._due |= {"amount": self.amount, "pressure": self.pressure}

    def chambers(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the first and the last segment of the chamber that every segment lies in, (S,) each."""
        shut = np.flatnonzero((self._ends < 0) | (self.passage[self._ends] < WIDE_OPEN))
        chamber = np.searchsorted(shut, np.arange(len(self._ends)))
        return np.concatenate([[0], shut + 1])[chamber], shut[chamber]

    def _blowing(self) -> NDArray[np.int32]:
        """Return 1 for every balloon with a neck that is neither open nor shut or pushed through, (B,)."""
        blowing = np.zeros(len(self.scene.bodies), dtype=np.int32)
        necks = (self.passage < WIDE_OPEN) & (np.maximum(self.passage, self.passage_goal) > 0.0)
        necks |= self.neck_flow != 0.0
        blowing[self._joint_body[necks[: len(self._joint_body)]]] = 1
        return blowing

    def _flows(self, last: NDArray[np.int64]) -> dict[str, NDArray[Any]]:
        """Return the chambers that edges lead from and to, and the edges at every chamber in order, given the
        last segment of the chamber that every segment lies in, (S,).
        """
        source, sink = (last[segments] for segments in self._edges)
        between = np.flatnonzero(source != sink)
        # What comes into a chamber and what leaves it, in the order of the edges.
        chamber = np.stack([sink[between], source[between]], axis=1).reshape(-1)
        edge = np.stack([between + 1, -between - 1], axis=1).reshape(-1)
        order = np.argsort(chamber, kind="stable")
        ends = np.zeros(2 * len(source), dtype=np.int32)
        ends[: len(edge)] = edge[order]
        start = np.searchsorted(chamber[order], np.arange(len(last) + 1))
        return {"flow_from": source, "flow_to": sink, "chamber_end": start, "flow_ends": ends}

    def _goals(self) -> dict[str, NDArray[Any]]:
        passages = self.passage.tobytes(), self.passage_goal.tobytes(), self.neck_flow.tobytes()
        if passages != self._passages:
            self._passages = passages
            first, last = self.chambers()
            self._necks = {"blowing": self._blowing(), "chamber_first": first, "chamber_last": last}
            self._necks |= self._flows(last)
        return (
            super()._goals()
            | self._necks
            | {
                "open_from": self.passage,
                "open_to": self.passage_goal,
                "neck_flow": self.neck_flow,
                "rest_length": self.rest_length,
                "pump_flow": self.pump_flow,
                "pump_limit": self.pump_limit,
                "pump_goal": self.pump_goal,
                "softening_rate": self.softening,
                "spins": self.spins.rows,
                "packed_drag": self.packed_drag,
                "gravity": self.gravity,
            }
        )

    def upload(self) -> None:
        """Send the goals of the coming frame to the device; its starts are where the last frame ended.

        Raises:
            ValueError: more welds or spins than the capacity.
        """
        if self.spins.settle():
            self._due["vertex_spin"] = self.spins.of_vertex
        super().upload()

    def arrived(self) -> None:
        """Make this frame's goals the next frame's starts."""
        super().arrived()
        self.passage[:] = self.passage_goal


def _middle(points: Floats) -> Floats:
    """Return the mean of points (N, 3), added up one by one: as `mean` does, in half the time."""
    total: Floats = np.add.accumulate(points.T, axis=1)[:, -1]
    return total / np.float32(len(points))
