"""Property 31: a flattened stage equals the composed one, frame by frame, so that memory stays flat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, Usd
from balloon_usd.stage.properties import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator


def flattened_equals_composed(stage: Any) -> Iterator[Finding]:
    """Property 31: prims and values of a stage that stands still are the same once it is flattened.

    Instances are not: their prototypes become roots of their own.
    """
    layer = stage.Flatten()
    flat = Usd.Stage.Open(layer)
    paths = [{prim.GetPath() for prim in one.Traverse()} for one in (stage, flat)]
    own = {prim.GetPath() for prim in stage.GetPseudoRoot().GetAllChildren()}
    paths[1] |= {root.path for root in layer.rootPrims} - own
    for path in sorted(paths[0] ^ paths[1]):
        what = "gets lost when the stage is flattened" if path in paths[0] else "appears once it is flattened"
        yield Finding(31, what, str(path))
    for path in sorted(paths[0] & paths[1]):
        yield from _differences(stage.GetPrimAtPath(path), flat.GetPrimAtPath(path))


def _differences(one: Any, other: Any) -> Iterator[Finding]:
    if (one.GetTypeName(), one.GetKind()) != (other.GetTypeName(), other.GetKind()):
        yield Finding(31, "is of another type or kind once the stage is flattened", str(one.GetPath()))
    for attribute in one.GetAuthoredAttributes():
        twin = other.GetAttribute(attribute.GetName())
        if not twin or not _equal(attribute.Get(), twin.Get()):
            yield Finding(31, "is another value once the stage is flattened", str(attribute.GetPath()))


def _equal(one: Any, other: Any) -> bool:
    if isinstance(one, Sdf.AssetPath):
        # Flattening anchors paths; what they lead to counts.
        return isinstance(other, Sdf.AssetPath) and str(one.resolvedPath) == str(other.resolvedPath)
    if one is None or other is None:
        return one is other
    first, second = np.asarray(one), np.asarray(other)
    if first.dtype.kind == "f" == second.dtype.kind:
        return np.array_equal(first, second, equal_nan=True)
    return bool(one == other) if first.dtype.kind == "O" else np.array_equal(first, second)
