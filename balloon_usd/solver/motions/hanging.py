"""What hangs on a ring: all that goes with it when hands move it."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.operations.disjoint_sets import DisjointSets

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def hanging_on(
    held: Sequence[int], balloons: Sequence[str], welds: Iterable[Sequence[int]]
) -> tuple[tuple[int, ...], ...]:
    """Return for every held ring the rings that hang on it alone, on all balloons, in order.

    A ring hangs on a held one if bubbles and welds connect both on a way that passes no other held ring.
    What is welded to a held ring lies on no side of it and hangs on it. What hangs on several is drawn by all
    of these, and so is given to none.

    Args:
        held: rings that hands hold or move.
        balloons: balloon of every ring, in order along the balloons.
        welds: rings that are one joint.
    """
    joints: DisjointSets[int] = DisjointSets()
    for weld in welds:
        joints.merge(weld)
    joint = [joints.root(ring) for ring in range(len(balloons))]
    holder = {joint[ring]: k for k, ring in reversed(list(enumerate(held)))}
    pieces: DisjointSets[int] = DisjointSets()
    ends: list[tuple[int, int]] = []
    for before, after in pairwise(range(len(balloons))):
        if balloons[before] != balloons[after]:
            continue
        near, far = joint[before], joint[after]
        if near not in holder and far not in holder:
            pieces.merge((near, far))
        ends += [(one, other) for one, other in ((near, far), (far, near)) if one in holder]
    holders: dict[int, set[int]] = {}
    for at, beside in ends:
        holders.setdefault(pieces.root(beside), set()).add(holder[at])
    found: tuple[list[int], ...] = tuple([] for _ in held)
    for ring in range(len(balloons)):
        own = holder.get(joint[ring])
        of = {own} if own is not None else holders.get(pieces.root(joint[ring]), set())
        if len(of) == 1 and ring not in held:
            found[of.copy().pop()].append(ring)
    return tuple(map(tuple, found))
