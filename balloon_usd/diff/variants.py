"""Every selection of variants that both of two stages offer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.stage.opening import in_own_session

if TYPE_CHECKING:
    from collections.abc import Iterator


def selections(one: Any, other: Any) -> Iterator[tuple[str, Any, Any]]:
    """Yield each selection with both stages in it, one prim after the other; files stay as they are.

    A selection is named as in "detail=full, look=clay". Sets inside variants are gone through with these.
    The stages are the same two each time.
    """
    copies = [in_own_session(stage) for stage in (one, other)]
    paths = [str(prim.GetPath()) for prim in one.TraverseAll() if prim.HasVariantSets()]
    for path in paths:
        prims = [stage.GetPrimAtPath(path) for stage in copies]
        if all(prims):
            for chosen in _chosen(prims, {}):
                named = ", ".join(f"{name}={variant}" for name, variant in chosen.items())
                yield (named if len(paths) == 1 else f"{path} {named}"), *copies
        for stage in copies:
            stage.GetSessionLayer().Clear()


def _chosen(prims: list[Any], above: dict[str, str]) -> Iterator[dict[str, str]]:
    """Select one variant of each set that both prims have, the sets in those variants after it."""
    sets = [prim.GetVariantSets() for prim in prims]
    names = [name for name in sets[0].GetNames() if name not in above and name in sets[1].GetNames()]
    if not names:
        yield above
        return
    both = [one.GetVariantSet(names[0]) for one in sets]
    theirs = {*both[1].GetVariantNames()}
    for variant in both[0].GetVariantNames():
        if variant in theirs:
            for one in both:
                one.SetVariantSelection(variant)
            yield from _chosen(prims, {**above, names[0]: variant})
