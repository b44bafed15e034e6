"""Bending the legs of a finished figure until all its feet stand on one plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.motions.aim import TURNING
from balloon_usd.solver.levelling import Feet, feet_of, levelling_turns
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.set_down import DOWN
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, turn_facing
from balloon_usd.solver.resting import standing_direction

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations import moves
    from balloon_usd.operations.workpiece import Limb
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

ROUNDS = 2
"""How often hands bend the legs and let go: of 3.7 mm by which a foot of a dog stood off the ground 0.2 are
left after the first, and 0.05 after the second.
"""
BENDING = 0.6
"""Share of a round in which they bend; in what is left it springs back."""
TOUCHES = 5.0e-4
"""Height up to which a bubble touches the ground, m."""
NEARLY = 0.012
"""Height up to which one nearly does that is like one which touches it, m: feet of dogs lie 4 mm apart."""
EVEN = 2.0e-5
"""Unevenness of feet with which hands leave it, m."""
FEWEST = 4
"""Feet of which one may stand off the ground."""
AS_LONG = 0.05
"""Share by which bubbles that are like each other may differ in length."""


class _Bent(NamedTuple):
    """A leg that is being bent."""

    joints: NDArray[np.int64]
    """By which it is led, (N,), of the scene."""
    base: Floats
    """Where the joint is on which it hangs, (3,), m."""
    began: Floats
    """Where its joints were, away from that, (N, 3), m."""
    turn: Floats
    """By how much it turns, (3,), rad."""


class Level(Motion):
    """Hands that hold a figure and bend its legs, each about the joint on which it hangs."""

    def __init__(self, move: moves.Level, sculpture: LatexSculpture) -> None:
        """Begin with the first round."""
        self._move, self._sculpture, self._hands = move, sculpture, sculpture.hands
        self._bent: list[_Bent] = []
        self._round = -1
        self._standing = _standing(move, sculpture)
        walls = _walls(sculpture)
        turned = {name: points @ self._standing.T for name, points in walls.items()}
        self._feet = feet_of(turned, _alike(sculpture), TOUCHES, NEARLY)
        limbs = [sculpture.plan.recipe.piece.limb(foot) for foot in self._feet]
        self._legs = list(dict.fromkeys(limb for limb in limbs if limb is not None))
        self._of = [-1 if limb is None else self._legs.index(limb) for limb in limbs]
        """Leg of every foot, -1 for none."""

    def advance(self, share: float) -> None:
        """Bend the legs on, or let go of them for a look."""
        number, share = divmod(min(ROUNDS * share, ROUNDS - 1e-9), 1.0)
        if number > self._round:
            self._round = int(number)
            self._bent = self._begin()
        if share > BENDING:
            self._let_go()
        for leg in self._bent:
            if (angle := float(np.linalg.norm(leg.turn))) > 0.0:
                turned = turn_about(leg.turn / angle, smooth(share / BENDING) * angle)
                self._hands.goal[leg.joints] = leg.base + leg.began @ turned.T

    def _begin(self) -> list[_Bent]:
        """See on what it would stand, and take hold of its legs and of all the rest."""
        sculpture, hands = self._sculpture, self._hands
        if len(self._feet) < FEWEST or not self._legs or sculpture.unwinding is not None:
            return []
        walls = [sculpture.bubble_walls(name) for name in self._feet]
        feet = Feet.on_plane(walls, self._standing)
        if float(np.abs(feet.height).max()) < EVEN:
            return []
        middle = sculpture.frame.middle
        held = [_held(sculpture, leg)[0] for leg in self._legs]
        turns = levelling_turns(walls, self._of, middle[held].astype(np.float64), feet.turn)
        hands.touch(sculpture.bodies)
        # Struts would hold the pose against the hands, which hold all of it now.
        sculpture.struts.loosen(set(sculpture.joints))
        for joint in sculpture.joints:
            hands.lead(joint, middle)
        bent = []
        for leg, base, turn in zip(self._legs, held, turns, strict=True):
            joints = np.array(_outer(sculpture, leg), dtype=np.int64)
            hands.grip(base, middle)
            hands.lead_firmly(joints, TURNING)
            at = middle[base].astype(np.float64)
            bent.append(_Bent(joints, at, middle[joints] - at, turn))
        return bent

    def _let_go(self) -> None:
        if self._bent:
            sculpture = self._sculpture
            self._hands.let_go(sculpture.all_joints)
            sculpture.struts.hold(sculpture.friction.pairs(self._hands))
            self._hands.lay(list(sculpture.bodies))
        self._bent = []


def _standing(move: moves.Level, sculpture: LatexSculpture) -> Floats:
    """Return the turn (3, 3) after which a figure stands."""
    points = sculpture.walls()
    facing = turn_facing(move.front, move.top, points.mean(axis=0), sculpture.bubble_middle)
    arms = (points - sculpture.centre(points)) @ facing.T
    down = standing_direction(arms, np.zeros(3), DOWN)
    return turn_about(*turn_between(down, DOWN)) @ facing


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


def _held(sculpture: LatexSculpture, limb: Limb) -> Sequence[int]:
    """Return the joints of the scene that are the one on which a limb hangs."""
    rings = map(sculpture.plan.table.joint, sculpture.plan.recipe.piece.joint(limb.joint))
    return [sculpture.joints[ring] for ring in rings if ring is not None]


def _outer(sculpture: LatexSculpture, limb: Limb) -> list[int]:
    """Return the joints of the scene by which a limb is led, without that on which it hangs."""
    table, joints = sculpture.plan.table, sculpture.joints
    rings = [ring for bubble in limb.bubbles for ring in (*table.ends(bubble), *table.guides(bubble))]
    return sorted({joints[ring] for ring in rings if ring is not None}.difference(_held(sculpture, limb)))
