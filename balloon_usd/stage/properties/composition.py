"""Properties 1 to 4, 6, 7, 9 and 11: how the stage is put together and what it says about itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, Tf, UsdGeom, UsdUtils
from balloon_usd.stage.opening import said_by
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.kinds import ROOT_KIND, UP_AXIS, StageKind, kind_of
from balloon_usd.stage.properties.reading import attributes_of
from balloon_usd.stage.provenance import ABSOLUTE, COMPLETE, KEY, problems

if TYPE_CHECKING:
    from collections.abc import Iterator

DEFAULT_RATE = 24.0
"""Time codes per second that every DCC tool plays at the right speed."""


def opens_whole(stage: Any) -> Iterator[Finding]:
    """Property 1: opens without composition error; no unresolved asset."""
    for error in stage.GetCompositionErrors():
        yield Finding(1, f"composition error: {error}")
    if stage.GetRootLayer().realPath:
        try:
            _, _, unresolved = UsdUtils.ComputeAllDependencies(Sdf.AssetPath(stage.GetRootLayer().realPath))
        except Tf.ErrorException as error:
            unresolved = [said_by(error)]
        for path in unresolved:
            yield Finding(1, f"unresolved asset {path}")


def one_component_root(stage: Any) -> Iterator[Finding]:
    """Property 2: one root prim, which is the default prim, an Xform, kind component (a shot: assembly)."""
    roots = [p for p in stage.GetPseudoRoot().GetAllChildren() if p.IsDefined() and not p.IsAbstract()]
    kind = ROOT_KIND[kind_of(stage)]
    if len(roots) != 1:
        remedy = "put everything below one root prim"
        yield Finding(2, f"{len(roots)} defined root prims, expected one", remedy=remedy)
    for root in roots[:1]:
        path = str(root.GetPath())
        if stage.GetDefaultPrim() != root:
            yield Finding(2, "the root is not the default prim", path)
        if not root.IsA(UsdGeom.Xform):
            yield Finding(2, f'the root is of type "{root.GetTypeName()}", expected Xform', path)
        if root.GetKind() != kind:
            yield Finding(2, f'kind is "{root.GetKind()}", expected {kind}', path)


def units_and_times_authored(stage: Any) -> Iterator[Finding]:
    """Property 3: up axis, one metre per unit, both rates, start and end authored on the root layer.

    Z is up, but in a package Y.
    """
    head = stage.GetRootLayer().pseudoRoot
    for key, expected in (("upAxis", UP_AXIS[kind_of(stage)]), ("metersPerUnit", 1.0)):
        if not head.HasInfo(key) or head.GetInfo(key) != expected:
            found = f", but {head.GetInfo(key)}" if head.HasInfo(key) else ""
            yield Finding(3, f"{key} is not authored as {expected}{found}")
    for key in ("timeCodesPerSecond", "framesPerSecond", "startTimeCode", "endTimeCode"):
        if not head.HasInfo(key):
            yield Finding(3, f"{key} is not authored")


def rates_agree(stage: Any) -> Iterator[Finding]:
    """Property 4: both rates are equal, and 24 unless the provenance says otherwise.

    A shot, which has no provenance, may have any rate.
    """
    shot = kind_of(stage) is StageKind.SHOT
    said = stage.GetTimeCodesPerSecond() if shot else _facts(stage).get("fps", DEFAULT_RATE)
    wanted = float(said) if isinstance(said, int | float) else DEFAULT_RATE
    for name, rate in (
        ("timeCodesPerSecond", stage.GetTimeCodesPerSecond()),
        ("framesPerSecond", stage.GetFramesPerSecond()),
    ):
        if rate != wanted:
            yield Finding(4, f"{name} is {rate:g}, expected {wanted:g}")


def only_relative_paths(stage: Any) -> Iterator[Finding]:
    """Property 6: only relative asset paths that stay in the folder, so that it can be moved."""
    for layer in stage.GetUsedLayers():
        if layer == stage.GetSessionLayer():
            continue
        paths = {*layer.GetCompositionAssetDependencies(), *layer.GetExternalAssetDependencies()}
        for path in sorted(path for path in paths if ABSOLUTE.match(path)):
            yield Finding(6, f"absolute path {path}", layer.identifier)
    for attribute in attributes_of(stage):
        for path in _asset_paths(attribute):
            if ABSOLUTE.match(path):
                yield Finding(6, f"absolute path {path}", str(attribute.GetPath()))
    identifier = _root_info(stage).get("identifier")
    if isinstance(identifier, Sdf.AssetPath) and ABSOLUTE.match(identifier.path):
        yield Finding(6, f"absolute identifier {identifier.path}")
    yield from _reaching_out(stage)


def _asset_paths(attribute: Any) -> list[str]:
    """Paths that an attribute holds, over all samples."""
    if attribute.GetTypeName().scalarType != Sdf.ValueTypeNames.Asset:
        return []
    values = [attribute.Get(), *(attribute.Get(time) for time in attribute.GetTimeSamples())]
    found = [[value] if isinstance(value, Sdf.AssetPath) else value or [] for value in values]
    return sorted({str(path.path) for paths in found for path in paths})


def _reaching_out(stage: Any) -> Iterator[Finding]:
    """Layers that lie outside the folder of the stage's file, where a copy of the folder lacks them.

    A shot may bring sculptures from anywhere.
    """
    opened = stage.GetRootLayer().realPath
    if not opened or kind_of(stage) is StageKind.SHOT:
        return
    for path in (layer.realPath for layer in stage.GetUsedLayers()):
        if path and not Path(path).is_relative_to(Path(opened).parent):
            yield Finding(6, f"a layer outside the folder of the stage: {path}")


def nothing_undefined(stage: Any) -> Iterator[Finding]:
    """Property 7: no typeless def, no dangling over."""
    for prim in stage.TraverseAll():
        if prim.IsAbstract():
            continue
        if prim.GetSpecifier() == Sdf.SpecifierOver:
            yield Finding(7, "an over that nothing defines", str(prim.GetPath()))
        elif not prim.GetTypeName():
            yield Finding(7, "a def without type", str(prim.GetPath()))


def provenance_complete(stage: Any) -> Iterator[Finding]:
    """Property 9: provenance complete and free of facts of the run; asset name and identifier."""
    for problem in problems(_facts(stage), COMPLETE):
        yield Finding(9, problem)
    for key in ("name", "identifier"):
        if not _root_info(stage).get(key):
            yield Finding(9, f"assetInfo has no {key}", str(stage.GetDefaultPrim().GetPath()))


def no_animated_visibility(stage: Any) -> Iterator[Finding]:
    """Property 11: no animated visibility, which DCC tools ignore."""
    for attribute in attributes_of(stage):
        if attribute.GetName() == UsdGeom.Tokens.visibility and attribute.GetNumTimeSamples():
            yield Finding(11, "visibility has time samples", str(attribute.GetPath()))


def _facts(stage: Any) -> dict[str, Any]:
    """The package's provenance: that of the root layer, or of the asset that it lies over."""
    for layer in stage.GetLayerStack(includeSessionLayers=False):
        facts = layer.customLayerData.get(KEY)
        if isinstance(facts, dict):
            return facts
    return {}


def _root_info(stage: Any) -> dict[str, Any]:
    """The asset info of the default prim."""
    root = stage.GetDefaultPrim()
    return dict(root.GetAssetInfo()) if root else {}
