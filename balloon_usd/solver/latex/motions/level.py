"""Bending the legs of a finished figure until all its feet stand on one plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.led_limb import LedLimb, hold_figure, leave_figure
from balloon_usd.solver.levelling import TOUCHES, Feet, feet_of, levelling_turns
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.set_down import DOWN, facing_turn
from balloon_usd.solver.motions.smooth import round_at, smooth
from balloon_usd.solver.placement import turn_about, turn_between
from balloon_usd.solver.resting import standing_direction
from balloon_usd.solver.rotations import rotation

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

ROUNDS = 3
"""How often hands bend the legs and let go: a foot of a dog that was set straight stands 0.3 mm off the
ground after the second, 0.1 after the third.
"""
BENDING = 0.6
"""Share of a round in which they bend; in what is left it springs back."""
NEARLY = 0.012
"""Height up to which one nearly does that is like one which touches it, m: feet of dogs lie 4 mm apart."""
EVEN = 2.0e-5
"""Unevenness of feet with which hands leave it, m."""
FEWEST = 4
"""Feet of which one may stand off the ground."""
AS_LONG = 0.05
"""Share by which bubbles that are like each other may differ in length."""


class Level(Motion):
    """Hands that hold a figure and bend its legs, each about the joint on which it hangs."""

    def __init__(self, move: moves.Level, sculpture: LatexSculpture) -> None:
        """See on what it would stand."""
        self._sculpture = sculpture
        self._round = -1
        self._bent: list[tuple[LedLimb, Floats]] = []
        """Legs that are being bent, and how far each turns, (3,), rad."""
        points = sculpture.walls()
        facing = facing_turn(move, sculpture, points)
        arms = (points - sculpture.centre(points)) @ facing.T
        down = standing_direction(arms, np.zeros(3), DOWN)
        self._standing = turn_about(*turn_between(down, DOWN)) @ facing
        turned = {name: points @ self._standing.T for name, points in _walls(sculpture).items()}
        self._feet = feet_of(turned, _alike(sculpture), TOUCHES, NEARLY)
        piece = sculpture.plan.recipe.piece
        limbs = [piece.limb(foot) for foot in self._feet]
        found = list(dict.fromkeys(limb for limb in limbs if limb is not None))
        self._legs = [LedLimb(sculpture, piece, limb) for limb in found]
        self._of = [-1 if limb is None else found.index(limb) for limb in limbs]
        """Leg of every foot, -1 for none."""

    def advance(self, share: float) -> None:
        """Bend the legs on, or let go of them for a look."""
        number, share = round_at(share, ROUNDS)
        if number > self._round:
            self._round = number
            self._begin()
        if share > BENDING:
            self._let_go()
        for leg, turn in self._bent:
            leg.turn(rotation(smooth(share / BENDING) * turn))

    def _begin(self) -> None:
        """Look at the feet, and take hold of the legs and of all the rest."""
        sculpture = self._sculpture
        if len(self._feet) < FEWEST or not self._legs or sculpture.unwinding:
            return
        walls = [sculpture.bubble_walls(name) for name in self._feet]
        feet = Feet.on_plane(walls, self._standing)
        if float(np.abs(feet.height).max()) < EVEN:
            return
        bases = np.array([leg.base for leg in self._legs])
        turns = levelling_turns(walls, self._of, bases, feet.turn)
        hold_figure(sculpture)
        for leg in self._legs:
            leg.take()
        self._bent = list(zip(self._legs, turns, strict=True))

    def _let_go(self) -> None:
        if self._bent:
            self._sculpture.hands.let_go(self._sculpture.all_joints)
            leave_figure(self._sculpture)
        self._bent = []


def _walls(sculpture: LatexSculpture) -> dict[str, Floats]:
    """Return the vertices of every bubble that has gas, (V, 3), m."""
    names = [bubble.name for bubble in sculpture.plan.bubbles if bubble.name not in sculpture.friction.popped]
    return {name: sculpture.bubble_walls(name) for name in names}


def _alike(sculpture: LatexSculpture) -> list[frozenset[str]]:
    """Return groups of bubbles of one length that meet in a joint."""
    length = {bubble.name: bubble.length for bubble in sculpture.plan.bubbles}
    groups = []
    for ends in sculpture.plan.recipe.piece.joints:
        names = sorted({end.bubble for end in ends})
        for name in names:
            near = AS_LONG * length[name]
            groups.append(frozenset(other for other in names if abs(length[other] - length[name]) <= near))
    return groups
