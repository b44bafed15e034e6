"""Holes of loops into which limbs are set."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.language.lengths import at_most, cm
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.closing import LENIENCE

if TYPE_CHECKING:
    from balloon_usd.operations.layout import Layout

OPEN = 3.6
"""Length of a loop below which nothing stays in its hole, in its widths: in simulations of a 260 an ear of
4 cm slips out of one of 17 cm and stays in one of 18; of a 160 and a 350 it is 9 to 12 and 24 to 30.
"""
FITS = 0.9
"""Width of the hole of a loop beyond which a limb slips out of it, in widths of its tube: an ear of 3 cm of a
260 stays in a loop of 30 cm and slips out of one of 32.
"""
LOOP_IN_LOOP = 1.5
"""Length of a loop below which another one does not come into its hole, in the length of that: in simulations
of a 260 one of 20 cm comes into one of 30 and stays in one of 50, one of 28 comes in from 43 on.
"""


def hole_caution(index: int, layout: Layout, name: str, into: str) -> Caution | None:
    """Return a caution of a loop whose hole its own wall closes, or which is too narrow or too wide for a
    limb; None of one that holds it.
    """
    bubble, loop = layout.bubble(name), layout.bubble(into)
    shown = f"{into} ({cm(loop.length)})"
    if loop.length < OPEN * loop.width:
        what = f"{name} ({cm(bubble.length)}) may slip out of {shown}"
        why = "the wall of so short a loop closes its hole"
        return Caution(index, what, why, f"make {into} at least {cm(OPEN * loop.width)} long")
    if bubble.looped and loop.length < LOOP_IN_LOOP * bubble.length - LENIENCE:
        least, most = cm(LOOP_IN_LOOP * bubble.length), cm(loop.length / LOOP_IN_LOOP)
        what = f"{name} ({cm(bubble.length)}) may not come into {shown}"
        why = f"{name} is as wide as two tubes"
        return Caution(index, what, why, f"make {into} at least {least} long, or {name} at most {most}")
    if is_too_wide(loop.length, loop.width, bubble.width, looped=bubble.looped):
        most_long = math.pi * (FITS * bubble.width + loop.width)
        what, why = f"{name} may slip out of {shown}", f"its hole is about as wide as {name}, or wider"
        return Caution(index, what, why, f"make {into} {at_most(most_long)} long, or less")
    return None


def is_too_wide(length: float, width: float, limb: float, *, looped: bool) -> bool:
    """Whether a limb so wide slips out of the hole of a loop so long, of a tube so wide, m: a loop stays."""
    return not looped and length / math.pi - width > FITS * limb
