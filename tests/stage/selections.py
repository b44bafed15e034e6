"""Every selection of a stage's variants, and what USD's own validators say of the one that is made."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from pxr import Usd, UsdValidation


def every_selection(stage: Usd.Stage) -> Iterator[tuple[str, ...]]:
    """Select all variants of the default prim one after another, in the stage's edit target."""
    sets = stage.GetDefaultPrim().GetVariantSets()
    names = sets.GetNames()
    for chosen in product(*(sets.GetVariantSet(name).GetVariantNames() for name in names)):
        for name, variant in zip(names, chosen, strict=True):
            sets.GetVariantSet(name).SetVariantSelection(variant)
        yield chosen


def complaints(stage: Usd.Stage) -> list[str]:
    """What all validators say; the wheel knows no MaterialX nodes, which does not count."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    return [text for text in (e.GetErrorAsString() for e in errors) if "'ND_open_pbr" not in text]
