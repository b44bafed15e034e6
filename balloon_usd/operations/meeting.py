"""Bubbles between which a limb is set: do they meet where it hangs?"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import ends_of
from balloon_usd.language.lengths import cm
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.distances import distances

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workpiece import Limb, Workpiece


def apart(
    index: int, layout: Layout, piece: Workpiece, name: str, limb: Limb, between: Sequence[str]
) -> Caution | None:
    """Return a caution of bubbles that share no joint, or not that about which a limb is turned; None of
    those that do.

    In simulations of random figures one of 15 limbs came between bubbles that share no joint, 3 of 15 between
    such as share another joint, and 25 of 37 between such as share theirs.
    """
    joint_of = {each: ends[0] for ends in piece.joints for each in ends}
    common = frozenset.intersection(*(frozenset(joint_of[end] for end in ends_of(each)) for each in between))
    what = f"{name} may not come between {all_of(between)}"
    if len(between) == 1:
        what = f"{name} may not come into {between[0]}"
    if not common:
        why = "these share no joint, and so do not close on what is between them"
        return Caution(index, what, why, "lock them to one joint before, or set it between two of one joint")
    if joint_of[limb.joint] in common:
        return None
    ends = {each: [joint_of[end] for end in ends_of(each)] for each in piece.hangs_with(name)}
    sides = ((one, other, layout.bubble(each).length) for each, (one, other) in ends.items())
    ways = distances(sides, joint_of[limb.joint])
    far = min(ways.get(joint, math.inf) for joint in common)
    their = "its" if len(between) == 1 else "their"
    why = f"{name} is turned about a joint that is {cm(far)} from {their} joint"
    remedy = "lock both joints together before, or set it between two of its own joint"
    return Caution(index, what, why, remedy)
