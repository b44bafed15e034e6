"""The maker: performs the choreography of one sculpture, frame by frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import warp as wp
from numpy.typing import NDArray

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.choreography import Bend, Bring, Gather, LetGo, Move, Push, Weld
from balloon_usd.plan.closing import ClosingChain, smooth
from balloon_usd.solver.kernels.fingers import Finger
from balloon_usd.solver.push import FINGER_STIFFNESS, Patch, patch_under, press_profile

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.scene import Scene

Floats = NDArray[np.float32]

ALONG = np.array([1.0, 0.0, 0.0])
"""Direction from the knot to the tip."""


@dataclass(frozen=True)
class _Gathering:
    """A chain of bubbles that is being closed, and what it found when that began; places in m."""

    corners: list[int]
    """Joints of the chain, from its first to the held one."""
    before: list[int]
    """Joints of what is already made."""
    began: NDArray[np.float64]
    """Where the corners were."""
    places_before: NDArray[np.float64]
    """Where what is already made was."""
    chain: ClosingChain
    off: NDArray[np.float64]
    """How far the corners were off a straight chain."""
    cheeks: NDArray[np.int64]
    """Rings inside its bubbles, (C,)."""
    sides: NDArray[np.int64]
    """The side of the chain that each is on."""
    straight: NDArray[np.float64]
    """How far each was off the middle of its side, (C, 3)."""
    bulge: NDArray[np.float64]
    """How far each shall be off it in the end, (C, 1)."""


class Maker(ABC):
    """Performs one plan on its balloons in a scene."""

    def __init__(self, plan: Plan, scene: Scene, hands: Hands, first_body: int) -> None:
        self.plan = plan
        self.scene = scene
        self.hands = hands
        names = list(plan.strips)
        self.body = {name: first_body + k for k, name in enumerate(names)}
        self._ring = self._global_rings()
        self._began: dict[int, NDArray[np.float64]] = {}
        """What a move found when it began, by index of the move."""
        self._gathered: dict[int, _Gathering] = {}
        """Chains that are being closed, by index of the move."""
        self._steadied: dict[int, list[int]] = {}
        """Joints that are kept from swinging round a ring."""
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

    @property
    def doing(self) -> str:
        """What the hands do, for people."""
        return self._text

    def act(self, begin: float, end: float, middle: Floats) -> None:
        """Set the hands' goals for the frame from `begin` to `end` (s), given where all rings are (J, 3),
        m.
        """
        moves = self.plan.choreography.moves
        self._frame = round(end * self.plan.recipe.fps)
        self._span = (begin, end)
        for k in range(self._done, len(moves)):
            move = moves[k]
            if move.start >= end:
                break
            fresh = k not in self._began
            if fresh:
                self._began[k] = np.zeros(0)
                self._text = move.text if move.seconds > 0.0 else self._text
            share = 1.0 if move.end <= end or move.seconds == 0.0 else (end - move.start) / move.seconds
            self._perform(k, move, share, fresh, middle)
            if move.end <= end and k == self._done:
                self._done += 1

    def _perform(self, k: int, move: Move, share: float, fresh: bool, middle: Floats) -> None:
        if isinstance(move, Gather):
            self._gather(k, move, share, fresh, middle)
        elif isinstance(move, Bring):
            self._bring(k, move, share, fresh, middle)
        elif isinstance(move, Bend):
            self._bend(k, move, share, fresh, middle)
        elif isinstance(move, Push):
            self._push(k, move, share, fresh, middle)
        elif isinstance(move, Weld) and fresh:
            self.hands.weld(tuple(self._ring[r] for r in move.rings))
        elif isinstance(move, LetGo) and fresh:
            self.hands.let_go(np.array(self._ring, dtype=np.int64))

    def _steady(self, ring: int, middle: Floats) -> None:
        """Keep what is already made from swinging round a joint, free to move along the balloon as the
        neck draws it in.
        """
        if ring not in self._steadied:
            self._steadied[ring] = self._worked(ring)
        worked = self._steadied[ring]
        for joint in worked:
            self.hands.lead(joint, middle)
        self.hands.free[worked] = ALONG

    def _gather(self, k: int, move: Gather, share: float, fresh: bool, middle: Floats) -> None:
        self.hands.touch(self.body.values())
        if fresh:
            self._gathered[k] = self._begin_gathering(move, middle)
        g = self._gathered[k]
        progress = smooth(share)
        pose = g.began[-1] + g.chain.pose(progress)
        # The chain was not quite straight: what it was off fades as it closes.
        pose += (1.0 - progress) * g.off
        self.hands.goal[g.corners] = pose
        if g.before:
            self.hands.goal[g.before] = g.places_before + (pose[0] - g.began[0])
        if len(g.cheeks) == 0:
            return
        first, second = pose[g.sides], pose[g.sides + 1]
        middles, across = 0.5 * (first + second), _unit(second - first)
        out = middles - pose.mean(axis=0)
        out = _unit(out - across * (out * across).sum(axis=1)[:, None])
        self.hands.goal[g.cheeks] = middles + (1.0 - progress) * g.straight + progress * g.bulge * out

    def _begin_gathering(self, move: Gather, middle: Floats) -> _Gathering:
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
        return _Gathering(corners, before, began, swung, chain, off, joints, sides, straight, bulge)

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
        self.hands.touch(self.body.values())
        joint, held = self._ring[move.ring], self._ring[move.to]
        if fresh:
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

    def _push(self, k: int, move: Push, share: float, fresh: bool, middle: Floats) -> None:
        """Press a finger into a wall and take it back; the other hand holds the ends."""
        b = self.body[move.balloon]
        self.hands.touch(self.body.values())
        if fresh:
            for ring in move.holds:
                self.hands.grip(self._ring[ring], middle)
            self._patches[k] = patch_under(self.scene, b, move)
        patch = self._patches[k]
        finger = Finger()
        now, pressed = self._pressed.get(k, 0.0), press_profile(share)
        along = np.array(move.point)
        finger.start, finger.end = (wp.vec3(*(patch.touch + move.depth * p * along)) for p in (now, pressed))
        finger.load_start, finger.load_end = move.force * now, move.force * pressed
        finger.along = wp.vec3(*along)
        finger.stiff = FINGER_STIFFNESS / float(patch.share.max()) if move.depth > 0.0 else 0.0
        self._pressed[k] = pressed
        self.hands.set_finger(b, finger, patch.share)

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


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors (N, 3) at length 1."""
    lengths: NDArray[np.float64] = np.sqrt((vectors * vectors).sum(axis=1))
    return vectors / np.maximum(lengths, 1e-9)[:, None]
