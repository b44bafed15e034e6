"""What hangs on a ring: all that goes with it when hands move it."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

from balloon_usd.operations.disjoint_sets import DisjointSets, roots_of


@lru_cache(maxsize=4096)
def hanging_on(
    held: tuple[int, ...], balloons: tuple[str, ...], welds: tuple[tuple[int, ...], ...]
) -> tuple[tuple[int, ...], ...]:
    """Return for every held ring the rings that hang on it alone, on all balloons, in order.

    A ring hangs on a held one if bubbles and welds connect both on a way that passes no other held ring.
    What is welded to a held ring lies on no side of it and hangs on it. What hangs on several is drawn by all
    of these, and so is given to none. Kept, as variants of a recipe ask the same.

    Args:
        held: rings that hands hold or move.
        balloons: balloon of every ring, in order along the balloons.
        welds: rings that are one joint.
    """
    joint = roots_of(len(balloons), welds)
    holder = {joint[ring]: k for k, ring in reversed(list(enumerate(held)))}
    pieces: DisjointSets[int] = DisjointSets()
    beside: list[tuple[int, int]] = []
    for before, after in pairwise(range(len(balloons))):
        if balloons[before] != balloons[after]:
            continue
        ends = joint[before], joint[after]
        free = [end for end in ends if end not in holder]
        if len(free) == 2:
            pieces.merge(free)
        elif free:
            beside += [(end, holder[other]) for end, other in (ends, ends[::-1]) if other in holder]
    holders: dict[int, set[int]] = {at: {k} for at, k in holder.items()}
    for end, k in beside:
        holders.setdefault(pieces.root(end), set()).add(k)
    found: list[list[int]] = [[] for _ in held]
    for ring, at in enumerate(joint):
        of = holders.get(pieces.root(at), ())
        if len(of) == 1 and ring not in held:
            found[next(iter(of))].append(ring)
    return tuple(map(tuple, found))


@lru_cache(maxsize=4096)
def folded_between(
    first: int, last: int, balloons: tuple[str, ...], welds: tuple[tuple[int, ...], ...]
) -> tuple[int, ...]:
    """Return the rings that hang between two rings that are one joint, with all that hangs on them, in order;
    none where they also hang together with what lies beyond either ring.

    `first`, `last`: rings of one balloon; `balloons`, `welds`: as of `hanging_on`.
    """
    joint = roots_of(len(balloons), welds)
    closed = joint[first]
    pieces: DisjointSets[int] = DisjointSets()
    for before, after in pairwise(range(len(balloons))):
        ends = joint[before], joint[after]
        if balloons[before] == balloons[after] and closed not in ends:
            pieces.merge(ends)
    outside = {
        pieces.root(joint[ring])
        for ring in (first - 1, last + 1)
        if 0 <= ring < len(balloons) and balloons[ring] == balloons[first] and joint[ring] != closed
    }
    inside = {pieces.root(joint[ring]) for ring in range(first + 1, last) if joint[ring] != closed}
    if inside & outside:
        return ()
    return tuple(ring for ring, at in enumerate(joint) if at != closed and pieces.root(at) in inside)
