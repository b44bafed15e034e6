"""Properties 1 to 4 and 6 to 11: how the stage is put together and what it says about itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Kind, Sdf, Tf, UsdGeom, UsdUtils

from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import attributes_of
from balloon_usd.stage.provenance import ABSOLUTE, COMPLETE, KEY, problems

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

DEFAULT_RATE = 24.0
"""Time codes per second that every DCC tool plays at the right speed."""

SMALLEST, LARGEST = 0.02, 20.0
"""Plausible diagonals of a sculpture [m]: from one bubble of a 160 to an arch of many balloons."""

SAME = 1e-6
"""Two extents are the same within this fraction of their size (float32 rounding)."""


def opens_whole(stage: Any) -> Iterator[Finding]:
    """Property 1: opens without composition error; no unresolved asset."""
    for error in stage.GetCompositionErrors():
        yield Finding(1, f"composition error: {error}")
    if stage.GetRootLayer().realPath:
        try:
            _, _, unresolved = UsdUtils.ComputeAllDependencies(Sdf.AssetPath(stage.GetRootLayer().realPath))
        except Tf.ErrorException as error:
            unresolved = [str(error.args[0].commentary)]
        for path in unresolved:
            yield Finding(1, f"unresolved asset {path}")


def one_component_root(stage: Any) -> Iterator[Finding]:
    """Property 2: one defined root prim, it is the default prim, an Xform, kind component."""
    roots = [p for p in stage.GetPseudoRoot().GetAllChildren() if p.IsDefined() and not p.IsAbstract()]
    if len(roots) != 1:
        yield Finding(2, f"{len(roots)} defined root prims, expected one")
    for root in roots[:1]:
        path = str(root.GetPath())
        if stage.GetDefaultPrim() != root:
            yield Finding(2, "the root is not the default prim", path)
        if not root.IsA(UsdGeom.Xform):
            yield Finding(2, f'the root is of type "{root.GetTypeName()}", expected Xform', path)
        if root.GetKind() != Kind.Tokens.component:
            yield Finding(2, f'kind is "{root.GetKind()}", expected component', path)


def units_and_times_authored(stage: Any) -> Iterator[Finding]:
    """Property 3: Z up, one metre per unit, both rates, start and end authored on the root layer."""
    head = stage.GetRootLayer().pseudoRoot
    for key, expected in (("upAxis", "Z"), ("metersPerUnit", 1.0)):
        if not head.HasInfo(key) or head.GetInfo(key) != expected:
            yield Finding(3, f"{key} is not authored as {expected}")
    for key in ("timeCodesPerSecond", "framesPerSecond", "startTimeCode", "endTimeCode"):
        if not head.HasInfo(key):
            yield Finding(3, f"{key} is not authored")


def rates_agree(stage: Any) -> Iterator[Finding]:
    """Property 4: both rates are equal, and 24 unless the provenance says otherwise."""
    wanted = _facts(stage).get("fps", DEFAULT_RATE)
    for name, rate in (
        ("timeCodesPerSecond", stage.GetTimeCodesPerSecond()),
        ("framesPerSecond", stage.GetFramesPerSecond()),
    ):
        if rate != wanted:
            yield Finding(4, f"{name} is {rate:g}, expected {wanted:g}")


def only_relative_paths(stage: Any) -> Iterator[Finding]:
    """Property 6: only relative asset paths, so that the folder can be moved."""
    for layer in stage.GetUsedLayers():
        paths = {*layer.GetCompositionAssetDependencies(), *layer.GetExternalAssetDependencies()}
        for path in sorted(paths):
            if ABSOLUTE.match(path):
                yield Finding(6, f"absolute path {path}", layer.identifier)
    for attribute in attributes_of(stage):
        value = attribute.Get()
        if isinstance(value, Sdf.AssetPath) and ABSOLUTE.match(value.path):
            yield Finding(6, f"absolute path {value.path}", str(attribute.GetPath()))
    identifier = _root_info(stage).get("identifier")
    if isinstance(identifier, Sdf.AssetPath) and ABSOLUTE.match(identifier.path):
        yield Finding(6, f"absolute identifier {identifier.path}")


def nothing_undefined(stage: Any) -> Iterator[Finding]:
    """Property 7: no typeless def, no dangling over."""
    for prim in stage.TraverseAll():
        if prim.IsAbstract():
            continue
        if prim.GetSpecifier() == Sdf.SpecifierOver:
            yield Finding(7, "an over that nothing defines", str(prim.GetPath()))
        elif not prim.GetTypeName():
            yield Finding(7, "a def without type", str(prim.GetPath()))


def plausible_size(stage: Any) -> Iterator[Finding]:
    """Property 8: the size in metres is plausible."""
    low, high = whole_extent(stage)
    diagonal = float(np.linalg.norm(high - low))
    if not SMALLEST <= diagonal <= LARGEST:
        yield Finding(8, f"diagonal is {diagonal:.3g} m, expected {SMALLEST} to {LARGEST} m")


def provenance_complete(stage: Any) -> Iterator[Finding]:
    """Property 9: provenance complete and free of facts of the run; asset name and identifier."""
    for problem in problems(_facts(stage), COMPLETE):
        yield Finding(9, problem)
    for key in ("name", "identifier"):
        if not _root_info(stage).get(key):
            yield Finding(9, f"assetInfo has no {key}", str(stage.GetDefaultPrim().GetPath()))


def extents_hint_is_union(stage: Any) -> Iterator[Finding]:
    """Property 10: extentsHint on the payload's prim equals the union over time."""
    root = stage.GetDefaultPrim()
    path = str(root.GetPath())
    hint = UsdGeom.ModelAPI(root).GetExtentsHint() if root else None
    if not hint:
        yield Finding(10, "no extentsHint", path)
        return
    found = np.asarray(hint, dtype=np.float64)[:2]
    expected = whole_extent(stage)
    if not np.allclose(found, expected, rtol=0.0, atol=SAME * float(np.ptp(expected) or 1.0)):
        yield Finding(10, f"extentsHint is {found.tolist()}, expected {expected.tolist()}", path)


def no_animated_visibility(stage: Any) -> Iterator[Finding]:
    """Property 11: no animated visibility, which DCC tools ignore."""
    for attribute in attributes_of(stage):
        if attribute.GetName() == UsdGeom.Tokens.visibility and attribute.GetNumTimeSamples():
            yield Finding(11, "visibility has time samples", str(attribute.GetPath()))


def whole_extent(stage: Any) -> NDArray[np.float64]:
    """Smallest and largest corner (2, 3) of everything that some look shows, over all samples, or zeros."""
    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    times = {t for a in attributes_of(stage) if a.GetName() == "extent" for t in a.GetTimeSamples()}
    purposes = [UsdGeom.Tokens.default_, UsdGeom.Tokens.render]
    cache = UsdGeom.BBoxCache(0.0, purposes, useExtentsHint=False, ignoreVisibility=True)
    corners = []
    for time in sorted(times) or [stage.GetStartTimeCode()]:
        cache.SetTime(time)
        box = cache.ComputeLocalBound(root).ComputeAlignedRange()
        if not box.IsEmpty():
            corners.append([box.GetMin(), box.GetMax()])
    if not corners:
        return np.zeros((2, 3))
    whole = np.array(corners, dtype=np.float64)
    return np.stack([whole[:, 0].min(axis=0), whole[:, 1].max(axis=0)])


def _facts(stage: Any) -> dict[str, Any]:
    """The package's provenance in the root layer."""
    return dict(stage.GetRootLayer().customLayerData.get(KEY, {}))


def _root_info(stage: Any) -> dict[str, Any]:
    """The asset info of the default prim."""
    root = stage.GetDefaultPrim()
    return dict(root.GetAssetInfo()) if root else {}
