"""Setting nets: moves in which hands give a net its shape in space, as its rings close and in the end."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.operations.disjoint_sets import DisjointSets
from balloon_usd.operations.moves import Gather, Move, Pinch, SetNet, Weld
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from balloon_usd.operations.score import Score
    from balloon_usd.plan.nets import Net
    from balloon_usd.plan.rings import RingTable

SETTING_SECONDS = 1.5
"""Leading all joints of a finished net to their places, s."""


def set_nets(score: Score, nets: Sequence[Net], table: RingTable, step: int) -> None:
    """Let hands set nets where these would gather a chain that is part of one, and when all is made.

    `step`: number of steps of the recipe.
    """
    if not nets:
        return
    score.moves[:] = _in_place_of_gathering(score.moves, nets, table)
    for net in nets:
        rings = tuple(sorted(net.places))
        score.add(_setting(net, rings, Move(score.now, SETTING_SECONDS, step, "set the net")))
        score.add(Move(score.now, SETTLE_SECONDS, step, "set the net"))


def _in_place_of_gathering(moves: Iterable[Move], nets: Sequence[Net], table: RingTable) -> list[Move]:
    """Return the moves with a setting of the net in place of each gathering of a chain that is no longer
    free: on a circle, joints that are one would be led apart.
    """
    made = Made(table)
    found: list[Move] = []
    for move in moves:
        made.see(move)
        if isinstance(move, Gather) and made.ties(move.corners):
            ends = {move.corners[0], move.corners[-1]}
            net = next((net for net in nets if ends <= net.places.keys()), None)
            if net is not None:
                rings = made.with_held(move.corners[-1], net)
                found.append(_setting(net, rings, move, move.corners[0]))
                continue
        found.append(move)
    return found


def _setting(net: Net, rings: tuple[int, ...], move: Move, moving: int | None = None) -> SetNet:
    """Return the setting of some rings of a net, with the time and the words of a move."""
    index = {ring: k for k, ring in enumerate(rings)}
    sides = tuple((index[a], index[b]) for a, b in net.sides if a in index and b in index)
    places = tuple(net.places[ring] for ring in rings)
    return SetNet(move.start, move.seconds, move.step, move.text, rings, places, sides, moving)


class Made:
    """Rings that are closed so far, and those that are one."""

    def __init__(self, table: RingTable) -> None:
        """Begin with the knots, which are closed."""
        self._rings = table.rings
        self._closed = {k for k, ring in enumerate(table.rings) if ring.along == 0.0}
        self._welded: set[int] = set()
        self._welds: list[tuple[int, ...]] = []

    def see(self, move: Move) -> None:
        """Take note of what a move makes."""
        if isinstance(move, Pinch):
            self._closed.add(move.ring)
        elif isinstance(move, Weld):
            self._welded.update(move.rings)
            self._welds.append(move.rings)

    def ties(self, rings: Iterable[int]) -> bool:
        """Whether one of some rings is one with another by now."""
        return not self._welded.isdisjoint(rings)

    def with_held(self, held: int, net: Net) -> tuple[int, ...]:
        """Return the closed rings of a net that hang together with a held one, which comes last."""
        pieces: DisjointSets[int] = DisjointSets()
        for weld in self._welds:
            pieces.merge(weld)
        for one, other in pairwise(sorted(self._closed)):
            if self._rings[one].balloon == self._rings[other].balloon:
                pieces.merge((one, other))
        root = pieces.root(held)
        others = [k for k in sorted(self._closed & net.places.keys()) if pieces.root(k) == root and k != held]
        return (*others, held)
