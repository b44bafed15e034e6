"""Bubbles that were brought into rings of others: do they stay there?"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.language.joint import Joint
from balloon_usd.operations.moves import PassThrough
from balloon_usd.quality.joints import SLIPPED
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.ring_corners import RingCorners

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

WHOLE = 4.0 * math.pi
"""Solid angle round a point, sr: by so much that of a ring changes for a point that goes all through it."""
INSIDE = 0.5
"""Share of that at which the middle of a bubble is in the plane of the ring."""


class PassedBubbles:
    """Takes the frames of one sculpture; follows the middle of each bubble on its way through its ring.

    Left out is what is popped later, and what lies in a ring that is opened as planned.
    """

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out what to look at; one mesh a balloon, in the order of `Plan.strips`."""
        self._fps = plan.recipe.fps
        piece = plan.recipe.piece
        held = piece.after(len(plan.recipe.steps), without=plan.slipping).gripped() - piece.popped
        rings = {contact.bubble: contact.others for contact in piece.contacts}
        self._followed = [
            _Followed(plan, meshes, move, rings[move.bubble])
            for move in plan.choreography.moves
            if isinstance(move, PassThrough) and move.bubble in held
        ]

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        undone = {name for told in frame.undone for name in told.split(SLIPPED)}
        for each in self._followed:
            each.add(frame, undone)

    def stuck(self) -> list[str]:
        """Return the bubbles that have not come into their rings."""
        return [each.name for each in self._followed if each.out is not None and not each.inside]

    def slipped(self) -> list[str]:
        """Return which bubbles have come into their rings and not stayed there, and since when."""
        return [
            f"{each.name} slipped out of its ring at {(each.out - 1) / self._fps:.1f} s"
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


class _Followed:
    """The middle of one bubble, and the ring that it passes."""

    def __init__(
        self, plan: Plan, meshes: Sequence[BalloonMesh], move: PassThrough, ring: Sequence[str]
    ) -> None:
        self._rings = [RingCorners.of(plan, meshes, at) for at in (move.middle, *move.opening)]
        """That of the middle of the bubble, and those of the ring that it passes."""
        self._ends = {str(Joint(name, end)) for name in ring for end in ("start", "end")}
        """Joints without which the ring is open."""
        fps = plan.recipe.fps
        # The time of a frame is (code - 1) / fps.
        self._first, self._last = 1 + math.floor(move.start * fps), 1 + math.ceil(move.end * fps)
        self.name = move.bubble
        self._begun = self._before = 0.0
        self.inside = False
        """Whether it has been in its ring."""
        self.out: int | None = None
        """Time code since which it is not in its ring, once it should be."""

    @property
    def share(self) -> float:
        """How far it has gone through: a half is in the plane of the ring."""
        return abs(self._before - self._begun) / WHOLE

    def add(self, frame: Frame, undone: set[str]) -> None:
        """Take the next frame; `undone`: all joints that have come undone by then."""
        code = frame.time_code
        if code < self._first:
            return
        middle, *ring = (each.places(frame).mean(axis=0) for each in self._rings)
        angle = solid_angle(middle, np.array(ring))
        if code == self._first:
            self._begun = self._before = angle
        # Known but for whole spheres: no bubble goes through half of a ring in one frame.
        self._before += math.remainder(angle - self._before, WHOLE)
        self.inside |= self.share > INSIDE
        if code < self._last:
            return
        if self.share > INSIDE and self._ends.isdisjoint(undone):
            self.out = None
        elif self.out is None:
            self.out = code


def solid_angle(place: Floats, ring: Floats) -> float:
    """Return the solid angle (sr), signed by the side, under which a place, (3,) m, sees a ring through
    places, (N, 3) m: of the triangles from its centre (Van Oosterom & Strackee 1983).
    """
    a = ring.mean(axis=0) - place
    b, c = ring - place, np.roll(ring, -1, axis=0) - place
    la, lb, lc = float(np.linalg.norm(a)), np.linalg.norm(b, axis=1), np.linalg.norm(c, axis=1)
    volume = np.cross(b, c) @ a
    rest = la * lb * lc + (b @ a) * lc + np.einsum("ni,ni->n", b, c) * la + (c @ a) * lb
    return float(2.0 * np.arctan2(volume, rest).sum())
