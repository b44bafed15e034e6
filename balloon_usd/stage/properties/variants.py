"""Property 32: what holds of the selected variants holds of the others."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

from pxr import Sdf, Usd

from balloon_usd.stage.looks import LATEX, THESIS, VARIANT_SET
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import clouds_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


def every_selection(stage: Any, check: Callable[[Any], list[Finding]]) -> Iterator[Finding]:
    """Property 32: each selection of variants validates; a stage with air has the looks of latex and wire.

    Args:
        stage: is left as it is.
        check: findings of an open stage.
    """
    session = Sdf.Layer.CreateAnonymous()
    other = Usd.Stage.Open(stage.GetRootLayer(), session)
    other.SetEditTarget(session)
    if not other.GetDefaultPrim():
        return
    sets = other.GetDefaultPrim().GetVariantSets()
    looks = sets.GetVariantSet(VARIANT_SET).GetVariantNames()
    if clouds_of(other) and not {LATEX, THESIS} <= {*looks}:
        yield Finding(32, f"there is air, but the looks are {looks}")
    names = sets.GetNames()
    for selection in product(*(sets.GetVariantSet(name).GetVariantNames() for name in names)):
        for name, variant in zip(names, selection, strict=True):
            sets.GetVariantSet(name).SetVariantSelection(variant)
        for finding in check(other):
            yield Finding(32, f"{', '.join(selection)}: {finding}")
