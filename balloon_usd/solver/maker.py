"""The maker: performs the choreography of one sculpture, frame by frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.operations.moves import Bend, Bring, Gather, LetGo, Move, Press, Weld
from balloon_usd.plan.closing import ClosingChain, smooth
from balloon_usd.solver.gathering import Gathering
from balloon_usd.solver.model import Status
from balloon_usd.solver.push import FINGER_STIFFNESS, Patch, patch_under, press_profile

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.scene import Scene

Floats = NDArray[np.float32]

# Index of the move, the move, how much of it is over, whether it begins, and where all rings are.
_Performer = Callable[[int, Any, float, bool, Floats], None]

ALONG = np.array([1.0, 0.0, 0.0])
"""Direction from the knot to the tip."""


class Maker(ABC):
    """Performs one plan on its balloons in a scene."""

    def __init__(self, plan: Plan, scene: Scene, hands: Hands, first_body: int) -> None:
        self.plan = plan
        self._fps = plan.recipe.fps
        self.scene = scene
        self.hands = hands
        names = list(plan.strips)
        self.body = {name: first_body + k for k, name in enumerate(names)}
        self._ring = self._global_rings()
        self._began: dict[int, NDArray[np.float64]] = {}
        """State of the sculpture when a move began, by index of the move."""
        self._gathered: dict[int, Gathering] = {}
        """Chains that are being closed, by index of the move."""
        self._steadied: dict[int, int] = {}
        """How often hands had let go when the joints round a ring were last kept from swinging."""
        self._patches: dict[int, Patch] = {}
        """Where fingers press, by index of the move."""
        self._pressed: dict[int, float] = {}
        """How far they do by now, as a share."""
        self._done = 0
        """Moves that are finished."""
        self._frame = 0
        self._span = (0.0, 0.0)
        """Beginning and end of the coming frame, s."""
        self._text = ""
        self.status = Status("")
        """Status of the sculpture after the coming frame."""
        self._brought = False
        """Whether a chain is brought somewhere in the coming frame."""
        self._moves = [(move.start, move.end, move) for move in plan.choreography.moves]
        self._performers: dict[type[Move], _Performer] = {
            Gather: self._gather,
            Bring: self._bring,
            Bend: self._bend,
            Press: self._push,
            Weld: self._weld,
            LetGo: self._let_go,
        }
        """Method for each kind of move; during others the hands wait."""

    def _global_rings(self) -> list[int]:
        """Joint of the scene of every planned ring: a body's rings are its plan's, after its spare ones."""
        place = {
            name: int(self.scene.joint_start[b]) + self.scene.bodies[b].spare_rings
            for name, b in self.body.items()
        }
        found = []
        for ring in self.plan.table.rings:
            found.append(place[ring.balloon])
            place[ring.balloon] += 1
        return found

    def act(self, begin: float, end: float, middle: Floats) -> None:
        """Set the hands' goals for the frame from `begin` to `end` (s), given where all rings are (J, 3),
        m.
        """
        self._perform(begin, end, middle)
        self._update_status()

    def _perform(self, begin: float, end: float, middle: Floats) -> None:
        self._frame = round(end * self._fps)
        self._span = (begin, end)
        self._brought = False
        for k in range(self._done, len(self._moves)):
            start, over, move = self._moves[k]
            if start >= end:
                break
            if self._brought:
                # A move begins where another has brought the rings.
                self.hands.settle()
            fresh = k not in self._began
            if fresh:
                self._began[k] = np.zeros(0)
                self._text = move.text if move.seconds > 0.0 else self._text
            share = 1.0 if over <= end or move.seconds == 0.0 else (end - start) / move.seconds
            performer = self._performers.get(type(move))
            if performer is not None:
                performer(k, move, share, fresh, middle)
            if over <= end and k == self._done:
                self._done += 1

    def _update_status(self) -> None:
        """Set the status, a new object only where it differs."""
        if self._text is not self.status.doing:
            self.status = Status(self._text)

    def _weld(self, _: int, move: Weld, __: float, fresh: bool, ___: Floats) -> None:
        if fresh:
            self.hands.weld(tuple(self._ring[r] for r in move.rings))

    def _let_go(self, _: int, __: LetGo, ___: float, fresh: bool, ____: Floats) -> None:
        if fresh:
            self.hands.let_go(np.array(self._ring, dtype=np.int64))

    def _steady(self, ring: int, middle: Floats) -> None:
        """Keep what is already made from swinging round a joint, free to move along the balloon as the
        neck draws it in.
        """
        if self._steadied.get(ring) == self.hands.releases:
            return
        self._steadied[ring] = self.hands.releases
        worked = self._worked(ring)
        for joint in worked:
            self.hands.lead(joint, middle)
        self.hands.free[worked] = ALONG

    def _gather(self, k: int, move: Gather, share: float, fresh: bool, middle: Floats) -> None:
        if fresh:
            self.hands.touch(self.body.values())
            self._gathered[k] = self._begin_gathering(move, middle)
        self.hands.bring(self._gathered[k].pose(smooth(share)))
        self._brought = True

    def _begin_gathering(self, move: Gather, middle: Floats) -> Gathering:
        """Take hold of the corners of a chain and of what is beside it."""
        corners = [self._ring[r] for r in move.corners]
        cheeks = [(self._ring[r], side) for r, side in move.cheeks]
        held, moving = corners[-1], corners[0]
        # The other hand keeps what is already made, and the open rest, from swinging.
        before, beyond = self._worked(move.corners[0]), self._open(move.corners[-1])
        self.hands.clasp(held, middle)
        self.hands.grip(moving, middle)
        for joint in [*corners[1:-1], *(c for c, _ in cheeks), *before, *beyond]:
            self.hands.lead(joint, middle)
        began, swung = middle[corners].astype(np.float64), middle[before].astype(np.float64)
        sides = np.maximum(np.linalg.norm(np.diff(began, axis=0), axis=1), 1e-3)
        chain = ClosingChain(sides, ALONG, np.array(move.point), 2.0 * float(self.hands.neck[held]))
        off = began - began[-1] - chain.pose(0.0)
        joints, sides = np.array(cheeks, dtype=np.int64).reshape(-1, 2).T
        straight = middle[joints].astype(np.float64) - 0.5 * (began[sides] + began[sides + 1])
        bulge = np.array([self._bulged_radius(ring) for ring, _ in move.cheeks])[:, None]
        return Gathering(
            np.array(corners),
            np.array(before, dtype=np.int64),
            began,
            swung,
            chain,
            off,
            joints,
            sides,
            straight,
            bulge,
        )

    def _worked(self, ring: int) -> list[int]:
        """Joints on the knot's side of a ring."""
        rings = self.plan.table.rings
        return [
            self._ring[k] for k in range(ring) if rings[k].joint and rings[k].balloon == rings[ring].balloon
        ]

    def _open(self, ring: int) -> list[int]:
        """Rings on the tip's side of a ring, where the tube is still whole: its joints to be, and one in
        the rest.
        """
        rings = self.plan.table.rings
        rest = self.plan.strips[rings[ring].balloon].bubbles[-1].name
        return [
            self._ring[k]
            for k in range(ring + 1, len(rings))
            if rings[k].balloon == rings[ring].balloon and (rings[k].joint or rings[k].bubble == rest)
        ]

    def _bulged_radius(self, ring: int) -> float:
        strip = self.plan.strips[self.plan.table.rings[ring].balloon]
        return strip.size.radius * maxwell_state(strip.rubber).bulged.a

    def _bring(self, k: int, move: Bring, share: float, fresh: bool, middle: Floats) -> None:
        joint, held = self._ring[move.ring], self._ring[move.to]
        if fresh:
            self.hands.touch(self.body.values())
            self.hands.grip(joint, middle)
            self.hands.grip(held, middle)
            self._began[k] = middle[[joint, held]].astype(np.float64)
        here, there = self._began[k]
        away = (here - there) / max(float(np.linalg.norm(here - there)), 1e-9)
        goal = there + away * 2.0 * float(self.hands.neck[held])
        self.hands.goal[joint] = here + smooth(share) * (goal - here)

    def _bend(self, k: int, move: Bend, share: float, fresh: bool, middle: Floats) -> None:
        """Bend a bubble towards a side: its end stays, its start goes, and carries what is already made
        upright.
        """
        rings = [self._ring[r] for r in move.rings]
        before, beyond = self._worked(move.rings[0]), self._open(move.rings[-1])
        if fresh:
            for joint in [*rings, *before, *beyond]:
                self.hands.lead(joint, middle)
            self._began[k] = middle[[*rings, *before]].astype(np.float64)
        began = self._began[k][: len(rings)]
        sides = np.linalg.norm(np.diff(began, axis=0), axis=1)
        axis = began[0] - began[-1]
        axis /= max(float(np.linalg.norm(axis)), 1e-9)
        point = np.array(move.point) - axis * float(np.array(move.point) @ axis)
        point /= max(float(np.linalg.norm(point)), 1e-9)
        along = np.concatenate([[0.0], np.cumsum(sides[::-1])])
        turn = smooth(share) * move.angle * (along[1:] + along[:-1]) / (2.0 * along[-1])
        steps = sides[::-1, None] * (np.cos(turn)[:, None] * axis + np.sin(turn)[:, None] * point)
        goal = (began[-1] + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)]))[::-1]
        self.hands.goal[rings] = goal
        if before:
            self.hands.goal[before] = self._began[k][len(rings) :] + (goal[0] - began[0])
        if share >= 1.0:
            self._keep_bend(self.plan.table.rings[move.rings[1]].bubble)

    def _push(self, k: int, move: Press, share: float, fresh: bool, middle: Floats) -> None:
        """Press a finger into a wall and take it back; the other hand holds the ends."""
        b = self.body[move.balloon]
        if fresh:
            self.hands.touch(self.body.values())
            for ring in move.holds:
                self.hands.grip(self._ring[ring], middle)
            self._patches[k] = patch_under(self.scene, b, move)
        patch = self._patches[k]
        now, pressed = self._pressed.get(k, 0.0), press_profile(share)
        along = np.array(move.point)
        self._pressed[k] = pressed
        self.hands.set_finger(
            b,
            patch.share,
            start=patch.touch + move.depth * now * along,
            end=patch.touch + move.depth * pressed * along,
            load_start=move.force * now,
            load_end=move.force * pressed,
            along=along,
            stiff=FINGER_STIFFNESS / float(patch.share.max()) if move.depth > 0.0 else 0.0,
        )

    def _ring_width(self, joint: int) -> float:
        """Mean distance of a ring's vertices from their middle, m."""
        first, n = (int(values[joint]) for values in self.hands.rings)
        ring = self.hands.places[first : first + n]
        return float(np.linalg.norm(ring - ring.mean(axis=0), axis=1).mean())

    @abstractmethod
    def _keep_bend(self, bubble: str) -> None:
        """Let a bubble that was bent keep part of its curve."""

    def _faces(self, bubble: str) -> tuple[int, NDArray[np.int64]]:
        """Body of a bubble, and its faces in order round each ring, numbered within the body."""
        for name, strip in self.plan.strips.items():
            for index, planned in enumerate(strip.bubbles):
                if planned.name == bubble:
                    body = self.scene.bodies[self.body[name]]
                    segment = index + body.spare_segments
                    first = body.segment_ends[segment - 1] if segment else 0
                    last = body.segment_ends[segment]
                    cap = (body.rings[0].around // 4) ** 2
                    first += cap if segment == 0 else 0
                    last -= cap if index == len(strip.bubbles) - 1 else 0
                    return self.body[name], np.arange(first, last)
        raise KeyError(bubble)
