"""A figure that falls: weight, buoyancy, drag by area, and the ground, which pushes and rubs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.air import OUTSIDE_DENSITY
from balloon_usd.solver.rotations import cross, rotation

if TYPE_CHECKING:
    from balloon_usd.solver.rigid_figure import RigidFigure

Floats = NDArray[np.float64]

BLOCK = 5.0e-3
"""Longest time for which drag and the list of vertices near the ground are kept, s; a step in the air."""
SHORTEST = 2.5e-4
"""Shortest time for which they are kept, s."""
SLOWED = 0.02
"""Share of the speed that drag takes meanwhile, at most."""
ANGLE = 0.8
"""Angle by which the quickest swing on the ground goes on in a time step, rad: at 2 it would grow."""
FEET = 4
"""Vertices that touch the ground from which on each is pushed less: a figure that lies is no stiffer."""
DRAG = 1.1
"""Drag coefficient of a wall that faces the wind: of a cylinder across it, at Reynolds numbers from 1e3 to
1e5 (Hoerner 1965, Fluid-Dynamic Drag, 3-9). A ball has half of it.
"""
BOUNCE = 0.16
"""Damping of the ground's push, in that which lets nothing bounce: six tenths of the speed come back
(judged).
"""
RUBBING = 0.5
"""Stiffness of a bristle that rubs on the ground, in that of the ground's push."""
ROLLING = 3.0e-4
"""Arm of the ground's push against rolling, m: a fifth of the radius on which a foot is flat (judged)."""
SLOW_ROLL = 0.05
"""Spin from which on rolling is braked in full, rad/s."""
NEAR = 0.02
"""Height below which a vertex may touch the ground before vertices are looked at again, m."""
SETTLING = 0.01
"""Time between two looks of hands that let a figure settle, s."""
CALMED = 0.9
"""Speed that they leave it."""
STILL = 1.0e-5
"""Speed below which it rests, m/s."""
CALM, CALM_SECONDS = 1.0e-3, 0.5
"""Speed (m/s) and time (s) of a figure that hardly moves, and so does not move on."""
MOST_SETTLING = 400
"""Looks after which they let it go anyway."""
DOWN = np.array([0.0, 0.0, -1.0])
STEADY = np.zeros(3)


class FallingFigure:
    """The motion of a rigid figure; times in s, places in m."""

    def __init__(
        self,
        figure: RigidFigure,
        gravity: float,
        friction: float,
        velocity: Floats = STEADY,
        spin: Floats = STEADY,
        *,
        ground: bool,
    ) -> None:
        """Let go of a figure where it is.

        `gravity`: m/s2; `friction`: on the ground, the plane z = 0, if there is any; `velocity`, `spin`: with
        which it is thrown, (3,), m/s and rad/s.
        """
        self.figure = figure
        self.centre = figure.centre.copy()
        """Where its centre of inertia is, (3,), m."""
        self.turn = np.eye(3)
        """How it is turned, (3, 3)."""
        self.velocity = velocity.astype(float)
        """Of its centre, (3,), m/s."""
        self.spin = spin.astype(float)
        """Angular velocity, (3,), rad/s."""
        self.push = 0.0
        """Upward force of the ground, in the mean of the time advanced last, N."""
        self.sleeps = False
        """Whether it lies still on the ground."""
        self._calm = 0.0
        """For how long it has hardly moved, s."""
        self.weight = figure.heavy * gravity
        """What it weighs in air, N."""
        self._friction, self._ground = friction, ground
        self._anchors = np.full((len(figure.points), 2), np.nan)
        """Where the bristle of every vertex that touches is rooted in the ground, (V, 2), m."""
        self._inverse = np.linalg.inv(figure.tensor)
        self._step_seconds = ANGLE / quickest(figure)
        """Longest time step on the ground, s."""
        self._damping = 2.0 * BOUNCE * np.sqrt(figure.firmness * figure.inertial)

    def moved(self, turn: Floats, shift: Floats) -> tuple[Floats, Floats]:
        """Return a turn (3, 3) and a shift (3,), m, that had brought it where it was let go, and what has
        become of them.
        """
        return self.turn @ turn, self.centre + self.turn @ (shift - self.figure.centre)

    def settle(self) -> None:
        """Let it go gently, with hands that take its swing, until it rests."""
        for _ in range(MOST_SETTLING):
            # What tips past its feet begins slowly, and slower still in hands that take its swing.
            self._calm = 0.0
            self.advance(SETTLING)
            if self.sleeps:
                break
            self.velocity *= CALMED
            self.spin *= CALMED

    def advance(self, seconds: float) -> None:
        """Let it fall for some time; it sleeps once it rests on the ground, and is not computed any more."""
        if self.sleeps:
            return
        pushed, left = 0.0, seconds
        while left > 0.0:
            drag, torque = self._drag()
            near = self._near()
            slowing = float(np.linalg.norm(drag)) / self.figure.inertial
            block = min(BLOCK, SLOWED * float(np.linalg.norm(self.velocity)) / max(slowing, 1.0e-9), left)
            # In full blocks, the last of which is not much shorter.
            block = left / max(math.ceil(left / max(block, SHORTEST) - 1.0e-9), 1)
            steps = math.ceil(block / self._step_seconds) if len(near) else 1
            for _ in range(steps):
                pushed += self._step(block / steps, drag, torque, near) * block / steps
            left -= block
        self.push = pushed / seconds
        self._fall_asleep(seconds)

    def _fall_asleep(self, seconds: float) -> None:
        """Let it sleep if it rests on the ground, or has hardly moved for a while."""
        speed = max(float(np.linalg.norm(self.velocity)), NEAR * float(np.linalg.norm(self.spin)))
        self._calm = self._calm + seconds if self.push > 0.0 and speed < CALM else 0.0
        self.sleeps = self.push > 0.0 and (speed < STILL or self._calm > CALM_SECONDS)

    def _step(self, dt: float, drag: Floats, torque: Floats, near: NDArray[np.int64]) -> float:
        """Advance by one time step, by symplectic Euler, and return the push of the ground, N."""
        figure, turn = self.figure, self.turn
        push, twist = self._touch(near)
        force = drag + self.weight * DOWN + push
        # Euler's equation of rotation, in the frame of the figure.
        spin = self.spin @ turn
        torque = (torque + twist) @ turn + cross(figure.heavy_arm) @ (self.weight * DOWN @ turn)
        torque -= cross(spin) @ (figure.tensor @ spin)
        gained = dt / figure.inertial * force
        self.velocity = self.velocity + gained
        self.spin = turn @ (spin + dt * self._inverse @ torque)
        # In the air, where steps are long, by the mean of both speeds.
        self.centre = self.centre + dt * (self.velocity if len(near) else self.velocity - 0.5 * gained)
        self.turn = rotation(dt * self.spin) @ turn
        return float(push[2])

    def _drag(self) -> tuple[Floats, Floats]:
        """Return the drag of the air (N) and its torque (N m): of every wall that faces the wind."""
        arms, areas = self.figure.panels @ self.turn.T, self.figure.areas @ self.turn.T
        going = self.velocity + arms @ cross(self.spin).T
        facing = np.maximum((areas * going).sum(axis=1), 0.0)
        force = -0.5 * OUTSIDE_DENSITY * DRAG * facing[:, None] * going
        return force.sum(axis=0), _torque(arms, force)

    def _near(self) -> NDArray[np.int64]:
        """Return the vertices that may touch the ground soon; the bristles of all others are gone."""
        if not self._ground:
            return np.empty(0, dtype=np.int64)
        height = self.figure.points @ self.turn[2] + self.centre[2]
        near = np.flatnonzero(height < NEAR)
        gone = height > 0.0
        self._anchors[gone] = np.nan
        return near

    def _touch(self, near: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """Return the force of the ground (N) and its torque (N m): a push with damping, and Coulomb friction
        by bristles.
        """
        arms = self.figure.points[near] @ self.turn.T
        height = arms[:, 2] + self.centre[2]
        touching = height < 0.0
        if not touching.any():
            self._anchors[near] = np.nan
            return np.zeros(3), np.zeros(3)
        self._anchors[near[~touching]] = np.nan
        at, arms, depth = near[touching], arms[touching], -height[touching]
        going = self.velocity + arms @ cross(self.spin).T
        share = min(1.0, FEET / len(at))
        stiff, damping = share * self.figure.firmness[at], share * self._damping[at]
        force = np.zeros_like(arms)
        force[:, 2] = np.maximum(stiff * depth - damping * going[:, 2], 0.0)
        where = arms[:, :2] + self.centre[:2]
        force[:, :2] = self._rub(at, where, going[:, :2], RUBBING * stiff, RUBBING * damping, force[:, 2])
        total = force.sum(axis=0)
        braked = ROLLING * total[2] / max(float(np.linalg.norm(self.spin)), SLOW_ROLL)
        return total, _torque(arms, force) - braked * self.spin

    def _rub(
        self,
        at: NDArray[np.int64],
        where: Floats,
        going: Floats,
        stiff: Floats,
        damping: Floats,
        push: Floats,
    ) -> Floats:
        """Return the friction on vertices that touch, (N, 2), N; where they slide their bristles are drawn
        along.
        """
        anchors = np.where(np.isnan(self._anchors[at]), where, self._anchors[at])
        damped = damping[:, None] * going
        force = -stiff[:, None] * (where - anchors) - damped
        most, size = self._friction * push, np.linalg.norm(force, axis=1)
        force *= np.minimum(most / np.maximum(size, 1.0e-12), 1.0)[:, None]
        rooted = where + (force + damped) / stiff[:, None]
        self._anchors[at] = np.where((size > most)[:, None], rooted, anchors)
        return force


def quickest(figure: RigidFigure) -> float:
    """Return the rate of the quickest swing of a figure on the ground, rad/s: on the vertex that is firmest
    for the mass that has to be moved there.
    """
    inverse = np.linalg.inv(figure.tensor)
    arms = np.array([cross(point) for point in figure.points])
    # What a unit force at a vertex, in any direction, accelerates it by.
    yielding = np.eye(3) / figure.inertial - arms @ inverse @ arms
    rates = FEET * figure.firmness * np.linalg.eigvalsh(yielding)[:, -1]
    return math.sqrt(float(rates.max()))


def _torque(arms: Floats, force: Floats) -> Floats:
    """Return the sum of the torques (3,) of forces (N, 3) at the ends of arms (N, 3)."""
    moment = arms.T @ force
    return np.array([moment[1, 2] - moment[2, 1], moment[2, 0] - moment[0, 2], moment[0, 1] - moment[1, 0]])
