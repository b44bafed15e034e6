"""How far reaches what hands turn about its joint: it has to take its time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.language.joint import ends_of
from balloon_usd.operations.distances import distances

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from balloon_usd.language.joint import Joint
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workpiece import Workpiece

    Length = Callable[[str], float]
    """Length of a bubble, m."""

SECONDS_PER_METRE = 3.0
"""Time in which hands turn what reaches a metre half round its joint, s/m: its end stays below 1.6 m/s."""


def limb_reach(score: Score, bubble: str, index: int, apart: Collection[str] = ()) -> float:
    """Return how far the limb of a bubble reaches from its joint in a step, at least its own length, m.

    `apart`: bubbles that do not belong to it.
    """
    own, piece = score.layout.bubble(bubble).length, score.piece.after(index)
    limb = piece.limb(bubble, apart)
    if limb is None:
        return own
    return max(own, _reach(piece, limb.joint, limb.bubbles, _length_at(score, index)))


def swung_reach(score: Score, bubble: str, index: int) -> float:
    """Return how far what is swung as a bubble is curved in a step reaches from the end of that, m."""
    piece = score.piece.after(index)
    if not (swung := swung_with(piece, bubble)):
        return 0.0
    end = next(end for end in ends_of(bubble) if piece.hangs_on(end) == swung)
    return _reach(piece, end, swung, _length_at(score, index))


def swung_with(piece: Workpiece, bubble: str) -> frozenset[str]:
    """Return what hangs on the end of a bubble on which less does, and so is swung as hands curve it; nothing
    where its ends hang together, or it is all that there is of its balloon.
    """
    if bubble not in piece.bubbles:
        return frozenset()
    one, other = (piece.hangs_on(end) for end in ends_of(bubble))
    return min(one, other, key=len) if one.isdisjoint(other) else frozenset()


def _length_at(score: Score, index: int) -> Length:
    """Return what tells how long a bubble is in a step: what is left of a balloon then is longer than in the
    end.
    """
    piece, layout = score.piece, score.layout

    def length(name: str) -> float:
        made = piece.bubbles[name]
        if not made.last or made.step <= index:
            return layout.bubble(name).length
        later = (each for each in piece.row(made.balloon) if piece.bubbles[each].step > index)
        return sum(layout.bubble(each).length for each in later)

    return length


def _reach(piece: Workpiece, end: Joint, bubbles: Collection[str], length: Length) -> float:
    """Return how far some bubbles reach from a joint on which they hang, along themselves, m.

    `end`: one end of a bubble in the joint.
    """
    joint_of = {each: ends[0] for ends in piece.joints for each in ends}
    ends = {}
    for name in bubbles:
        start, behind = (joint_of[each] for each in ends_of(name))
        ends[name] = start, behind
    found = distances(((*ends[name], length(name)) for name in bubbles), joint_of[end])
    # The farthest place of a loop lies half its length away.
    return max(
        (0.5 * (sum(found.get(joint, math.inf) for joint in ends[name]) + length(name)) for name in bubbles),
        default=0.0,
    )
