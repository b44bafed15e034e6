"""The variant sets of a sculpture: how fine it is, whether it is being made or finished, and how it looks."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Sdf

DETAIL = "detail"
"""How fine the mesh is."""
STATE = "state"
"""Within each detail: the sculpture as it is made, or as it is in the end."""
MADE = "made"
"""State with the whole animation."""
FINISHED = "finished"
"""State with the final pose alone, without any time sample."""
LOOK = "look"
"""What the rubber is drawn as, see `balloon_usd.stage.looks`."""


def add_variant(prim: Any, variant_set: str, variant: str) -> Any:
    """Add a variant to the spec of a prim, with its set if need be; returns the spec within it."""
    if variant_set not in prim.variantSets:
        Sdf.VariantSetSpec(prim, variant_set)
        prim.variantSetNameList.prependedItems.append(variant_set)
    return Sdf.VariantSpec(prim.variantSets[variant_set], variant).primSpec
