"""Holding a short or soft bubble at its length while its neck closes, and pushing out the gas that it must
not keep.

Open to the tube, and with its first neck free to slide, so short a bubble runs empty; so does one that what
lies beside it presses harder than the tube does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.plan.strip import PlannedBubble
    from balloon_usd.solver.latex.sculpture import LatexSculpture

HELD = 1.2
"""Length below which bubbles do not find their gas by themselves, in lengths of the shortest stable one."""


def shut_in(sculpture: LatexSculpture, ring: int) -> Sequence[PlannedBubble]:
    """Return the bubbles between the last neck that is shut and a ring of the plan, one but for both halves
    of an ear.
    """
    _, at = sculpture.place(sculpture.plan.table.rings[ring].bubble)
    before = sculpture.hands.beside[sculpture.joints[ring], 0]
    first, _ = sculpture.hands.chambers()
    return sculpture.strip_of(ring).bubbles[max(at - int(before - first[before]), 0) : at + 1]


def is_held(sculpture: LatexSculpture, ring: int, bubbles: Sequence[PlannedBubble]) -> bool:
    """Tell whether bubbles before a ring of the plan have to be held while the ring closes."""
    strip = sculpture.strip_of(ring)
    short = {strip.bubbles[k].name for k in strip.balls(HELD)}
    return any(bubble.name in short or bubble.gas < 1.0 for bubble in bubbles)


class SqueezedBall:
    """A short or soft bubble between two necks that hands bring to its length while the second one closes."""

    def __init__(self, sculpture: LatexSculpture, ring: int, bubbles: Sequence[PlannedBubble]) -> None:
        """Take hold of its first neck, and of what hangs on it; `bubbles`: what will be made of it."""
        self._sculpture, hands, middle = sculpture, sculpture.hands, sculpture.frame.middle
        self._hands, self._length = hands, sum(bubble.length for bubble in bubbles)
        first = sculpture.plan.table.ends(bubbles[0].name)[0]
        self._start, self._end = sculpture.joints[first], sculpture.joints[ring]
        hanging, _ = sculpture.hanging_on((first, ring))
        for joint in hanging:
            hands.lead(joint, middle)
        self._carried = np.array(hanging, dtype=np.int64)
        hands.free[self._carried] = 0.0
        hands.let_go(np.array([self._start]))
        hands.grip(self._start, middle)
        self._places = middle[[*hanging, self._start]].astype(np.float64)
        along = self._places[-1] - middle[self._end]
        self._began = float(np.linalg.norm(along))
        self._along = along / max(self._began, 1e-9)
        self._gas = hands.amount_before(self._end)
        self._wanted = sum(amount_of(sculpture, bubble) for bubble in bubbles)
        self._left = self._gas

    def squeeze(self, share: float) -> None:
        """Bring its necks to their distance by a share, and push out that share of its gas."""
        progress = smooth(share)
        shift = progress * (self._length - self._began) * self._along
        self._hands.goal[[*self._carried, self._start]] = self._places + shift
        left = self._gas + progress * (self._wanted - self._gas)
        begin, end, _ = self._sculpture.frame
        self._hands.push_gas(self._end, (self._left - left) / (end - begin))
        self._left = left


def amount_of(sculpture: LatexSculpture, bubble: PlannedBubble) -> float:
    """Return the gas (mol) that a bubble is to keep."""
    scene = sculpture.scene
    n = int(scene.bodies[sculpture.body[bubble.balloon]].rings[0].around)
    volume = bubble.volume * polygon_share(n)
    return (scene.settings.atmosphere + (bubble.pressure or 0.0)) * volume / float(scene.air.molar_energy)
