"""What lies in other balloons of latex sinks to their lowest place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.plan.nesting import hosts_of
from balloon_usd.recipe.recipe import EARTH
from balloon_usd.solver.latex.motions.set_down import LatexSetDown
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.set_down import DOWN
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

SINKING = 0.5
"""Acceleration with which it begins to sink, m/s2: its mesh is some hundred times as inert as its rubber, and
would take a minute by its weight. In the end that alone dents the wall below it.
"""
EASED = 0.6
"""Share of the time from which on the pull is eased: by then it lies on the wall."""


class Sink(Motion):
    """Balloons in others that are pulled down to where it will be down once the figure is posed, and the
    others up by as much.
    """

    def __init__(self, move: moves.Sink, sculpture: LatexSculpture) -> None:
        """Find what sinks, and hold balloons that have no necks for hands."""
        self._hands, strips, body = sculpture.hands, sculpture.plan.strips, sculpture.body
        # Until something is bent, pressed or brought together walls of tubes touch nothing.
        self._hands.touch(sculpture.bodies)
        hosts = hosts_of(strips)
        pairs = [(body[guest], body[host.balloon]) for guest, host in hosts.items()]
        single = {body[host.balloon] for host in hosts.values() if len(strips[host.balloon].bubbles) == 1}
        down = DOWN if move.pose is None else DOWN @ LatexSetDown(move.pose, sculpture).turn
        self._first, self._last = (np.zeros_like(self._hands.gravity) for _ in range(2))
        """Pull on every balloon at first and in the end, (B, 3), m/s2."""
        for guest, host in pairs:
            first = SINKING * sculpture.inertia(guest) / sculpture.mass(guest)
            for pull, strength in ((self._first, max(first, EARTH)), (self._last, EARTH)):
                pull[guest] = strength * down
                pull[host] -= strength * down * sculpture.mass(guest) / sculpture.mass(host)
        self._pulled = np.unique(pairs)
        in_tubes = [pair for pair in pairs if pair[1] not in single]
        self._in_tubes = np.array(in_tubes, dtype=np.int64).ravel()
        """Bodies of twisted tubes, and of what lies in them."""
        self._held = [
            _Held(sculpture, each, [guest for guest, host in pairs if host == each])
            for each in sorted(single)
        ]

    def advance(self, share: float) -> None:
        """Pull less and less, in the end by weight alone; in tubes, whose necks it would bend, no more."""
        eased = smooth((share - EASED) / (1.0 - EASED))
        pull = self._first + eased * (self._last - self._first)
        self._hands.gravity[self._pulled] = pull[self._pulled]
        if share >= 1.0:
            self._hands.gravity[self._in_tubes] = 0.0
        for each in self._held:
            each.hold()


class _Held:
    """A balloon that is kept where it is, with what lies in it."""

    def __init__(self, sculpture: LatexSculpture, host: int, guests: Sequence[int]) -> None:
        self._sculpture, scene = sculpture, sculpture.scene
        self._host = scene.vertices_of(host)
        self._all = VertexSet.of(np.r_[tuple(map(scene.vertices_of, (host, *guests)))])
        self._place = self._before = self._middle()
        self._rate = np.zeros(3)
        """Velocity at which all of it was displaced in the last frame, m/s."""

    def _middle(self) -> NDArray[np.float64]:
        places: NDArray[np.float64] = self._sculpture.hands.places[self._host].mean(axis=0, dtype=float)
        return places

    def hold(self) -> None:
        """Displace it in the coming frame so that it ends where it was at first."""
        hands, (begin, end, _), now = self._sculpture.hands, self._sculpture.frame, self._middle()
        moving = (now - self._before) / (end - begin) - self._rate
        self._rate, self._before = (self._place - now) / (end - begin) - moving, now
        hands.spins.shift(self._all, self._rate)
