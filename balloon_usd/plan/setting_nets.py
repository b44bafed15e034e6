"""Setting nets: moves in which hands give a net its shape in space, as its rings close and in the end."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.operations.disjoint_sets import DisjointSets, roots_of
from balloon_usd.operations.moves import Bring, Gather, Halve, LeadIn, Move, Pinch, SetNet, Weld
from balloon_usd.operations.score import BRING_SECONDS, SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Sequence

    from balloon_usd.operations.moves import Vector
    from balloon_usd.operations.score import Score
    from balloon_usd.plan.nets import Net
    from balloon_usd.plan.rings import RingTable

SETTING_SECONDS = 1.5
"""Leading all joints of a finished net to their places, s."""
SETTING_SPEED = 0.35
"""Reach of a net from its held joint over the least time in which it is set, m/s: turned by half a turn on
the way, its far side goes at 2 m/s at most.
"""

SIDE_BY_SIDE = 2
"""Most bubbles of a chain that lie side by side when it is closed."""


def set_nets(
    score: Score, nets: Sequence[Net], table: RingTable, step: int, timed: Container[int] = ()
) -> None:
    """Let hands set nets where these would gather a chain that is part of one, and when all is made.

    `step`: number of steps of the recipe; `timed`: steps whose time the recipe gives.
    """
    if not nets:
        return
    moves = _in_place_of_closing(score.moves, nets, table)
    score.moves[:] = _with_time(score.moves, moves, score.pace.leading, timed)
    score.now += score.moves[-1].start - moves[-1].start
    for net in nets:
        setting = _setting(net, tuple(sorted(net.places)), Move(score.now, 0.0, step, "set the net"))
        score.add(replace(setting, seconds=max(SETTING_SECONDS, _reach(setting) / SETTING_SPEED)))
        score.add(Move(score.now, SETTLE_SECONDS, step, "set the net"))


def _with_time(
    written: Iterable[Move], moves: Iterable[Move], leading: float, timed: Container[int]
) -> list[Move]:
    """Return the moves with the time that setting nets takes; what follows begins later, or sooner.

    `written`: the same moves as they were; `leading`: how many times as fast as a calm maker hands lead.
    """
    found: list[Move] = []
    later = 0.0
    for before, move in zip(written, moves, strict=True):
        seconds = move.seconds
        if isinstance(move, SetNet) and move.step not in timed:
            # Joints of a net are nearer to each other than along its bubbles.
            least = min(seconds, BRING_SECONDS / leading) if isinstance(before, Bring) else seconds
            seconds = max(least, _reach(move) / (SETTING_SPEED * leading))
        found.append(replace(move, start=move.start + later, seconds=seconds))
        later += seconds - move.seconds
    return found


def _reach(setting: SetNet) -> float:
    """Return how far the joints of a net lie from the one that is held, at most, m."""
    return max(math.dist(place, setting.places[-1]) for place in setting.places)


def _in_place_of_closing(moves: Iterable[Move], nets: Sequence[Net], table: RingTable) -> list[Move]:
    """Return the moves with a setting of the net in place of each that closes one of its rings, but for the
    first ring of a balloon, a free chain: on a circle, joints that are one would be led apart, and brought
    straight to each other, they would make a lump. What is brought to a net is carried as a whole.
    """
    made = _Made(table)
    found: list[Move] = []
    for move in moves:
        made.see(move)
        if isinstance(move, LeadIn):
            found.append(_into_net(move, nets, made))
        elif (ends := made.closing(move)) is not None:
            found.append(_closing(move, ends, nets, made))
        elif isinstance(move, Bring) and _net_with((move.ring, move.to), nets) is not None:
            found.append(replace(move, carried=True))
        else:
            found.append(move)
    return found


def _closing(move: Move, ends: tuple[int, int], nets: Sequence[Net], made: _Made) -> Move:
    """Return the move in which a net is set so that two of its rings meet; if none has both, the move given.

    `ends`: the moving ring and the held one.
    """
    if (net := _net_with(ends, nets)) is None:
        return move
    moving, held = ends
    if (end := made.open_end(held)) is None:
        return replace(_setting(net, made.with_held(held, net), move), moving=moving)
    onward = made.onward(end, net) or net.places[end]
    return replace(_setting(net, made.with_held(end, net), move), moving=moving, onward=onward)


def _net_with(rings: Iterable[int], nets: Iterable[Net]) -> Net | None:
    """Return the net that has some rings, if one has them all."""
    return next((net for net in nets if net.places.keys() >= set(rings)), None)


def _into_net(move: LeadIn, nets: Sequence[Net], made: _Made) -> LeadIn:
    """Return the leading in of a balloon with where it will lie in the net that it becomes part of."""
    net = _net_with((move.ring, move.to), nets)
    if net is None:
        return move
    rings = made.with_held(move.to, net)
    coming = [net.places[ring] for ring in made.with_held(move.ring, net)[:-1]]
    if (onward := made.onward(move.ring, net)) is not None:
        coming.append(onward)
    far = [[place - at for place, at in zip(each, net.places[move.to], strict=True)] for each in coming]
    x, y, z = (sum(values) for values in zip(*far, strict=True)) if far else (0.0, 0.0, 0.0)
    return replace(move, rings=rings, places=tuple(net.places[ring] for ring in rings), toward=(x, y, z))


def _setting(net: Net, rings: tuple[int, ...], move: Move) -> SetNet:
    """Return the setting of some rings of a net, with the time and the words of a move."""
    index = {ring: k for k, ring in enumerate(rings)}
    sides = tuple((index[a], index[b]) for a, b in net.sides if a in index and b in index)
    places = tuple(net.places[ring] for ring in rings)
    return SetNet(move.start, move.seconds, move.step, move.text, rings, places, sides)


class _Made:
    """Rings that are closed so far, and those that are one."""

    def __init__(self, table: RingTable) -> None:
        """Begin with the knots, which are closed."""
        self._rings = table.rings
        self._closed = [k for k, ring in enumerate(table.rings) if ring.along == 0.0]
        self._welded: set[int] = set()
        self._welds: list[tuple[int, ...]] = []

    def see(self, move: Move) -> None:
        """Take note of what a move makes."""
        if isinstance(move, Pinch):
            self._closed.append(move.ring)
        elif isinstance(move, Halve):
            # What is left of the balloon stays beyond the ring that was closed last.
            self._closed.insert(-1, move.ring)
        elif isinstance(move, Weld):
            self._welded.update(move.rings)
            self._welds.append(move.rings)

    def closing(self, move: Move) -> tuple[int, int] | None:
        """Return the rings that a move brings together, the moving and the held one, where these hang
        together by now and not only as a free chain.
        """
        if isinstance(move, Gather) and not self._is_free(move.corners):
            return move.corners[0], move.corners[-1]
        if isinstance(move, Bring):
            # What is left of a balloon lies beyond the ring that was closed last.
            moving, held = sorted((move.ring, move.to), key=self._closed.index)
            pieces = self._pieces()
            if pieces.root(moving) == pieces.root(held):
                return moving, held
        return None

    def _is_free(self, corners: Sequence[int]) -> bool:
        """Whether a chain hangs on nothing; a pair of bubbles or a bubble that closes on itself may hang on
        its moving end, for these lie side by side, to which hands bulge them as they close.
        """
        bubbles = sum(self._rings[ring].joint for ring in corners) - 1
        return self._welded.isdisjoint(corners[1:] if bubbles <= SIDE_BY_SIDE else corners)

    def with_held(self, held: int, net: Net) -> tuple[int, ...]:
        """Return the closed rings of a net that hang together with a held one, which comes last."""
        pieces = self._pieces()
        others = [k for k in sorted(net.places.keys() & self._closed) if k != held]
        return (*(k for k in others if pieces.root(k) == pieces.root(held)), held)

    def open_end(self, ring: int) -> int | None:
        """Return the ring, one with this or itself, beyond which lies what is left of a balloon; None if
        there is none.
        """
        joints = roots_of(len(self._rings), self._welds)
        last = {self._rings[k].balloon: k for k in sorted(self._closed)}
        ends = [k for k in self._closed if k in last.values() and joints[k] == joints[ring]]
        return ends[-1] if ends else None

    def onward(self, end: int, net: Net) -> Vector | None:
        """Return the place in a net of the joint that follows an open end; None if none does."""
        balloon = self._rings[end].balloon
        later = (k for k in range(end + 1, len(self._rings)) if self._rings[k].joint)
        following = next(later, end)
        return net.places.get(following) if self._rings[following].balloon == balloon else None

    def _pieces(self) -> DisjointSets[int]:
        """Return the closed rings that hang together."""
        pieces: DisjointSets[int] = DisjointSets()
        for weld in self._welds:
            pieces.merge(weld)
        for one, other in pairwise(sorted(self._closed)):
            if self._rings[one].balloon == self._rings[other].balloon:
                pieces.merge((one, other))
        return pieces
