"""Winding bubbles that lie side by side round each other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.latex.motions.beyond import vertices_at
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Complex = NDArray[np.complex128]

WINDING = 15.0
"""Largest force of a hand on a ring of a bubble that is wound, N: as of a limb that is aimed."""
ROLLED = 0.3
"""Share of its own twist by which a strand is rolled back in a frame."""
GATHERED = 0.3
"""Share of the way after which all strands lie beside each other."""
FLATTEST = 0.3
"""Least way along the axis of a piece of a strand, in its length."""


class WindRound(Motion):
    """Strands that are led onto helices about the line between their ends, one of which is held.

    What hangs on the other end is turned with it.
    """

    def __init__(self, move: moves.WindRound, sculpture: LatexSculpture) -> None:
        """Take hold of the strands and of all the rest."""
        self._move, self._sculpture, self._hands = move, sculpture, sculpture.hands
        self._share = 0.0
        """Share of its turns that are done."""
        hands, joints, middle = sculpture.hands, sculpture.joints, sculpture.frame.middle
        hands.touch(sculpture.bodies)
        # Struts would hold the pose against the hands, which hold all of it now.
        sculpture.struts.loosen(set(joints))
        strands, hanging = _from_the_held_end(move, sculpture)
        for joint in joints:
            hands.lead(joint, middle)
        for strand in strands:
            hands.grip(joints[strand[0]], middle)
        self._inside = [np.array([joints[r] for r in strand[1:-1]], dtype=np.int64) for strand in strands]
        ends = {joints[strand[-1]] for strand in strands}
        self._turned = np.array(sorted(ends | {joints[r] for r in hanging}), dtype=np.int64)
        for row in (*self._inside, self._turned):
            hands.lead_firmly(row, WINDING)
        self._turning = VertexSet.of(vertices_at(sculpture, hanging)) if hanging else None

        places = middle[[[joints[strand[k]] for strand in strands] for k in (0, -1)]].astype(np.float64)
        self._near, self._far = places.mean(axis=1)
        self._axis = unit(self._far - self._near)
        self._beside: Floats = middle[self._turned] - self._far
        across = _across(self._axis)
        self._across = across
        self._strands = []
        self._rolling = [
            VertexSet.of(_held_half(hands, joints[strand[0]], inside))
            for strand, inside in zip(strands, self._inside, strict=True)
        ]
        for inside in self._inside:
            row = np.concatenate([[self._near], middle[inside].astype(np.float64), [self._far]]) - self._near
            self._strands.append(_Strand(row @ self._axis, row @ across[0] + 1j * (row @ across[1])))

    def advance(self, share: float) -> None:
        """Wind as far as the time of the move that is over then asks, with ease in and out."""
        move, progress = self._move, smooth(share)
        rows = [strand.places(progress, math.tau * move.turns, move.radius) for strand in self._strands]
        length = float(np.mean([along[-1] for along, _ in rows]))
        for inside, (along, beside) in zip(self._inside, rows, strict=True):
            flat = beside.real[:, None] * self._across[0] + beside.imag[:, None] * self._across[1]
            place = self._near + (along * (length / along[-1]))[:, None] * self._axis + flat
            self._hands.goal[inside] = place[1:-1]
        far = self._near + length * self._axis
        turn = turn_about(self._axis, math.tau * move.turns * progress)
        self._hands.goal[self._turned] = far + self._beside @ turn.T
        if self._turning is not None:
            begin, end, _ = self._sculpture.frame
            rate = math.tau * move.turns * (progress - self._share) / (end - begin)
            self._hands.spin(self._turning, far, self._axis, rate)
        self._roll()
        self._share = progress
        if share >= 1.0:
            for bubble in move.bubbles:
                set_bend(self._sculpture.scene, *self._sculpture.faces(bubble))

    def _roll(self) -> None:
        """Roll each strand about itself where it is held, so that winding does not twist its own wall."""
        begin, end, middle = self._sculpture.frame
        for inside, rolling in zip(self._inside, self._rolling, strict=True):
            twisted = twist_of(middle[inside].astype(np.float64), self._first_corners(inside))
            near = inside[: max(2, len(inside) // 2)]
            way = middle[near[-1]].astype(np.float64) - middle[near[0]]
            point = middle[near].mean(axis=0, dtype=np.float64)
            self._hands.spin(rolling, point, unit(way), ROLLED * twisted / (end - begin))

    def _first_corners(self, rings: Ints) -> Floats:
        """Return where the first vertex of each of some rings is, (N, 3), m."""
        first, _ = self._hands.rings
        corners: Floats = self._hands.places[first[rings]].astype(np.float64)
        return corners


class _Strand:
    """Rings of a strand from its held end on: how far along the axis they lie, and how far beside it."""

    def __init__(self, along: Floats, beside: Complex) -> None:
        """Take them as they are, (N,) each, m; a complex number is a place in the plane across the axis."""
        self._beside = beside
        self._apart: Floats = np.hypot(np.diff(along), np.abs(np.diff(beside)))
        gone = np.cumsum(self._apart)
        self._shares: Floats = np.concatenate([[0.0], gone]) / gone[-1]
        middle = beside.sum()
        self._side = middle / max(abs(middle), 1e-9)

    def places(self, progress: float, angle: float, radius: float) -> tuple[Floats, Complex]:
        """Return how far along the axis and how far beside it its rings go, (N,) each, m.

        Args:
            progress: 0 where they were, 1 wound.
            angle: by which the far end is turned then, rad.
            radius: how far from the axis it lies at most then, m.
        """
        gathered = smooth(progress / GATHERED)
        close = np.minimum(np.abs(self._beside), radius) * self._side
        turn = progress * angle * self._shares
        beside = (self._beside + gathered * (close - self._beside)) * np.exp(1j * turn)
        # Between two places it goes round on an arc.
        aside = np.abs(np.diff(beside)) / np.sinc(np.diff(turn) / math.tau)
        steps = np.sqrt(np.maximum(self._apart**2 - aside**2, (FLATTEST * self._apart) ** 2))
        return np.concatenate([[0.0], np.cumsum(steps)]), beside


def _held_half(hands: LatexControls, joint: int, rings: Ints) -> Ints:
    """Return the vertices of a strand from next to the joint at its held end to the middle one of its rings:
    only its neck does not turn with them.
    """
    first, around = hands.rings
    middle = int(rings[max(1, len(rings) // 2 - 1)])
    if joint < middle:
        return np.arange(first[joint] + around[joint], first[middle] + around[middle])
    return np.arange(first[middle], first[joint])


def twist_of(middles: Floats, corners: Floats) -> float:
    """Return by what angle the last ring of a strand is turned against its first about the strand, rad, in a
    frame that is carried along its curve without turning (Bishop 1975).

    `middles`: of its rings; `corners`: one of each; (N, 3), m.
    """
    ways = np.diff(middles, axis=0)
    ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-9)[:, None]
    spokes = corners - middles
    total = 0.0
    for way, onward, spoke, other in zip(ways, ways[1:], spokes, spokes[1:], strict=False):
        carried = turn_about(*turn_between(way, onward)) @ spoke
        carried -= onward * float(carried @ onward)
        flat = other - onward * float(other @ onward)
        total += math.atan2(float(np.cross(carried, flat) @ onward), float(carried @ flat))
    return total


def _across(axis: Floats) -> Floats:
    """Return two unit vectors across an axis and each other, (2, 3), right-handed with it."""
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(axis, first)])


def _from_the_held_end(
    move: moves.WindRound, sculpture: LatexSculpture
) -> tuple[Sequence[tuple[int, ...]], tuple[int, ...]]:
    """Return the strands from the end on which more hangs, which is held, and the rings that hang on the
    other.
    """
    plan = sculpture.plan
    ends = move.strands[0][0], move.strands[0][-1]
    hanging = sculpture.rings_hanging_on(ends)

    def rubber(rings: tuple[int, ...]) -> float:
        guides = set(rings)
        return sum(each.rest_length for each in plan.bubbles if guides & set(plan.table.guides(each.name)))

    if rubber(hanging[0]) >= rubber(hanging[1]):
        return move.strands, hanging[1]
    return [strand[::-1] for strand in move.strands], hanging[0]
