"""The hands: host arrays that say, frame by frame, what every joint's ring has to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.plan.welding import MOST_WELDED
from balloon_usd.solver.kernels.physics.joints import CLASP_MODE, GRIP_MODE, LEAD_MODE
from balloon_usd.solver.kernels.physics.motion import LEADING_SPEED, LYING_MODE
from balloon_usd.solver.motions.chains import pose_chains
from balloon_usd.solver.upload import ArrayUpload, BatchedUpload

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from balloon_usd.solver.motions.chains import Pose
    from balloon_usd.solver.scene import Scene

Floats = NDArray[np.float32]

WELDS = (
    "weld_joint",
    "weld_size",
    "weld_reach",
    "weld_gap",
    "joint_weld",
    "joint_leader",
    "world_welds",
)
"""Arrays that change when joints are welded or parted."""
LEAD_FORCE = 6.0
"""Largest force of a hand that leads a bubble, N: a light push."""
LEAD_STIFFNESS = 800.0
"""Stiffness of that hand, N/m, where the time step allows it."""
FIRM_STIFFNESS = 2500.0
"""The same of hands that press a bubble through others: flattened, it yields by some millimetres only."""
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
        self._lead_stiffness = np.minimum(lead_stiffness, _stiffest(scene)).astype(np.float32)
        self.stiffness = self._lead_stiffness.copy()
        closed = [r.closed for b in scene.bodies for r in b.rings]
        neck = [b.neck_radius for b in scene.bodies for _ in b.rings]
        self.neck = np.array(neck or [1.0], dtype=np.float32)
        self.closed = np.array(closed or [False])
        self.radius = np.where(self.closed, self.neck, 0.0).astype(np.float32)
        self.radius_goal = self.radius.copy()
        self.touching = np.zeros(len(scene.bodies), dtype=np.int32)
        """Balloons whose walls may touch something: once any is bent, pressed or brought to others."""
        self.contact = self._touched = False
        """Whether walls are searched in the frame that was uploaded, and whether any could touch in it."""
        self.fingers = scene.fingers.numpy().copy()
        self.drag = scene.drag.numpy().copy()
        """Air drag of every balloon, 1/s."""
        self.leading = np.full(len(scene.bodies), LEADING_SPEED, dtype=np.float32)
        """Speed at which walls of every balloon are led out of others that they have gone through, m/s."""
        self.floating = np.zeros(len(scene.bodies), dtype=np.int32)
        """1 where nothing outside acts on the sculpture of a balloon."""
        self.finger_share = np.zeros(len(scene.x), dtype=np.float32)
        """Share of a finger's force that every vertex takes."""
        self.pressing = False
        """Whether any finger is on a wall."""
        self.places = scene.x.numpy()
        """Where all vertices are, (V, 3), m, as last read back."""
        self.rings = (scene.joint_first.numpy(), scene.joint_around.numpy())
        """First vertex of every ring, and how many it has."""
        self._upload: BatchedUpload | None = None
        self._uploads = {name: ArrayUpload(scene, name) for name in self._rarely_changed()}
        self._due: dict[str, Any] = {}
        """Changes since the last upload, by the names of the arrays."""
        self._welded = False
        """Whether joints were welded since the last upload."""
        self.welds: list[tuple[int, ...]] = []
        self._weld_of: dict[int, tuple[int, ...]] = {}
        """The weld that holds a joint."""
        self._weld_sizes: dict[tuple[int, ...], tuple[float, float]] = {}
        """Gap and reach (m) of every weld so far."""
        self._poses: list[Pose] = []
        """Chains that are brought somewhere in the coming frame."""
        self._ring_world = np.repeat(scene.worlds, np.diff(scene.joint_start))

    def _rarely_changed(self) -> tuple[str, ...]:
        """Return the names of the arrays that change in few frames only."""
        return ("fingers", "finger_share", *WELDS)

    def begin_frame(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take over the state read back last, by the names of arrays of the scene, and lift all fingers."""
        self.places = state["x"]
        self.lift_fingers()

    def grip(self, joint: int, middle: Floats) -> None:
        """Take hold of a ring where it is."""
        if self.mode[joint] not in (GRIP_MODE, CLASP_MODE):
            self.mode[joint] = GRIP_MODE
            self.start[joint] = self.goal[joint] = middle[joint]

    def clasp(self, joint: int, middle: Floats) -> None:
        """Take hold of a ring so that, once closed, it does not turn either."""
        self.grip(joint, middle)
        self.mode[joint] = CLASP_MODE

    def unclasp(self, joint: int) -> None:
        """Let a ring that is gripped turn with the walls beside it."""
        self.mode[joint] = GRIP_MODE

    def lead(self, joint: int, middle: Floats) -> None:
        """Begin to lead a ring from where it is."""
        if self.mode[joint] == 0:
            self.mode[joint] = LEAD_MODE
            self.start[joint] = self.goal[joint] = middle[joint]
            self.free[joint] = 0.0

    def leads(self, joint: int) -> bool:
        """Tell whether a hand leads a ring."""
        return bool(self.mode[joint] == LEAD_MODE)

    def pull(self, joint: int) -> None:
        """Pull a ring as hard as hands can, once it is led."""

    def lead_firmly(self, joints: NDArray[np.int64], force: float) -> None:
        """Let led rings yield little, with a force of up to so much (N), until they are let go."""
        self.force[joints] = force
        self.stiffness[joints] = np.minimum(FIRM_STIFFNESS, _stiffest(self.scene)[joints])

    def close(self, joint: int, radius: float) -> None:
        """Set the radius (m) that a neck has at the end of the frame."""
        self.radius_goal[joint] = radius

    def set_drag(self, balloon: int, rate: float) -> None:
        """Set the air drag of a balloon (1/s)."""
        self.drag[balloon] = rate

    def touch(self, balloons: Iterable[int]) -> None:
        """Let the walls of these balloons touch from now on."""
        self.touching[list(balloons)] = 1

    def stop_touching(self, balloons: Iterable[int]) -> None:
        """Let the walls of these balloons touch nothing from now on."""
        self.touching[list(balloons)] = 0

    def lay(self, balloons: list[int]) -> None:
        """Let the walls of these balloons go on touching what they touch, and nothing else."""
        self.touching[balloons] = np.where(self.touching[balloons] > 0, LYING_MODE, 0)

    def set_finger(self, balloon: int, share: Floats, **finger: Any) -> None:
        """Put a finger on a balloon for the coming frame.

        `share`: of its force on every vertex of that balloon, (V,), adding up to 1; `finger`: fields of a
        `Finger`.
        """
        s = self.scene
        self.finger_share[s.vertex_start[balloon] : s.vertex_start[balloon + 1]] = share
        fill_row(self.fingers, balloon, finger)
        self.pressing = True
        self._due["fingers"], self._due["finger_share"] = self.fingers, self.finger_share

    def set_fingertip(self, balloon: int, **finger: Any) -> None:
        """Put a finger with a round tip on a balloon for the coming frame; `finger`: fields of a `Finger`."""
        fill_row(self.fingers, balloon, finger)
        self.pressing = True
        self._due["fingers"] = self.fingers

    def lift_fingers(self) -> None:
        """Take all fingers from the walls."""
        if self.pressing:
            self.finger_share[:] = 0.0
            self.fingers["radius"] = 0.0
        self.pressing = False

    def let_go(self, joints: NDArray[np.int64]) -> None:
        """Take the hands from these rings."""
        self.mode[joints] = 0
        # The soft hand on a tail stays soft.
        self.stiffness[joints] = np.minimum(self.stiffness[joints], self._lead_stiffness[joints])

    def bring(self, pose: Pose) -> None:
        """Bring the rings of a chain somewhere in the coming frame, with those of other chains."""
        self._poses.append(pose)

    def settle(self) -> None:
        """Set the goals of the chains that are brought somewhere."""
        if self._poses:
            pose_chains(self.goal, self._poses)
            self._poses.clear()

    def weld(self, joints: tuple[int, ...]) -> None:
        """Hold joints together from now on, with everything already welded to them.

        Raises:
            ValueError: more joints than one weld can hold.
        """
        merged = set(joints)
        for group in self.welds_of(joints):
            merged |= set(group)
            self.welds.remove(group)
        if len(merged) > MOST_WELDED:
            raise ValueError(f"at most {MOST_WELDED} joints can be twisted into one, got {len(merged)}")
        group = tuple(sorted(merged))
        self.welds.append(group)
        self._weld_of.update(dict.fromkeys(group, group))
        self._welded = True

    def part(self, joints: Iterable[int]) -> None:
        """Undo all welds of these joints."""
        for group in self.welds_of(joints):
            self.welds.remove(group)
            for joint in group:
                del self._weld_of[joint]
            self._welded = True

    def welds_of(self, joints: Iterable[int]) -> list[tuple[int, ...]]:
        """Return the welds that hold any of these joints."""
        return list(dict.fromkeys(self._weld_of[j] for j in joints if j in self._weld_of))

    def upload(self) -> None:
        """Send the goals of the coming frame to the device; its starts are where the last frame ended.

        Raises:
            ValueError: more welds than the capacity.
        """
        self.settle()
        # Once more after the last wall could touch: the search takes away what it touched.
        before, self._touched = self._touched, bool(self.touching.any())
        self.contact = self._touched or before
        if self._welded:
            self._upload_welds()
            self._welded = False
        for name, changed in self._due.items():
            self._uploads[name].staged()[...] = changed
            self._uploads[name].send()
        self._due.clear()
        goals = self._goals()
        if self._upload is None:
            self._upload = BatchedUpload(self.scene, goals)
        self._upload.send(goals)

    def _goals(self) -> dict[str, NDArray[Any]]:
        """Return the arrays that may differ in every frame, by name."""
        return {
            "hand": self.mode,
            "hand_from": self.start,
            "hand_to": self.goal,
            "hand_free": self.free,
            "hand_force": self.force,
            "hand_stiffness": self.stiffness,
            "radius_from": self.radius,
            "radius_to": self.radius_goal,
            "touching": self.touching,
            "drag": self.drag,
            "leading": self.leading,
            "floating": self.floating,
        }

    def arrived(self) -> None:
        """Make this frame's goals the next frame's starts."""
        self.start[:] = self.goal
        self.radius[:] = self.radius_goal

    def _upload_welds(self) -> None:
        s = self.scene
        rows = len(s.weld_size)
        if len(self.welds) > rows:
            raise ValueError(f"{len(self.welds)} welds but room for {rows}")
        joint = np.zeros((rows, MOST_WELDED), dtype=np.int32)
        size = np.zeros(rows, dtype=np.int32)
        reach, gap = np.zeros(rows, dtype=np.float32), np.zeros(rows, dtype=np.float32)
        of_joint = np.zeros(len(self.mode), dtype=np.int32)
        leader = np.arange(len(self.mode), dtype=np.int32)
        count = len(self.welds)
        size[:count] = [len(group) for group in self.welds]
        joints = np.array([j for group in self.welds for j in group], dtype=np.int32)
        first = np.cumsum(size[:count]) - size[:count]
        weld = np.repeat(np.arange(count), size[:count])
        joint[weld, np.arange(len(joints)) - first[weld]] = joints
        of_joint[joints] = weld + 1
        leader[joints] = joints[first][weld]
        gap[:count], reach[:count] = np.array([self._weld_size(g) for g in self.welds]).reshape(-1, 2).T
        of_world = np.bincount(self._ring_world[joints[first]], minlength=max(s.worlds) + 1)
        values = joint, size, reach, gap, of_joint, leader, of_world
        self._due.update(zip(WELDS, values, strict=True))

    def _weld_size(self, group: tuple[int, ...]) -> tuple[float, float]:
        """Return the gap between two joints of a weld and the reach of them all, m."""
        if group not in self._weld_sizes:
            gap = 2.0 * float(self.neck[list(group)].mean())
            self._weld_sizes[group] = gap, gap / float(np.sin(np.pi / max(len(group), 2)))
        return self._weld_sizes[group]


def _stiffest(scene: Scene) -> NDArray[Any]:
    """Return the stiffness that the time step allows on every ring, (J,), N/m."""
    found: NDArray[Any] = STEP_STIFFNESS * scene.joint_mass.numpy() / scene.settings.dt**2
    return found


def fill_row(rows: NDArray[Any], at: int, fields: Mapping[str, Any]) -> None:
    """Set the fields of one row; those that are not given are 0."""
    row = np.zeros((), dtype=rows.dtype)
    for name, value in fields.items():
        row[name] = value
    rows[at] = row
