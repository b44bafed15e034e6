"""Whether a prim shows the finished sculpture alone, which has no time samples."""

from __future__ import annotations

from typing import Any

from balloon_usd.stage.variant_sets import FINISHED, STATE


def is_still(prim: Any) -> bool:
    """Whether a prim is part of a sculpture of which the finished state is selected."""
    while prim:
        if prim.GetVariantSets().GetVariantSelection(STATE) == FINISHED:
            return True
        prim = prim.GetParent()
    return False
