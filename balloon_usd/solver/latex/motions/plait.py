"""Plaiting three bubbles that hang on one joint."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

PLAITING = 15.0
"""Largest force of a hand on a ring of a strand, N: as of a limb that is aimed."""
GATHERED = 0.15
"""Share of the time after which the strands lie beside each other."""
PLAITED = 0.85
"""Share after which all crossings are made, and their ends are brought together."""
ASIDE, OVER = 1.15, 0.66
"""How far a strand goes aside and over the others from the middle of the plait, in widths: where one crosses
another they are 1.73 `OVER` apart, and an outer strand is 0.87 `ASIDE` from the middle one.
"""
NEAR_END = 1.2
"""Length from an end at which the strands are as far apart as in the plait, in widths."""
FAN = 0.12
"""How much farther apart the free ends are held, for each width from the plait."""
TOGETHER = 0.1
"""What is left between the ends, as a share of how far they were apart."""
CYCLE = math.pi / 3.0
"""Phase between two crossings, rad."""
FITS = 12
"""Steps in which the length of the plait is found."""
PIECES = 600
"""Pieces of a curve along which it is measured."""


class Plait(Motion):
    """Strands whose free ends are led over each other in turns, and then together; what hangs on them goes
    along.
    """

    def __init__(self, move: moves.Plait, sculpture: LatexSculpture) -> None:
        """Take hold of the strands and of all the rest."""
        self._move, self._sculpture, self._hands = move, sculpture, sculpture.hands
        hands, joints, middle = sculpture.hands, sculpture.joints, sculpture.frame.middle
        hands.touch(sculpture.bodies)
        # Struts would hold the pose against the hands, which hold all of it now.
        sculpture.struts.loosen(set(joints))
        for joint in joints:
            hands.lead(joint, middle)
        strands = [[joints[ring] for ring in strand] for strand in move.strands]
        for strand in strands:
            hands.grip(strand[0], middle)
        self._base: Floats = middle[[strand[0] for strand in strands]].mean(axis=0, dtype=np.float64)
        began = [middle[strand].astype(np.float64) - self._base for strand in strands]
        self._frame = _frame(began)
        # From the left to the right: so none crosses another before the first crossing.
        order = np.argsort([float((row @ self._frame[1]).mean()) for row in began])
        self._rows = [np.array(strands[k][1:], dtype=np.int64) for k in order]
        self._began = [began[k][1:] for k in order]
        hanging = sculpture.hanging_on([move.strands[0][0], *(move.strands[k][-1] for k in order)])[1:]
        ends = [row[-1] for row in self._rows]
        self._hanging = [np.array(sorted({*each} - set(ends)), dtype=np.int64) for each in hanging]
        self._places = [middle[each].astype(np.float64) for each in self._hanging]
        for row in self._rows:
            hands.lead_firmly(row, PLAITING)
        lengths = [np.cumsum(np.linalg.norm(np.diff(began[k], axis=0), axis=1)) for k in order]
        self._pattern = Pattern(lengths, move.width, move.crossings)

    def advance(self, share: float) -> None:
        """Lay the strands beside each other, cross them one after another, and bring their ends together."""
        gathered = smooth(share / GATHERED)
        front = smooth((share - GATHERED) / (PLAITED - GATHERED))
        closed = smooth((share - PLAITED) / (1.0 - PLAITED))
        for k, (row, began) in enumerate(zip(self._rows, self._began, strict=True)):
            along, beside = self._pattern.places(k, front, closed)
            pose = np.stack([along, beside.real, beside.imag], axis=1) @ self._frame
            place = began + gathered * (pose - began)
            self._hands.goal[row] = self._base + place
            self._hands.goal[self._hanging[k]] = self._places[k] + (place[-1] - began[-1])
        if share >= 1.0:
            for bubble in self._move.bubbles:
                set_bend(self._sculpture.scene, *self._sculpture.faces(bubble))


class Pattern:
    """Curves of three strands, along a plait, aside and over it."""

    def __init__(self, lengths: list[Floats], width: float, crossings: int) -> None:
        """Take the distances of the rings of each strand from its held end, (N,), and the width of one, m."""
        self._lengths, self._width = lengths, width
        self._turn = CYCLE * crossings
        shortest = min(float(each[-1]) for each in lengths)
        self._long = shortest
        for _ in range(FITS):
            # As long as the strands that are bent to it.
            self._long *= shortest / self._arc(self._long)
        self._fine = np.linspace(0.0, 1.3 * max(float(each[-1]) for each in lengths), PIECES)

    def _arc(self, long: float) -> float:
        """Return the mean length of the strands of a plait of a length, m."""
        along = np.linspace(0.0, long, PIECES)
        beside = [self._beside(k, along, long, long, 0.0) for k in range(3)]
        step = along[1] - along[0]
        return float(np.mean([np.hypot(step, np.abs(np.diff(each))).sum() for each in beside]))

    def _beside(self, k: int, along: Floats, long: float, front: float, closed: float) -> Complex:
        """Return how far a strand is aside (real) and over (imaginary) at places along a plait, m."""
        phase = self._turn * np.minimum(along, front) / long + math.tau * (k - 1) / 3.0
        near, far = (_rising(each / (NEAR_END * self._width)) for each in (along, long - along))
        apart = near * (1.0 - closed * (1.0 - TOGETHER) * (1.0 - far))
        apart = apart * (1.0 + FAN * (1.0 - closed) * np.maximum(along - front, 0.0) / self._width)
        aside, over = ASIDE * np.sin(phase), OVER * np.sin(2.0 * phase)
        return np.asarray(self._width * apart * (aside + 1j * over), dtype=np.complex128)

    def places(self, k: int, front: float, closed: float) -> tuple[Floats, Complex]:
        """Return how far along the plait the rings of a strand are, and how far beside its middle, (N,), m.

        Args:
            k: number of the strand.
            front: share of the crossings that are made.
            closed: how far the ends are brought together.
        """
        beside = self._beside(k, self._fine, self._long, front * self._long, closed)
        steps = np.hypot(self._fine[1], np.abs(np.diff(beside)))
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        along = np.interp(self._lengths[k], arc, self._fine)
        return along, self._beside(k, along, self._long, front * self._long, closed)


def _rising(shares: Floats) -> Floats:
    """Return shares of 0 to 1, others cut off, as a curve that is level at both ends."""
    shares = np.clip(shares, 0.0, 1.0)
    return shares * shares * (3.0 - 2.0 * shares)


def _frame(began: list[Floats]) -> Floats:
    """Return the directions along a plait, aside and over it, (3, 3): strands lie side by side aside.

    `began`: places of each strand from its held end on, (N, 3), m.
    """
    ends = np.array([row[-1] for row in began])
    along = unit(ends.mean(axis=0))
    middles = np.array([row.mean(axis=0) for row in began])
    across = middles - middles.mean(axis=0)
    across -= (across @ along)[:, None] * along
    aside = np.linalg.svd(across)[2][0]
    aside = unit(aside - along * float(aside @ along))
    return np.array([along, aside, np.cross(along, aside)])
