"""The quality of one figure, out of its frames as they come."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.crossing_history import CrossingHistory
from balloon_usd.quality.joint_history import JointHistory
from balloon_usd.quality.joints import SLIPPED, lost_joints, unkept_joints
from balloon_usd.quality.measures import MEASURES, Verdict
from balloon_usd.quality.neck_reach import NeckReach
from balloon_usd.quality.passed import PassedBubbles
from balloon_usd.quality.ranking import excess
from balloon_usd.quality.rest import Rest
from balloon_usd.quality.standing import Standing
from balloon_usd.quality.symmetry import symmetry_of
from balloon_usd.quality.twists import TwistTails
from balloon_usd.quality.walls import walls_of
from balloon_usd.quality.wound import WoundBubbles
from balloon_usd.recipe.held_words import EVERY, PLANNED
from balloon_usd.solver.planned_gas import shares_of_planned_gas, squeezed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

BETWEEN_COUNTS = 0.5
"""Time between two frames in which crossings are counted over time, s: a count takes a writer as long as five
frames.
"""


class QualityWatch:
    """Takes the frames of one sculpture, each once; keeps a few numbers a bubble and the points of four."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], counted: Iterable[int] = ()) -> None:
        """Begin with nothing seen.

        Args:
            plan: of the sculpture.
            meshes: one a balloon, in the order of `Plan.strips`.
            counted: time codes of frames in which crossings are counted, besides the last one.
        """
        self._plan, self._meshes = plan, meshes
        self._counted = {*counted, plan.frame_count}
        self._walls = walls_of(plan, meshes)
        self._counter = CrossingCounter(self._walls, len(self._counted))
        self.crossings = CrossingHistory()
        """In those frames."""
        self._led_apart, self._led_frames = 0.0, 0
        """Farthest that a wall was led out of others in a frame, m, and in how many frames any was."""
        self._rest = Rest(plan)
        self._standing = Standing(plan, meshes)
        self._tails = TwistTails(plan, meshes)
        self._joints = JointHistory(plan, meshes)
        self._passed = PassedBubbles(plan, meshes)
        self._wound = WoundBubbles(plan, meshes)
        self._undone: dict[str, int] = {}
        """First time code at which each end of a joint had come undone."""
        self._end: Frame | None = None

    def add(self, frame: Frame) -> None:
        """Take the next frame; the last one must not be changed afterwards."""
        self._rest.add(frame)
        self._standing.add(frame)
        self._tails.add(frame)
        self._joints.add(frame)
        self._passed.add(frame)
        self._wound.add(frame)
        for name in (name for told in frame.undone for name in told.split(SLIPPED)):
            self._undone.setdefault(name, frame.time_code)
        if frame.shift is not None and (most := float(frame.shift.max(initial=0.0))) > 0.0:
            self._led_apart, self._led_frames = max(self._led_apart, most), self._led_frames + 1
        if frame.time_code in self._counted:
            slipped = any(SLIPPED in told for told in frame.undone)
            neck = self._walls.let_go(frame) if slipped else self._walls.held()
            self.crossings.add(frame.time_code, self._counter.count(frame.points, neck))
        if frame.time_code == self._plan.frame_count:
            self._end = frame

    def unkept(self) -> Iterator[str]:
        """Yield the joints that must hold by the recipe and have not, and when; none before the end."""
        if self._end is None:
            return
        for name, ends in unkept_joints(self._plan, self._meshes, self._end):
            code = self._told_undone(ends)
            when = "" if code is None else f" at {(code - 1) / self._plan.recipe.fps:.1f} s"
            yield f"{name} came undone{when}"

    def _told_undone(self, ends: Iterable[str]) -> int | None:
        """Return the first time code at which any of some ends of bubbles had come undone."""
        return min((self._undone[end] for end in ends if end in self._undone), default=None)

    def stuck_and_slipped(self) -> list[str]:
        """Return which bubbles that others must hold by the recipe have not come to there, or not stayed, and
        what helps; none before the end.
        """
        return [*self._passed.stuck(), *self._passed.slipped()] if self._contacts_must_hold else []

    def unwound(self) -> list[str]:
        """Return the bubbles that must stay wound round each other by the recipe and have not, and since
        when; none before the end.
        """
        return self._wound.unwound() if self._contacts_must_hold else []

    @property
    def _contacts_must_hold(self) -> bool:
        # Where a recipe names joints, only these must hold.
        return self._end is not None and self._plan.recipe.must_hold in (EVERY, PLANNED)

    def data(self) -> dict[str, Any] | None:
        """Return the quality as plain data, by the keys of `MEASURES`; None before the last frame."""
        if self._end is None:
            return None
        plan, meshes, end = self._plan, self._meshes, self._end
        found = {
            "gas": MEASURES["gas"].largest(_gas_off(plan, meshes, end)),
            "squeezed": MEASURES["squeezed"].largest(squeezed(plan, end)),
            "tail": MEASURES["tail"].largest(self._tails.off),
            **self._rest.results(),
            **self._standing.results(),
            "joints": self._lost_joints(end),
            "passed": self._passed.result(),
            "unwound": self._wound.result(),
            **self._crossings(end),
            **symmetry_of(plan, meshes, end),
        }
        off = [key for key in MEASURES if found[key]["verdict"] == Verdict.OFF]
        off.sort(key=lambda key: -excess(found[key]))
        verdict = Verdict.OFF if off else Verdict.GOOD
        return {"verdict": verdict.value, "off": off, **{key: found[key] for key in MEASURES}}

    def _lost_joints(self, end: Frame) -> dict[str, Any]:
        """Return the joints that were meant to hold and do not, and what has become of each."""
        meant, lost = lost_joints(self._plan, self._meshes, end)
        if not meant:
            return MEASURES["joints"].result(None)
        told = {"held": meant - len(lost), "meant": meant, "lost": lost, "undone": list(end.undone)}
        return MEASURES["joints"].result(len(lost), told | {"each": self._joints.each(self._told_undone)})

    def _crossings(self, end: Frame) -> dict[str, dict[str, Any]]:
        """Return the crossings of the last frame, and where there were most."""
        history = self.crossings
        found = history.frames[end.time_code]
        told = {
            "in_necks": found.in_necks,
            "bubbles": [{"pair": list(pair), "count": count} for pair, count in found.pairs.items()],
            "most": history.frames[history.worst].count,
            "most_at": history.worst,
            "led_apart": round(self._led_apart, 5),
            "led_frames": self._led_frames,
        }
        depth = self._counter.depth(end.points) if found.count else 0.0
        return {
            "crossings": MEASURES["crossings"].result(found.count, told),
            "depth": MEASURES["depth"].result(depth),
            "necks": self._necks(end) if found.in_necks else MEASURES["necks"].result(0.0),
        }

    def _necks(self, end: Frame) -> dict[str, Any]:
        """Return how far from its joint rubber of a neck goes through itself in the last frame."""
        found = NeckReach(self._plan, self._meshes).farthest(end, *self._counter.in_necks(end.points))
        if found is None:
            return MEASURES["necks"].result(0.0)
        return MEASURES["necks"].result(found.reaches, {"joint": found.joint, "away": round(found.away, 5)})


def counted_over_time(plan: Plan, codes: range) -> list[int]:
    """Return those of some time codes at which crossings are counted to be told over time."""
    every = max(round(BETWEEN_COUNTS * plan.recipe.fps), 1)
    return [*codes[::every], codes[-1]]


def _gas_off(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> dict[str, float]:
    """Return by which share of it the gas of each bubble differs from the plan, by name."""
    return {name: share - 1.0 for name, share in shares_of_planned_gas(plan, meshes, frame).items()}
