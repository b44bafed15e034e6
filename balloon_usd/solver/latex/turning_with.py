"""With which bubble every vertex of a balloon turns when joints untwist."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.language.joint import Joint

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan import Plan

CLEAR = 1e-6
"""What lies farther than this beyond a joint turns with what lies beyond it, m."""


def turning_with(plan: Plan, balloon: str, along: NDArray[np.float32]) -> NDArray[np.str_]:
    """Return the bubble with which each vertex turns, (V,): its own one, or, of a popped bubble, one at the
    joint on which its rag hangs; empty where there is none.

    `along`: unstressed distance of every vertex from the knot, (V,), m.
    """
    table, bubbles = plan.table, plan.strips[balloon].bubbles
    if len(bubbles) == 1:
        return np.full(len(along), bubbles[0].name)
    piece, names, marks = plan.piece_let_go, [], []
    for bubble in bubbles:
        start, end = table.ends(bubble.name)
        begin = table.rings[start].along
        behind = float(along.max()) if end is None else table.rings[end].along
        if bubble.name not in piece.popped:
            names.append(bubble.name)
        elif bubble.tears:
            names += [_held_at(piece, Joint(bubble.name, side)) for side in ("start", "end")]
            marks.append(0.5 * (begin + behind))
        else:
            sides = (_held_at(piece, Joint(bubble.name, side)) for side in ("start", "end"))
            names.append(next(filter(None, sides), ""))
        marks.append(behind)
    return np.array(names)[np.searchsorted(np.array(marks[:-1]) + CLEAR, along)]


def _held_at(piece: Workpiece, end: Joint) -> str:
    """Return a bubble that has its gas at the joint of one that has none; empty where there is none."""
    return next((each.bubble for each in piece.joint(end) if each.bubble not in piece.popped), "")
