"""The hands: host arrays that say, frame by frame, what every joint's ring has to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.kernels.fingers import Finger
from balloon_usd.solver.kernels.joints import CLASP_MODE, GRIP_MODE, LEAD_MODE
from balloon_usd.solver.scene import WELD_SLOTS

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

    def __init__(self, scene: Scene, *, lead_stiffness: float = LEAD_STIFFNESS) -> None:
        """Take hold of nothing yet; `lead_stiffness`: of a hand that leads, where the time step allows it
        (N/m).
        """
        joints = len(scene.joint_first)
        self.scene = scene
        self.mode = np.zeros(joints, dtype=np.int32)
        self.start = np.zeros((joints, 3), dtype=np.float32)
        self.goal = np.zeros((joints, 3), dtype=np.float32)
        self.free = np.zeros((joints, 3), dtype=np.float32)
        """Unit direction in which a leading hand does not hold; 0 for none."""
        self.force = np.full(joints, LEAD_FORCE, dtype=np.float32)
        limit = STEP_STIFFNESS * scene.joint_mass.numpy() / scene.settings.dt**2
        self.stiffness = np.minimum(lead_stiffness, limit).astype(np.float32)
        closed = [r.closed for b in scene.bodies for r in b.rings]
        neck = [b.neck_radius for b in scene.bodies for _ in b.rings]
        self.neck = np.array(neck or [1.0], dtype=np.float32)
        self.closed = np.array(closed or [False])
        self.radius = np.where(self.closed, self.neck, 0.0).astype(np.float32)
        self.radius_goal = self.radius.copy()
        self.touching = np.zeros(len(scene.bodies), dtype=np.int32)
        """Balloons whose walls may touch something: those that have been folded."""
        self.fingers = [Finger() for _ in scene.bodies]
        self.finger_share = np.zeros(len(scene.x), dtype=np.float32)
        """Share of a finger's force that every vertex takes."""
        self.pressing = False
        """Whether any finger is on a wall."""
        self.places = scene.x.numpy()
        """Where all vertices are, (V, 3), m, as last looked at."""
        self._sent: dict[str, NDArray[Any]] = {}
        self._welded = False
        """Whether joints were welded since the last upload."""
        self.welds: list[tuple[int, ...]] = []

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

    def close(self, joint: int, radius: float) -> None:
        """Set the radius (m) that a neck has at the end of the frame."""
        self.radius_goal[joint] = radius

    def set_drag(self, balloon: int, rate: float) -> None:
        """Set the air drag of a balloon (1/s)."""
        drag = self.scene.drag.numpy()
        drag[balloon] = rate
        self.scene.drag.assign(drag)

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

    def set_finger(self, balloon: int, finger: Finger, share: Floats) -> None:
        """Put a finger on a balloon for the coming frame.

        `share`: of its force on every vertex of that balloon, (V,), adding up to 1.
        """
        s = self.scene
        self.finger_share[s.vertex_start[balloon] : s.vertex_start[balloon + 1]] = share
        self.fingers[balloon] = finger
        self.pressing = True
        s.fingers.assign(self.fingers)
        s.finger_share.assign(self.finger_share)

    def lift_fingers(self) -> None:
        """Take all fingers from the walls."""
        self.pressing = False
        self.finger_share[:] = 0.0

    def let_go(self, joints: NDArray[np.int64]) -> None:
        """Take the hands from these rings."""
        self.mode[joints] = 0

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
        self._welded = True

    def upload(self) -> None:
        """Send the goals of the coming frame to the device; its starts are where the last frame ended.

        Raises:
            ValueError: more welds than there is room for.
        """
        if self._welded:
            self._upload_welds()
            self._welded = False
        for name, values in (
            ("hand", self.mode),
            ("hand_from", self.start),
            ("hand_to", self.goal),
            ("hand_free", self.free),
            ("hand_force", self.force),
            ("hand_stiffness", self.stiffness),
            ("radius_from", self.radius),
            ("radius_to", self.radius_goal),
        ):
            self._send(name, values)

    def _send(self, name: str, values: NDArray[Any]) -> None:
        """Send an array to the device if it has changed."""
        if name not in self._sent or not np.array_equal(self._sent[name], values):
            self._sent[name] = values.copy()
            self.scene.arrays[name].assign(values)

    def arrived(self) -> None:
        """Make this frame's goals the next frame's starts."""
        self.start[:] = self.goal
        self.radius[:] = self.radius_goal

    def _upload_welds(self) -> None:
        s = self.scene
        rows = len(s.weld_size)
        if len(self.welds) > rows:
            raise ValueError(f"{len(self.welds)} welds but room for {rows}")
        joint = np.zeros((rows, WELD_SLOTS), dtype=np.int32)
        size = np.zeros(rows, dtype=np.int32)
        reach, gap = np.zeros(rows, dtype=np.float32), np.zeros(rows, dtype=np.float32)
        of_joint = np.zeros(len(self.mode), dtype=np.int32)
        of_world = np.zeros(max(s.worlds) + 1, dtype=np.int32)
        for k, group in enumerate(self.welds):
            joint[k, : len(group)] = group
            size[k] = len(group)
            of_joint[list(group)] = k + 1
            of_world[s.world_of_joint(group[0])] += 1
            neck = float(self.neck[list(group)].mean())
            gap[k], reach[k] = 2.0 * neck, 2.0 * neck / np.sin(np.pi / max(len(group), 2))
        for name, values in (
            ("weld_joint", joint),
            ("weld_size", size),
            ("weld_reach", reach),
            ("weld_gap", gap),
            ("joint_weld", of_joint),
            ("world_welds", of_world),
        ):
            s.arrays[name].assign(values)
