"""Leading a balloon in from where it lay to the figure."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations import moves
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.opening import MIRRORED, fit
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.motions.way_in import way_in

if TYPE_CHECKING:
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]

BETWEEN = (0.0, 1.0 / 3.0, 2.0 / 3.0)
"""Places from one ring to the next that are looked at, as shares."""


STIFF = 4
"""Fewest joints that tell how a net lies in space."""
NEAR = 0.04
"""Mean distance of joints from their places in a net within which it has its shape, m."""


class LeadIn(Motion):
    """A balloon on its way in, led by its joints with all that is joined to it; the figure is held still."""

    def __init__(self, move: moves.LeadIn, sculpture: Sculpture) -> None:
        """Take hold of the figure, and find a clear way."""
        self._hands = hands = sculpture.hands
        self._sculpture, self._ring = sculpture, move.ring
        self._joint, middle = sculpture.joints[move.ring], sculpture.frame.middle
        held = sculpture.joints[move.to]
        hands.touch(sculpture.bodies)
        hands.grip(held, middle)
        ends = move.ring, move.to
        self._still = np.array(sculpture.hanging_on(ends)[1], dtype=np.int64)
        """Joints of the figure by which hands hold it still."""
        for joint in self._still.tolist():
            hands.lead(joint, middle)
        self._coming = {move.ring, *sculpture.rings_hanging_on(ends)[0]}
        """Rings of the plan that come in."""
        others = set(range(len(sculpture.joints))) - self._coming
        coming, lying = (_along(sculpture, rings) for rings in (self._coming, others))
        begin, end = middle[[self._joint, held]].astype(np.float64)
        toward, done = _toward(move, sculpture), not self._worked_on(move.end)
        self._way = way_in(begin, end, coming, lying, toward, done=done)
        self._take()

    def _worked_on(self, since: float) -> bool:
        """Whether more is twisted off what comes in, from a time on (s)."""
        made = self._sculpture.plan.choreography.moves
        later = [move for move in made if isinstance(move, moves.Pinch) and move.start >= since]
        return not self._coming.isdisjoint(move.ring for move in later)

    def _take(self) -> None:
        """Take hold of what comes in."""
        hands, middle = self._hands, self._sculpture.frame.middle
        hands.grip(self._joint, middle)
        hanging = self._sculpture.hanging_on((self._ring,))[0]
        closed = [joint for joint in hanging if hands.radius_goal[joint] > 0.0]
        for joint in closed:
            hands.lead(joint, middle)
        self._led = np.array([self._joint, *closed], dtype=np.int64)
        self._began = middle[self._led].astype(np.float64)

    def _lead(self, progress: float) -> None:
        """Lead it a share of its way in the coming frame: not turned, for a bubble goes as its joints do."""
        self._hands.goal[self._led] = self._began + self._way.place(progress) - self._way.begin

    def _leave(self) -> None:
        """Take the hands from all of it but its joint, which follows that as it is brought to the figure."""
        self._hands.let_go(self._led[1:])

    def advance(self, share: float) -> None:
        """Lead it a share of its way, and let all but the two joints give way in the end."""
        self._lead(smooth(share))
        if share >= 1.0:
            self._hands.let_go(self._still)
            self._leave()


def _toward(move: moves.LeadIn, sculpture: Sculpture) -> Floats | None:
    """Return where from the held ring what comes in will lie in the net, (3,), m; None where that is not told
    by what is made of the net.
    """
    if len(move.rings) < STIFF:
        return None
    here = sculpture.frame.middle[[sculpture.joints[ring] for ring in move.rings]].astype(np.float64)
    places = np.array(move.places)
    fits = [(mirror, *fit(places * mirror, here)) for mirror in (np.ones(3), MIRRORED)]
    mirror, turned, far = min(fits, key=lambda each: each[2])
    return np.asarray(np.array(move.toward) * mirror @ turned.T) if far < NEAR * len(here) else None


def _along(sculpture: Sculpture, rings: set[int]) -> Floats:
    """Return points along the bubbles between some rings of the plan, (N, 3), m."""
    middle = sculpture.frame.middle[sculpture.all_joints].astype(np.float64)
    chosen = sorted(rings)
    points = [middle[chosen]]
    for one, other in pairwise(chosen):
        if sculpture.balloons[one] == sculpture.balloons[other]:
            points += [middle[one] + share * (middle[other] - middle[one]) for share in BETWEEN[1:]]
    return np.vstack(points)
