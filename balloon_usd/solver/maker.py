"""The maker: performs the choreography of one sculpture, frame by frame."""

from __future__ import annotations

import math
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.bubble_shape import tail_volume_per_rest_length, tube_volume_per_rest_length
from balloon_usd.balloon.tube_theory import maxwell_state, pressure_maximum
from balloon_usd.plan.choreography import Bend, Bring, Gather, Inflate, LetGo, Move, Pinch, Spin, Weld
from balloon_usd.plan.closing import closing_pose, smooth
from balloon_usd.solver.memory import set_bend

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.scene import Scene
    from balloon_usd.solver.struts import Struts

Floats = NDArray[np.float32]

PUMP_RESERVE = 1.15
"""Pressure of the pump over the pressure at which the flat tube gives way."""
PUMP_TIME = 0.985
"""Share of the time given to inflating in which the pump has done its work."""
PUMP_RAMP = 0.2
"""Share of that time in which the pump starts, and stops."""
TAIL_STIFFNESS = 200.0
"""Stiffness of the hand that leads the flat tail while the balloon is blown up, N/m: soft, it only steers."""
SPIN_CLEAR = 1e-6
"""What lies farther than this beyond a joint turns with the balloon, m."""
SOFTENING_SECONDS = 0.1
"""Time in which stretched rubber softens, s: longer than the waves that hands send through a heavy mesh."""
ALONG = np.array([1.0, 0.0, 0.0])
"""Direction from the knot to the tip."""


class Maker:
    """Performs one plan on its balloons in a scene."""

    def __init__(self, plan: Plan, scene: Scene, hands: Hands, struts: Struts, first_body: int) -> None:
        self.plan = plan
        self.scene = scene
        self.hands = hands
        self.struts = struts
        names = list(plan.strips)
        self.body = {name: first_body + k for k, name in enumerate(names)}
        self._ring = self._global_rings()
        self._began: dict[int, NDArray[np.float64]] = {}
        """What a move found when it began, by index of the move."""
        self._done = 0
        """Moves that are finished."""
        self._frame = 0
        self.doing = ""
        self.inflated = -1
        """Frame at whose end the last balloon has its gas."""

    def _global_rings(self) -> list[int]:
        """Joint of the scene of every planned ring: a body's rings are its plan's, after the lip."""
        place = {name: int(self.scene.joint_start[b]) + 1 for name, b in self.body.items()}
        found = []
        for ring in self.plan.table.rings:
            found.append(place[ring.balloon])
            place[ring.balloon] += 1
        return found

    def act(self, begin: float, end: float, middle: Floats) -> None:
        """Set the hands' goals for the frame from `begin` to `end` (s), given where all rings are (J, 3),
        m.
        """
        moves = self.plan.choreography.moves
        self._frame = round(end * self.plan.recipe.fps)
        for body in self.body.values():
            self.hands.stop_turning(body)
        for k in range(self._done, len(moves)):
            move = moves[k]
            if move.start >= end:
                break
            fresh = k not in self._began
            if fresh:
                self._began[k] = np.zeros(0)
                self.doing = move.text if move.seconds > 0.0 else self.doing
            share = 1.0 if move.end <= end or move.seconds == 0.0 else (end - move.start) / move.seconds
            self._perform(k, move, (begin, end), share, fresh, middle)
            if move.end <= end and k == self._done:
                self._done += 1

    def _perform(
        self, k: int, move: Move, frame: tuple[float, float], share: float, fresh: bool, middle: Floats
    ) -> None:
        if isinstance(move, Inflate):
            self._inflate(move, share, fresh, middle)
        elif isinstance(move, Pinch):
            self._pinch(k, move, share, fresh, middle)
        elif isinstance(move, Spin):
            self._spin(move, *frame, middle)
        elif isinstance(move, Gather):
            self._gather(k, move, share, fresh, middle)
        elif isinstance(move, Bring):
            self._bring(k, move, share, fresh, middle)
        elif isinstance(move, Bend):
            self._bend(k, move, share, fresh, middle)
        elif isinstance(move, Weld) and fresh:
            self.hands.weld(tuple(self._ring[r] for r in move.rings))
        elif isinstance(move, LetGo) and fresh:
            self.hands.let_go(np.array(self._ring))
            self.struts.hold(self._friction_pairs(), middle)

    def _inflate(self, move: Inflate, share: float, fresh: bool, middle: Floats) -> None:
        b = self.body[move.balloon]
        if fresh:
            strip, budget = self.plan.strips[move.balloon], self.plan.budgets[move.balloon]
            scale = strip.size.thickness / strip.size.radius
            n = self.scene.bodies[b].rings[0].around
            # The polygon holds more than the circle that it is drawn about.
            self.hands.pump_goal[b] = budget.gas_amount * n * math.tan(math.pi / n) / math.pi
            self.hands.pump_limit[b] = PUMP_RESERVE * pressure_maximum(strip.rubber).p_star * scale
            self.hands.grip(int(self.scene.joint_start[b]) + 1, middle)
            self.hands.set_drag(b, 0.0)
            # What the mesh's artificial inertia adds to the stretch behind the front must not soften it.
            self.hands.set_softening(b, 0.0)
        # The pump starts and stops gently: the balloon is pushed along by its own front.
        gentle = min(1.0, share / PUMP_RAMP, (1.0 - share) / PUMP_RAMP)
        flow = self.hands.pump_goal[b] / (PUMP_TIME * (1.0 - PUMP_RAMP) * move.seconds)
        self.hands.pump_flow[b] = flow * max(gentle, 0.0)
        self._lead_tail(move.balloon, float(self.hands.pump_flow[b]), fresh, middle)
        if share >= 1.0:
            self.hands.set_drag(b, self.scene.settings.drag)
            self.hands.set_softening(b, self.scene.settings.dt / SOFTENING_SECONDS)
            self.inflated = self._frame

    def _lead_tail(self, balloon: str, flow: float, fresh: bool, middle: Floats) -> None:
        """Keep the flat tail straight and as fast as the front that a flow of gas (mol/s) drives along."""
        strip = self.plan.strips[balloon]
        tip = self._ring[self.plan.table.guides(strip.bubbles[-1].name)[-1]]
        if fresh:
            self.hands.lead(tip, middle)
            self.hands.stiffness[tip] = TAIL_STIFFNESS
        state = maxwell_state(strip.rubber)
        gained = tube_volume_per_rest_length(strip.size, strip.rubber) - tail_volume_per_rest_length(
            strip.size, strip.rubber
        )
        pressure = self.scene.settings.atmosphere + self.plan.budgets[balloon].pressure
        rest_speed = flow * float(self.scene.air.molar_energy) / (pressure * gained)
        forward = np.array(ALONG, dtype=np.float32)
        axial = float((middle[tip] - self.hands.goal[tip]) @ forward)
        self.hands.start[tip] = self.hands.goal[tip] + forward * axial
        step = rest_speed * (state.bulged.b - state.thin.b) / self.plan.recipe.fps
        self.hands.goal[tip] = self.hands.start[tip] + forward * step
        if flow == 0.0:
            self.hands.free[tip] = ALONG

    def _pinch(self, k: int, move: Pinch, share: float, fresh: bool, middle: Floats) -> None:
        joint = self._ring[move.ring]
        if fresh:
            first, n = int(self.scene.joint_first.numpy()[joint]), int(self.scene.joint_around.numpy()[joint])
            ring = self.scene.x.numpy()[first : first + n]
            wide = float(np.linalg.norm(ring - ring.mean(axis=0), axis=1).mean())
            self._began[k] = np.array([wide])
            self.hands.clasp(joint, middle)
            self.hands.split_gas(joint)
            self.hands.radius[joint] = wide
            self.hands.passage[joint] = math.pi * wide**2
        self._steady(move.ring, middle)
        wide, neck = float(self._began[k][0]), float(self.hands.neck[joint])
        radius = neck + (wide - neck) * (1.0 - smooth(share))
        self.hands.close(joint, radius, math.pi * (radius**2 - neck**2))

    def _steady(self, ring: int, middle: Floats) -> None:
        """Keep what is already made from swinging round a joint, free to move along the balloon as the
        neck draws it in.
        """
        for joint in self._worked(ring):
            self.hands.lead(joint, middle)
            self.hands.free[joint] = ALONG

    def _spin(self, move: Spin, begin: float, end: float, middle: Floats) -> None:
        ring = self.plan.table.rings[move.ring]
        self._steady(move.ring, middle)
        inside = max(0.0, min(end, move.end) - max(begin, move.start))
        rate = 2.0 * math.pi * move.turns / move.seconds * inside / (end - begin)
        self.hands.turn(self.body[ring.balloon], self._ring[move.ring], ring.along + SPIN_CLEAR, rate)

    def _gather(self, k: int, move: Gather, share: float, fresh: bool, middle: Floats) -> None:
        self.hands.touch(self.body.values())
        corners = [self._ring[r] for r in move.corners]
        cheeks = [(self._ring[r], side) for r, side in move.cheeks]
        held, moving = corners[-1], corners[0]
        # The other hand keeps what is already made, and the open rest, from swinging.
        before, beyond = self._worked(move.corners[0]), self._open(move.corners[-1])
        if fresh:
            self.hands.clasp(held, middle)
            self.hands.grip(moving, middle)
            for joint in [*corners[1:-1], *(c for c, _ in cheeks), *before, *beyond]:
                self.hands.lead(joint, middle)
            self._began[k] = middle[[*corners, *(c for c, _ in cheeks), *before]].astype(np.float64)
        began = self._began[k]
        count = len(corners)
        sides = np.maximum(np.linalg.norm(np.diff(began[:count], axis=0), axis=1), 1e-3)
        progress = smooth(share)
        gap = 2.0 * float(self.hands.neck[held])
        pose = began[count - 1] + closing_pose(sides, progress, ALONG, np.array(move.point), gap)
        # The chain was not quite straight: what it was off fades as it closes.
        pose += (1.0 - progress) * (
            began[:count] - began[count - 1] - closing_pose(sides, 0.0, ALONG, np.array(move.point), gap)
        )
        self.hands.goal[corners] = pose
        if before:
            self.hands.goal[before] = began[count + len(cheeks) :] + (pose[0] - began[0])
        centre = pose.mean(axis=0)
        for slot, (joint, side) in enumerate(cheeks):
            middle_of_side = 0.5 * (pose[side] + pose[side + 1])
            out = middle_of_side - centre
            across = pose[side + 1] - pose[side]
            across = across / max(float(np.linalg.norm(across)), 1e-9)
            out = out - across * float(out @ across)
            out = out / max(float(np.linalg.norm(out)), 1e-9)
            straight = began[count + slot] - 0.5 * (began[side] + began[side + 1])
            bulge = self._bulged_radius(move.cheeks[slot][0])
            self.hands.goal[joint] = middle_of_side + (1.0 - progress) * straight + progress * bulge * out

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
            self._set_bend(self.plan.table.rings[move.rings[1]].bubble)

    def _set_bend(self, bubble: str) -> None:
        """Let a bubble that was bent keep part of its curve."""
        for name, strip in self.plan.strips.items():
            for index, planned in enumerate(strip.bubbles):
                if planned.name == bubble:
                    body = self.scene.bodies[self.body[name]]
                    first, last = body.segment_ends[index + 1], body.segment_ends[index + 2]
                    if index == len(strip.bubbles) - 1:
                        last -= (body.rings[0].around // 4) ** 2
                    set_bend(self.scene, self.body[name], np.arange(first, last))

    def _friction_pairs(self) -> set[tuple[int, int]]:
        """Pairs of rings whose distance the friction of a weld keeps."""
        welds = [set(group) for group in self.hands.welds]
        ends = [self._neighbours(weld) for weld in welds]
        pairs = set()
        for weld, near in zip(welds, ends, strict=True):
            pairs |= set(combinations(sorted(near | self._cheeks(weld, near)), 2))
        for (weld, near), (other, far) in combinations(zip(welds, ends, strict=True), 2):
            if near & other:
                pairs |= {(min(a, b), max(a, b)) for a in near - other for b in far - weld if a != b}
        return pairs

    def _neighbours(self, weld: set[int]) -> set[int]:
        """Joints at the far ends of the bubbles that meet in a weld; of a loop or an open end, a ring
        inside.
        """
        found: set[int] = set()
        for bubble, inside, outside in self._meeting(weld):
            guides = [self._ring[g] for g in self.plan.table.guides(bubble)]
            if outside is not None and self.hands.radius_goal[outside] > 0.0:
                found.add(outside)
            elif guides and inside == 2:
                found.add(guides[len(guides) // 2])
            elif guides and outside is None:
                found.add(guides[0])
        return found

    def _cheeks(self, weld: set[int], near: set[int]) -> set[int]:
        """Middles of bubbles that lie side by side: two that share both a weld and the joint beyond it."""
        met = [(bubble, outside) for bubble, _, outside in self._meeting(weld) if outside in near]
        beyond = [outside for _, outside in met]
        folded = [bubble for bubble, outside in met if beyond.count(outside) > 1]
        return {self._ring[self.plan.table.guides(bubble)[0]] for bubble in folded}

    def _meeting(self, weld: set[int]) -> list[tuple[str, int, int | None]]:
        """Bubbles with an end in a weld: name, number of ends in it, and the ring of the other end if
        there is one.
        """
        found = []
        for bubble in self.plan.bubbles:
            start, end = self.plan.table.ends(bubble.name)
            rings = [self._ring[r] for r in (start, end) if r is not None]
            inside = [ring for ring in rings if ring in weld]
            if inside:
                found.append((bubble.name, len(inside), next((r for r in rings if r not in weld), None)))
        return found
