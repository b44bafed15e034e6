"""Bubbles that were brought into rings of others: do they stay there?"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import ends_of
from balloon_usd.operations.loop_holes import is_too_wide
from balloon_usd.operations.moves import PassThrough, Tuck, Wrap
from balloon_usd.quality.astride import ASTRIDE, Tube, share_between, share_in_hole
from balloon_usd.quality.joints import SLIPPED
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.solid_angle import WHOLE, solid_angles
from balloon_usd.quality.wall_rings import WallRings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

INSIDE = 0.5
"""Share of that at which the middle of a bubble is in the plane of the ring."""
LINKED = 0.3
"""Share of it by which what is before a neck and what is behind it see a ring differently in which the neck
lies: 0.64 to 1.09 in 42 simulations, and below 0.1 in 8 in which it does not.
"""
FAR = 0.15
"""Share of it by which that of a ring changes in a frame from which on it is followed between frames, too."""
BETWEEN = 16
"""Steps in which that is done, as if all went straight."""
COLUMNS = 4
"""Lines along the wall of such a ring that are taken for it: the middles of a dented tube are no ring."""
FINE = 4
"""Places from one ring of the mesh to the next at which that is done."""


class PassedBubbles:
    """Takes the frames of one sculpture; follows what goes through rings, and necks in them.

    Left out is what is popped later, and what lies in a ring that is opened as planned.
    """

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out what to look at; one mesh a balloon, in the order of `Plan.strips`."""
        self._fps = plan.recipe.fps
        popped = plan.recipe.piece.popped
        holding = (each for each in plan.piece_let_go.holding() if each.bubble not in popped)
        rings = {(each.step, each.bubble): each.others for each in holding}
        self._followed: list[_Followed] = []
        for move in plan.choreography.moves:
            if not isinstance(move, (PassThrough, Tuck, Wrap)):
                continue
            ring = rings.get((move.step, move.bubble))
            if ring is None:
                continue
            if isinstance(move, PassThrough):
                self._followed.append(_Passing(plan, meshes, move, ring))
            elif isinstance(move, Wrap):
                self._followed.append(_Wrapped(plan, meshes, move, ring))
            else:
                self._followed.append(_Tucked(plan, meshes, move))

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        undone = {name for told in frame.undone for name in told.split(SLIPPED)}
        for each in self._followed:
            each.add(frame, undone)

    def stuck(self) -> list[str]:
        """Return which bubbles have not come to where others would hold them, and what helps."""
        return [each.stuck for each in self._followed if each.out is not None and not each.inside]

    def slipped(self) -> list[str]:
        """Return which bubbles have come there and not stayed, since when, and what helps."""
        return [
            each.slipped_at((each.out - 1) / self._fps)
            for each in self._followed
            if each.out is not None and each.inside
        ]

    def result(self) -> dict[str, Any]:
        """Return how many are not in their rings, once the last frame is taken."""
        if not self._followed:
            return MEASURES["passed"].result(None)
        out = [each.name for each in self._followed if each.out is not None]
        through = {each.name: round(each.share, 3) for each in self._followed}
        return MEASURES["passed"].result(len(out), {"slipped": out, "through": through})


class _Followed(ABC):
    """One bubble, and the ring that holds it."""

    inside_from: float
    """Share beyond which it is in its ring."""
    seen_before: bool
    """Whether its way into the ring is followed, too."""
    into, out_of = "into its ring", "out of its ring"
    """Where it comes, and from where it slips, in words."""
    if_stuck = "make the bubble smaller or the ring larger"
    if_slipped = "make the ring smaller or the bubble larger"
    share: float = 0.0
    """How far it is through its ring."""

    def __init__(self, fps: float, move: PassThrough | Wrap | Tuck, ring: Sequence[str]) -> None:
        self._ends = {str(end) for name in ring for end in ends_of(name)}
        """Joints without which the ring is open."""
        # The time of a frame is (code - 1) / fps.
        self._first, self._last = 1 + math.floor(move.start * fps), 1 + math.ceil(move.end * fps)
        self.name = move.bubble
        self.inside = False
        """Whether it has been in its ring."""
        self.out: int | None = None
        """Time code since which it is not in its ring, once it should be."""

    def add(self, frame: Frame, undone: set[str]) -> None:
        """Take the next frame; `undone`: all joints that have come undone by then."""
        code = frame.time_code
        if code < (self._first if self.seen_before else self._last):
            return
        self.share = self._look(frame)
        self.inside |= self.share > self.inside_from
        if code < self._last:
            return
        if self.share > self.inside_from and self._ends.isdisjoint(undone):
            self.out = None
        elif self.out is None:
            self.out = code

    @property
    def stuck(self) -> str:
        """Say that it has not come to where others would hold it, and what helps."""
        return f"{self.name} did not come {self.into}: {self.if_stuck}"

    def slipped_at(self, seconds: float) -> str:
        """Say that it has slipped out of there at a time (s), and what helps."""
        return f"{self.name} slipped {self.out_of} at {seconds:.1f} s: {self.if_slipped}"

    @abstractmethod
    def _look(self, frame: Frame) -> float:
        """Return how far it is through its ring in the next frame."""


class _Passing(_Followed):
    """A ring of one bubble, and the ring that it passes: a half is in the plane of that."""

    inside_from = INSIDE
    seen_before = True

    def __init__(
        self, plan: Plan, meshes: Sequence[BalloonMesh], move: PassThrough, ring: Sequence[str]
    ) -> None:
        super().__init__(plan.recipe.fps, move, ring)
        self._rings = [RingCorners.of(plan, meshes, at) for at in (move.watched, *move.opening)]
        """That of the bubble, and those of the ring that it passes."""
        self._places: Floats | None = None
        """Their middles in the frame before, (N, 3), m."""
        self._angle = 0.0
        """The solid angle of the ring in it, sr."""
        self._changed = 0.0
        """How far that has changed, sr."""

    def _look(self, frame: Frame) -> float:
        places = np.array([each.places(frame).mean(axis=0) for each in self._rings])
        angle = _angle(places)
        if self._places is None:
            self._places, self._angle = places, angle
        # Each step is known but for whole spheres.
        step = math.remainder(angle - self._angle, WHOLE)
        if abs(step) > FAR * WHOLE:
            shares = np.linspace(0.0, 1.0, BETWEEN + 1)[:, None, None]
            angles = map(_angle, self._places + shares * (places - self._places))
            step = sum(math.remainder(there - here, WHOLE) for here, there in pairwise(angles))
        self._changed += step
        self._places, self._angle = places, angle
        return abs(self._changed) / WHOLE


def _angle(places: Floats) -> float:
    """Return the solid angle (sr) of a ring, all places but the first of these, (N, 3), m, from that."""
    return float(solid_angles(places[:1], places[1:])[0])


class _Wrapped(_Followed):
    """A neck between two bubbles, and the bubble that is closed round it: so far the one behind the neck sees
    the ring from the other side than the one before it.
    """

    inside_from = LINKED
    seen_before = False

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], move: Wrap, ring: Sequence[str]) -> None:
        super().__init__(plan.recipe.fps, move, ring)
        rings = plan.table.rings
        bubbles = {each.name: each for each in plan.bubbles}
        before, behind = bubbles[rings[move.neck].bubble], bubbles[move.bubble]
        self._balloon = list(plan.strips).index(behind.balloon)
        mesh = meshes[self._balloon]
        self._mesh = mesh
        ends = (rings[move.corners[0]].along, rings[move.corners[-1]].along)
        self._ring = mesh.rings_between(*ends)
        middles = (0.5 * (each.rest_start + each.rest_end) for each in (before, behind))
        self._strand = mesh.rings_between(*middles)

    def _look(self, frame: Frame) -> float:
        points = frame.points[self._balloon].astype(np.float64)
        strand = np.array([self._corners(points, ring).mean(axis=0) for ring in self._strand])
        fine = np.concatenate([strand[:-1] + k / FINE * np.diff(strand, axis=0) for k in range(FINE)], axis=1)
        way = fine.reshape(-1, 3)
        wall = np.array([self._corners(points, ring) for ring in self._ring])
        found = []
        for column in range(0, self._mesh.around, max(self._mesh.around // COLUMNS, 1)):
            steps = np.diff(solid_angles(way, wall[:, column]))
            found.append(float((np.remainder(steps + 0.5 * WHOLE, WHOLE) - 0.5 * WHOLE).sum()))
        return abs(float(np.median(found))) / WHOLE

    def _corners(self, points: Floats, ring: int) -> Floats:
        """Return the corners of a ring of the mesh, (N, 3), m."""
        first = int(self._mesh.ring_start[ring])
        return points[first : first + self._mesh.around]


class _Tucked(_Followed):
    """A bubble that is set between two others, or into the hole of a loop."""

    inside_from = ASTRIDE
    seen_before = False

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], move: Tuck) -> None:
        super().__init__(plan.recipe.fps, move, ())
        bubbles = {each.name: each for each in plan.bubbles}
        names = (move.bubble, *move.between)
        self._walls = [WallRings.of(plan, meshes, bubbles[name]) for name in names]
        between = all_of(move.between)
        if len(move.between) == 1:
            self.into, self.out_of = f"into {between}", f"out of {between}"
            loop, limb = bubbles[move.between[0]], bubbles[move.bubble]
            wide, width = (2.0 * plan.strips[each.balloon].inflated_radius for each in (loop, limb))
            self.if_stuck = self.if_slipped = "make the loop longer or the bubble shorter"
            if is_too_wide(loop.length, wide, width, looped=limb.looped):
                self.if_slipped = "make the loop shorter, its hole is as wide as the bubble"
        else:
            self.into, self.out_of = f"between {between}", f"from between {between}"
            self.if_stuck = self.if_slipped = "make it reach farther, or bring them nearer to its joint"

    def _look(self, frame: Frame) -> float:
        own, *sides = (Tube.of(wall.corners(frame)) for wall in self._walls)
        return share_between(own, *sides) if len(sides) > 1 else share_in_hole(own, *sides)
