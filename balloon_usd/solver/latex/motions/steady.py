"""Steadying what is already made while the balloon beyond it is worked on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture


def steady(sculpture: LatexSculpture, ring: int) -> None:
    """Keep what hangs on a ring of the plan, on its knot's side, from swinging, free to move along the
    balloon as the neck draws it in.
    """
    made, _ = sculpture.hanging_on((ring, ring + 1))
    for joint in made:
        sculpture.hands.lead(joint, sculpture.frame.middle)
    sculpture.hands.free[made] = ALONG
