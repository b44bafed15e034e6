"""Compare two stages: structure exactly, numbers within a tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Sdf, Usd

from balloon_usd.stage.provenance import KEY

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

HEAD = ("upAxis", "metersPerUnit", "timeCodesPerSecond", "framesPerSecond", "startTimeCode", "endTimeCode")
"""Metadata of the stage that both must have alike."""

DETAILS = ("typeName", "variability", "custom", "interpolation", "elementSize", "documentation")
"""Metadata of a property that both must have alike."""


def differences(one: Any, other: Any, *, tolerance: float | Mapping[str, float] = 0.0) -> Iterator[str]:
    """What differs between two composed stages, a sentence each; variants and arcs do not count.

    Floats may differ by `tolerance` times the larger of 1 and their size (in SI units, so 1e-6 is
    a thousandth of a millimetre in the points); given by name of attribute, others must be equal.
    The asset's identifier is its own file and may differ.
    """
    for key in HEAD:
        if one.GetMetadata(key) != other.GetMetadata(key):
            yield f"{key}: {one.GetMetadata(key)} and {other.GetMetadata(key)}"
    facts = [stage.GetRootLayer().customLayerData.get(KEY) for stage in (one, other)]
    if facts[0] != facts[1]:
        yield f"provenance: {facts[0]} and {facts[1]}"
    prims = [{str(prim.GetPath()): prim for prim in stage.TraverseAll()} for stage in (one, other)]
    for path in sorted({*prims[0]} ^ {*prims[1]}):
        yield f"{path}: only in the {'first' if path in prims[0] else 'second'} stage"
    for path in prims[0]:
        if path in prims[1]:
            yield from _prim_differences(prims[0][path], prims[1][path], tolerance)


def _prim_differences(one: Any, other: Any, tolerance: float | Mapping[str, float]) -> Iterator[str]:
    path = one.GetPath()
    heads = [_head(prim) for prim in (one, other)]
    if heads[0] != heads[1]:
        yield f"{path}: {heads[0]} and {heads[1]}"
    names = [{*p.GetAuthoredPropertyNames()} for p in (one, other)]
    for name in sorted(names[0] ^ names[1]):
        yield f"{path}.{name}: only in the {'first' if name in names[0] else 'second'} stage"
    for name in sorted(names[0] & names[1]):
        if one.GetAttribute(name) and other.GetAttribute(name):
            allowed = tolerance if isinstance(tolerance, float) else tolerance.get(name, 0.0)
            yield from _attribute_differences(one.GetAttribute(name), other.GetAttribute(name), allowed)
        elif _targets(one, name) != _targets(other, name):
            yield f"{path}.{name}: targets differ"


def _attribute_differences(one: Any, other: Any, tolerance: float) -> Iterator[str]:
    path = one.GetPath()
    for key in DETAILS:
        if one.GetMetadata(key) != other.GetMetadata(key):
            yield f"{path}: {key} is {one.GetMetadata(key)} and {other.GetMetadata(key)}"
    if one.GetConnections() != other.GetConnections():
        yield f"{path}: connections differ"
    if one.GetTimeSamples() != other.GetTimeSamples():
        yield f"{path}: times of the samples differ"
        return
    for time in (Usd.TimeCode.Default(), *one.GetTimeSamples()):
        if not _same(one.Get(time), other.Get(time), tolerance):
            yield f"{path}: values differ at {time}{_how_far(one.Get(time), other.Get(time))}"


def _same(one: Any, other: Any, tolerance: float) -> bool:
    if one is None or other is None:
        return one is other
    if isinstance(one, Sdf.AssetPath) and isinstance(other, Sdf.AssetPath):
        # Where the file lies is another matter than how the stage names it.
        return str(one.path) == str(other.path)
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape or first.dtype != second.dtype:
        return False
    if first.dtype.kind == "f" and tolerance > 0.0:
        return np.allclose(first, second, rtol=tolerance, atol=tolerance)
    return np.array_equal(first, second)


def _how_far(one: Any, other: Any) -> str:
    """Say by how much two arrays of floats differ at most."""
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape or first.dtype.kind != "f" or second.dtype.kind != "f":
        return ""
    return f" by up to {np.abs(first - second).max():.3g}"


def _head(prim: Any) -> tuple[Any, ...]:
    """What a prim is, apart from its properties."""
    asset_info = {key: value for key, value in prim.GetAssetInfo().items() if key != "identifier"}
    schemas = prim.GetAppliedSchemas()
    return prim.GetSpecifier(), prim.GetTypeName(), prim.GetKind(), schemas, asset_info, prim.GetCustomData()


def _targets(prim: Any, name: str) -> Any:
    relationship = prim.GetRelationship(name)
    return relationship.GetTargets() if relationship else None
