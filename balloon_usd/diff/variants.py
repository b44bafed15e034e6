"""Every selection of variants that both of two stages offer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pxr import Sdf, Usd

if TYPE_CHECKING:
    from collections.abc import Iterator


def selections(one: Any, other: Any) -> Iterator[tuple[str, Any, Any]]:
    """Yield each selection with both stages in it, one prim after the other; files stay as they are.

    A selection is named as in "detail=full, look=clay". Sets inside variants are gone through with these.
    The stages are the same two each time.
    """
    copies = [_copy(stage) for stage in (one, other)]
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


def _copy(stage: Any) -> Any:
    """Open a stage once more with a session of its own, so that selections are nobody else's."""
    session = Sdf.Layer.CreateAnonymous()
    copy = Usd.Stage.Open(stage.GetRootLayer(), session)
    copy.SetEditTarget(session)
    return copy
