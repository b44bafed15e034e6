"""One sculpture in a scene, as the motions of hands see it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.parting import parts_of
from balloon_usd.operations.table import BY_KIND
from balloon_usd.solver.motions.carried import Carried
from balloon_usd.solver.motions.hanging import hanging_on
from balloon_usd.solver.torn import Tear

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.plan import Plan
    from balloon_usd.plan.strip import Strip
    from balloon_usd.solver.hands import Hands
    from balloon_usd.solver.placement import Placed
    from balloon_usd.solver.scene import Scene
    from balloon_usd.solver.severed import Severed

Floats = NDArray[np.float32]

ALL = slice(None)
"""All that there is."""

ALONG = np.array([1.0, 0.0, 0.0])
"""Direction from the knot to the tip."""


class ComingFrame(NamedTuple):
    """The frame that is about to be simulated."""

    begin: float
    """When it begins, s."""
    end: float
    """When it ends, s."""
    middle: Floats
    """Where all rings of the scene are when it begins, (J, 3), m."""


class Sculpture:
    """A plan, its balloons in a scene, and the hands on them."""

    frame: ComingFrame
    """The frame that motions set goals for; none before the first."""

    placed: Placed | None = None
    """Where the frames show it, if not where it was made."""

    def __init__(self, plan: Plan, scene: Scene, hands: Hands, first_body: int) -> None:
        self.plan = plan
        self.severed: dict[str, Severed] = {}
        """What is being cut off or gone, by the names of bubbles."""
        self.scene = scene
        self.hands = hands
        self.body = {name: first_body + k for k, name in enumerate(plan.strips)}
        """Body of every balloon."""
        self.joints = self._joints()
        """Joint of the scene of every ring of the plan."""
        self.all_joints = np.array(self.joints, dtype=np.int64)
        self._ring_of = {joint: ring for ring, joint in enumerate(self.joints)}
        self.balloons = tuple(ring.balloon for ring in plan.table.rings)
        """Balloon of every ring."""
        rests = {strip.bubbles[-1].name for strip in plan.strips.values()}
        tops = _tops(plan)
        self._led = [
            ring.joint or ring.bubble in rests or k in tops for k, ring in enumerate(plan.table.rings)
        ]
        """Whether hands lead a ring when they carry what it is of: a joint, one in an open rest, or the
        middle of a bubble that closes on itself, without which it would roll about the balloon.
        """

    def _joints(self) -> list[int]:
        """Joint of every planned ring: a body's rings are its plan's, after its spare ones."""
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
    def unwinding(self) -> tuple[str, ...]:
        """Names of the joints that are coming undone."""
        return ()

    @property
    def undone(self) -> tuple[str, ...]:
        """Locks that have slipped and joints that have come undone so far."""
        return ()

    @property
    def bodies(self) -> Sequence[int]:
        """Bodies of all its balloons."""
        return tuple(self.body.values())

    def take_up(self) -> None:
        """Take the hands from what they only look after, before they begin something else."""

    def look_after(self, end: float, *, begun: bool) -> None:
        """Look after balloons that no hand holds in the frame that ends then (s); `begun`: whether hands
        begin something else in it.
        """

    def strip_of(self, ring: int) -> Strip:
        """Return the balloon of a ring of the plan."""
        return self.plan.strips[self.plan.table.rings[ring].balloon]

    def hanging_on(self, rings: Sequence[int]) -> list[list[int]]:
        """Return for each of some rings of the plan the joints by which hands lead what hangs on it, on all
        balloons.
        """
        return [
            [self.joints[ring] for ring in each if self._led[ring]] for each in self.rings_hanging_on(rings)
        ]

    def rings_hanging_on(self, rings: Sequence[int]) -> tuple[tuple[int, ...], ...]:
        """Return for each of some rings of the plan the rings that hang on it, on all balloons."""
        return hanging_on(tuple(rings), self.balloons, self.welds)

    @property
    def welds(self) -> tuple[tuple[int, ...], ...]:
        """Rings of the plan that are one joint by now."""
        ring_of, welds = self._ring_of, self.hands.welds_of(self.joints)
        return tuple([tuple([ring_of[joint] for joint in weld]) for weld in welds])

    def carry(self, rings: Sequence[int]) -> Carried:
        """Begin to lead what hangs on some rings of the plan: on the last one, which is held, it stays."""
        middle, hanging = self.frame.middle, self.hanging_on(rings)
        for joint in (joint for each in hanging for joint in each):
            self.hands.lead(joint, middle)
        moved = hanging[:-1]
        joints = np.array([joint for each in moved for joint in each], dtype=np.int64)
        by = np.repeat(np.arange(len(moved)), [len(each) for each in moved])
        return Carried(joints, by, middle[joints].astype(np.float64))

    @cached_property
    def parts(self) -> tuple[NDArray[np.int64], ...]:
        """Vertices, among its own, of every part that stays together where bubbles have torn."""
        start = int(self.vertices.start)
        found = []
        for part in parts_of(self.plan.recipe.piece):
            own = [self._stretch(*stretch) for stretch in part]
            found.append(np.concatenate(own) - start)
        return tuple(found)

    def _stretch(self, balloon: str, behind: str | None, before: str | None) -> NDArray[np.int64]:
        """Return the vertices of a balloon, in the scene, between the tears of two bubbles."""
        own = self.scene.vertices_of(self.body[balloon])
        first = own.start if behind is None else self._behind_tear(behind)
        last = own.stop if before is None else self._behind_tear(before)
        return np.arange(first, last)

    def _behind_tear(self, bubble: str) -> int:
        """Return the first vertex, in the scene, behind the middle of what is gone where a bubble tears."""
        body, faces = self.faces(bubble)
        rings = Tear.of(self.scene.bodies[body], faces).rings
        return int(self.scene.vertex_start[body]) + int(rings[len(rings) // 2].min())

    def outer_joints(self, part: NDArray[np.int64] | slice = ALL) -> NDArray[np.int64]:
        """Return the joints of what lies in no other balloon, of a part."""
        strips = self.plan.strips
        pairs = zip(self.joints, self.balloons, strict=True)
        found = [joint for joint, balloon in pairs if strips[balloon].inside is None]
        joints = np.array(found, dtype=np.int64)
        if isinstance(part, slice):
            return joints
        first = self.hands.rings[0][joints] - self.vertices.start
        return joints[np.isin(first, part)]

    @property
    def outer_vertices(self) -> NDArray[np.int64]:
        """Vertices of what lies in no other balloon, among its own."""
        outer = [self.body[name] for name, strip in self.plan.strips.items() if strip.inside is None]
        found: NDArray[np.int64] = np.r_[tuple(map(self.scene.vertices_of, outer))] - self.vertices.start
        return found

    @property
    def vertices(self) -> slice:
        """All its vertices in the scene."""
        start = self.scene.vertex_start
        return slice(int(start[self.bodies[0]]), int(start[self.bodies[-1] + 1]))

    def walls(self) -> NDArray[np.float64]:
        """Return where all its vertices are, (V, 3), m."""
        walls: NDArray[np.float64] = self.hands.places[self.vertices].astype(np.float64)
        start = self.scene.vertex_start[list(self.bodies)] - self.vertices.start
        for each in self.severed.values():
            # What lies behind it is of other balloons.
            each.stub.put(walls[start[each.balloon] :])
        return walls

    def centre(
        self, points: NDArray[np.float64], part: NDArray[np.int64] | slice = ALL
    ) -> NDArray[np.float64]:
        """Return the centre of the mass of a part, (3,), m; `points`: all its vertices, (V, 3), m."""
        middle: NDArray[np.float64] = points[part].mean(axis=0)
        return middle

    def ring_width(self, joint: int) -> float:
        """Return the mean distance of a ring's vertices from their middle, m."""
        first, n = (int(values[joint]) for values in self.hands.rings)
        ring = self.hands.places[first : first + n]
        return float(np.linalg.norm(ring - ring.mean(axis=0), axis=1).mean())

    def faces(self, bubble: str) -> tuple[int, NDArray[np.int64]]:
        """Return the body of a bubble, and its faces in order round each ring, numbered within the body.

        Raises:
            KeyError: no bubble of this name.
        """
        name, index = self.place(bubble)
        body = self.scene.bodies[self.body[name]]
        run = self._run(name, index)
        cap = (body.rings[0].around // 4) ** 2
        first = run.start + (cap if index + body.spare_segments == 0 else 0)
        last = run.stop - (cap if index == len(self.plan.strips[name].bubbles) - 1 else 0)
        return self.body[name], np.arange(first, last)

    def bubble_walls(self, bubble: str) -> NDArray[np.float64]:
        """Return where the vertices of a bubble are, (V, 3), m.

        Raises:
            KeyError: no bubble of this name.
        """
        name, index = self.place(bubble)
        run, body = self._run(name, index), self.body[name]
        corners = self.scene.bodies[body].quads[run.start : run.stop]
        own = np.unique(corners) + int(self.scene.vertex_start[body])
        walls: NDArray[np.float64] = self.hands.places[own].astype(np.float64)
        return walls

    def bubble_middle(self, bubble: str) -> NDArray[np.float64]:
        """Return the middle of the wall of a bubble, (3,), m.

        Raises:
            KeyError: no bubble of this name.
        """
        middle: NDArray[np.float64] = self.bubble_walls(bubble).mean(axis=0)
        return middle

    def place(self, bubble: str) -> tuple[str, int]:
        """Return the balloon of a bubble, and its number in it.

        Raises:
            KeyError: no bubble of this name.
        """
        for name, strip in self.plan.strips.items():
            for index, planned in enumerate(strip.bubbles):
                if planned.name == bubble:
                    return name, index
        raise KeyError(bubble)

    def _run(self, balloon: str, index: int) -> range:
        """Return the faces of a bubble, numbered within its body."""
        body = self.scene.bodies[self.body[balloon]]
        segment = index + body.spare_segments
        return range(body.segment_ends[segment - 1] if segment else 0, body.segment_ends[segment])


def _tops(plan: Plan) -> set[int]:
    """Return the rings of a plan in the middle of bubbles that close on themselves, if hands hold these."""
    closing = {kind for kind, operation in BY_KIND.items() if operation.closes and not operation.spreads}
    guides = [plan.table.guides(bubble.name) for bubble in plan.bubbles if bubble.kind in closing]
    return {each[len(each) // 2] for each in guides if each}
