"""Closing a bubble round the neck of another."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.gather import Gather
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, unit
from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

LAID = 0.5
"""Share of the time after which the row is laid back, and the chain begins to close."""
CLOSED = 0.8
"""Share after which the chain is closed, and held so."""
HOLDING = 15.0
"""Largest force of a hand on the sides of the chain, N: as on the row. Held with less, or spread until the
neck was in, more of sixteen came out again.
"""
CLEAR = 0.01
"""How far the neck is held off the wall of the chain before that, m."""
LAYING = 15.0
"""Largest force of a hand on a ring of the row, N: as of a limb that is aimed."""
HALVINGS = 40
"""Steps in which the angle of an arc is found."""
HIGH = 0.55
"""Where the neck lies in the hole, from the joint to the far end of the ring, as a share: in a ring of a tube
that fills its hole, from 0.35 to 0.7 hold.
"""
OUT = 0.2
"""How far the neck is led beyond the middle of the ring, in widths of the tube: what is behind it shall not
stay between the walls. Half as far, or twice, some of sixteen came out again.
"""
IN_HOLE = np.array([0.5 * (1.0 - HIGH), HIGH, 0.5 * (1.0 - HIGH)])
"""Shares of the three corners of the ring in that place."""


class Wrap(Gather):
    """A chain that is closed round a neck which hangs on its held end by a row of bubbles."""

    def __init__(self, move: moves.Wrap, sculpture: LatexSculpture) -> None:
        """Take hold of the chain, of the row and of all that hangs on both."""
        super().__init__(move, sculpture)
        hands, middle = self._hands, sculpture.frame.middle
        held = sculpture.joints[move.corners[-1]]
        self._led = np.array([sculpture.joints[ring] for ring in move.led], dtype=np.int64)
        self._row, self._point = move.row, np.array(move.point)
        self._held: Floats = middle[held].astype(np.float64)
        began: Floats = middle[self._led] - self._held
        steps = np.diff(began, axis=0, prepend=np.zeros((1, 3)))
        self._along: Floats = np.cumsum(np.linalg.norm(steps, axis=1))
        """Distances of these rings from the held joint along the row, (N,), m."""
        self._out: Floats = unit(began[move.row - 1])
        """Unit direction of the row before."""
        self._off: Floats = began - self._along[:, None] * self._out
        """How far these rings are off it, (N, 3), m."""
        self._tube = move.tube
        hands.lead_firmly(self._chain.cheeks.joints, HOLDING)
        along = float(np.cross(self._point, self._chain.closing.across(1.0)) @ ALONG)
        self._side = math.copysign(move.behind, move.behind * along)
        """On which side of the chain the row lies, seen from where this rises: 1 right of it, -1 left."""
        self._clear = 0.5 * move.tube + CLEAR
        """How far from the axis of the straight chain the neck is held, m."""
        for joint in self._led.tolist():
            hands.lead(joint, middle)
        hands.lead_firmly(self._led[: move.row], LAYING)
        beyond = sculpture.hanging_on((move.led[-1], move.corners[-1]))[0]
        self._beyond = np.array(sorted({*beyond} - set(self._led.tolist())), dtype=np.int64)
        self._hanging: Floats = middle[self._beyond] - middle[self._led[-1]]

    def advance(self, share: float) -> None:
        """Lay the row back, and close the chain round its neck."""
        laid, closed = smooth(share / LAID), smooth((share - LAID) / (CLOSED - LAID))
        pose = self._chain.pose(closed)
        self._hands.bring(pose)
        normal = self._side * np.cross(self._point, self._chain.closing.across(closed))
        off = (1.0 - closed) * self._clear * self._point + closed * OUT * self._tube * normal
        hole = IN_HOLE @ pose.corners - self._held - off
        places, ahead = self._places(hole, normal, laid)
        self._hands.goal[self._led] = self._held + places
        turn = turn_about(*turn_between(self._out, ahead))
        self._hands.goal[self._beyond] = self._held + places[-1] + self._hanging @ turn.T

    def _places(self, hole: Floats, normal: Floats, laid: float) -> tuple[Floats, Floats]:
        """Return where the rings of the row and behind it are, (N, 3), m, from the held joint, and the unit
        direction in which it leaves the hole, (3,).

        Args:
            hole: where the neck shall be, (3,), m, from the held joint.
            normal: unit direction across the chain, to the side on which the row lies.
            laid: how far it is laid back, from 0 to 1.
        """
        length = float(self._along[self._row - 1])
        chord = float(np.linalg.norm(hole))
        toward = hole / max(chord, 1e-9)
        aside = unit(normal - toward * float(normal @ toward))
        half = half_angle(chord / length)
        leaves = math.cos(half) * toward + math.sin(half) * aside
        axis, angle = turn_between(leaves, self._out)
        back = turn_about(axis, (1.0 - laid) * angle)
        # Of a polygon of short straight sides: each turned by the middle of its part of the arc.
        along = np.concatenate([[0.0], self._along[: self._row]])
        bends = laid * half * (along[1:] + along[:-1]) / length
        bends = np.append(bends, 2.0 * laid * half)[:, None]
        across = np.cross(np.cross(aside, toward), leaves)
        ways = np.cos(bends) * leaves + np.sin(bends) * across
        row = np.cumsum(np.diff(along)[:, None] * ways[:-1], axis=0)
        ahead = unit(back @ ((1.0 - laid) * ways[-1] - laid * normal))
        row = row @ back.T
        own = row[-1] + (self._along[self._row :] - length)[:, None] * ahead
        return np.concatenate([row, own]) + (1.0 - laid) * self._off, ahead


def half_angle(share: float) -> float:
    """Return half the angle (rad) of an arc whose chord is a share of its length."""
    low, high = 0.0, math.pi
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if math.sin(middle) > share * middle else (low, middle)
    return 0.5 * (low + high)
