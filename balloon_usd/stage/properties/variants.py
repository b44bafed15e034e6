"""Property 32: what holds of the selected variants holds of the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.stage.looks import ON_EVERY_STAGE, THESIS
from balloon_usd.stage.opening import in_own_session
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import clouds_of
from balloon_usd.stage.variant_sets import DETAIL, FINISHED, LOOK, MADE, STATE

if TYPE_CHECKING:
    from collections.abc import Iterator

Selection = dict[str, str]
"""Variant by variant set."""


def selections(stage: Any) -> Iterator[tuple[Selection, Any]]:
    """Every selection of the variants of the default prim, also of nested ones, and the stage so selected.

    The one of the stage itself comes first, then those that differ from it in the last sets only. The
    stage is the same every time, with another selection in its session layer; the one given is left as
    it is.
    """
    other = in_own_session(stage)
    root = other.GetDefaultPrim()
    own = _selected(root) if root else {}
    yield own, other
    if root:
        yield from ((chosen, other) for chosen in _deeper(root, {}, own) if chosen != own)


def _selected(root: Any) -> Selection:
    sets = root.GetVariantSets()
    return {name: sets.GetVariantSelection(name) for name in _names(root)}


def _names(root: Any) -> list[str]:
    """Variant sets of a prim; what is drawn comes last, since it changes least."""
    return sorted(root.GetVariantSets().GetNames(), key=lambda name: name == LOOK)


def _deeper(root: Any, chosen: Selection, own: Selection) -> Iterator[Selection]:
    """Selections that begin with what is chosen: a variant may bring further sets."""
    name = next((name for name in _names(root) if name not in chosen), None)
    if name is None:
        yield dict(chosen)
        return
    variants = root.GetVariantSet(name)
    for variant in sorted(variants.GetVariantNames(), key=lambda variant: variant != own.get(name)):
        variants.SetVariantSelection(variant)
        yield from _deeper(root, {**chosen, name: variant}, own)
    variants.ClearVariantSelection()


def _shown(root: Any) -> set[str]:
    """Return the looks that say how anything looks: the interface only names them."""
    sets = (spec.variantSets[LOOK] for spec in root.GetPrimStack() if LOOK in spec.variantSets)
    variants = (variant for each in sets for variant in each.variantList)
    return {each.name for each in variants if each.primSpec.nameChildren or each.primSpec.hasReferences}


def missing_variants(stage: Any) -> Iterator[Finding]:
    """Property 32: a stage in layers, which has details, has both states of each and all looks."""
    root = stage.GetDefaultPrim()
    if not root or not root.GetVariantSet(DETAIL).GetVariantNames():
        return
    looks = (*ON_EVERY_STAGE, THESIS) if clouds_of(stage) else ON_EVERY_STAGE
    states = root.GetVariantSet(STATE).GetVariantNames()
    for name, expected, found in ((STATE, (MADE, FINISHED), states), (LOOK, looks, _shown(root))):
        missing = [variant for variant in expected if variant not in found]
        if missing:
            yield Finding(32, f"variant set {name} lacks {', '.join(missing)}", str(root.GetPath()))
