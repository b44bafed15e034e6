"""What becomes of every joint from the let-go on: whether it holds, until when, and how far it gives way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from balloon_usd.plan.holding import friction_margin, pose_force
from balloon_usd.quality.bubbles import vertices_of_bubbles
from balloon_usd.quality.joints import joints_of, made_joints, together
from balloon_usd.quality.ring_corners import RingCorners

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.quality.bubbles import Vertices
    from balloon_usd.quality.joints import PlannedJoint
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

BETWEEN_LOOKS = 0.5
"""Time between two frames in which joints are looked at, s."""
SLIP_DIGITS, TURN_DIGITS, MARGIN_DIGITS, FORCE_DIGITS = 5, 2, 2, 3
"""Digits after the point of what is told: m, degrees, times the friction that is needed, and N."""


class JointHistory:
    """Takes the frames of one sculpture, and looks at its joints twice a second from the let-go on."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out what to look at, and when; one mesh a balloon, in the order of `Plan.strips`."""
        self._plan, self._fps = plan, plan.recipe.fps
        meant = {joint.name for joint in joints_of(plan) if joint.holds}
        bubbles = vertices_of_bubbles(plan, meshes)
        self._joints = [
            _WatchedJoint(plan, meshes, joint, bubbles, meant=joint.name in meant)
            for joint in made_joints(plan)
            if len(joint.ends) > 1
        ]
        # The time of a frame is (code - 1) / fps.
        self._let_go = min(1 + round(plan.choreography.let_go * self._fps), plan.frame_count)
        self._last = plan.rested_frame
        self._every = max(round(BETWEEN_LOOKS * self._fps), 1)

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        after = frame.time_code - self._let_go
        if after < 0 or frame.time_code > self._last:
            return
        if after % self._every == 0 or frame.time_code == self._last:
            for joint in self._joints:
                joint.look(frame)

    def each(self, told: Callable[[Iterable[str]], int | None]) -> list[dict[str, Any]]:
        """Return what has become of every joint as plain data, once the last frame is taken.

        `told`: gives the time code since which the simulation told a joint to be undone, by its ends.
        """
        return [joint.data(self._fps, told) for joint in self._joints]


class _Way(NamedTuple):
    """How a joint lies: what no motion of the whole figure changes."""

    apart: Floats
    """Distances of its necks from each other, (N, N), m."""
    cosines: Floats
    """Of the angles between the directions in which its bubbles lie, (E, E)."""


class _WatchedJoint:
    """One joint of a figure."""

    def __init__(
        self,
        plan: Plan,
        meshes: Sequence[BalloonMesh],
        joint: PlannedJoint,
        bubbles: Mapping[str, Vertices],
        *,
        meant: bool,
    ) -> None:
        self._plan, self._meshes, self._joint, self._meant = plan, meshes, joint, meant
        self._necks = [RingCorners.of(plan, meshes, ring) for ring in joint.rings]
        self._bubbles = [bubbles[end.bubble] for end in joint.ends]
        self._margin = friction_margin(plan.recipe, joint.ends)
        number = {bubble.name: k for k, bubble in enumerate(plan.bubbles)}
        self._ends = [(number[end.bubble], 0 if end.end == "start" else 1) for end in joint.ends]
        """Its ends, as numbers of bubbles and sides."""
        self._first: _Way | None = None
        self._slip = self._turn = self._force = 0.0
        self._apart: int | None = None
        """First time code at which its necks were open or apart."""

    def look(self, frame: Frame) -> None:
        """Measure how far it has given way since it was looked at first."""
        if self._apart is None and not together(self._plan, self._meshes, frame, self._joint):
            self._apart = frame.time_code
        way = self._way(frame)
        if self._first is None:
            self._first = way
        self._slip = max(self._slip, float(np.abs(way.apart - self._first.apart).max()))
        angles = np.arccos(way.cosines) - np.arccos(self._first.cosines)
        self._turn = max(self._turn, float(np.degrees(np.abs(angles).max())))
        if (force := frame.joint_force) is not None:
            self._force = max(self._force, *(float(force[end]) for end in self._ends))

    def _way(self, frame: Frame) -> _Way:
        necks = np.array([neck.places(frame).mean(axis=0) for neck in self._necks])
        arms = np.array([frame.points[b][at].mean(axis=0, dtype=float) for b, at in self._bubbles])
        arms -= necks.mean(axis=0)
        arms /= np.maximum(np.linalg.norm(arms, axis=1), 1e-9)[:, None]
        apart = np.linalg.norm(necks[:, None] - necks[None], axis=2)
        return _Way(apart, np.clip(arms @ arms.T, -1.0, 1.0))

    def data(self, fps: float, told: Callable[[Iterable[str]], int | None]) -> dict[str, Any]:
        """Return what has become of it as plain data; `told`: as of `JointHistory.each`."""
        ends = [str(end) for end in self._joint.ends]
        undone = min((code for code in (told(ends), self._apart) if code is not None), default=None)
        return {
            "joint": self._joint.name,
            "ends": ends,
            "meant": self._meant,
            **self._friction(),
            "held": undone is None,
            "undone_at": None if undone is None else round((undone - 1) / fps, 3),
            "slip": round(self._slip, SLIP_DIGITS),
            "turn": round(self._turn, TURN_DIGITS),
        }

    def _friction(self) -> dict[str, float | None]:
        """Return what friction does for it; null where no neck is wound about others."""
        if self._margin is None:
            return {"margin": None, "force": None, "bears": None}
        return {
            "margin": round(self._margin, MARGIN_DIGITS),
            "force": round(self._force, FORCE_DIGITS),
            "bears": round(pose_force(self._plan.recipe.physics.friction), FORCE_DIGITS),
        }
