"""Properties 8 and 10: how large the sculpture is, and whether the stage says so."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import attributes_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

SMALLEST, LARGEST = 0.02, 20.0
"""Plausible diagonals of a sculpture [m]: from one bubble of a 160 to an arch of many balloons."""

SAME = 1e-6
"""Two extents are the same within this fraction of their size (float32 rounding)."""


def plausible_size(stage: Any) -> Iterator[Finding]:
    """Property 8: the size in metres is plausible."""
    with np.errstate(invalid="ignore", over="ignore"):
        low, high = whole_extent(stage, placed=True) * UsdGeom.GetStageMetersPerUnit(stage)
        diagonal = float(np.linalg.norm(high - low))
    if not SMALLEST <= diagonal <= LARGEST:
        yield Finding(8, f"diagonal is {diagonal:.3g} m, expected {SMALLEST} to {LARGEST} m")


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


def whole_extent(stage: Any, *, placed: bool = False) -> NDArray[np.float64]:
    """Smallest and largest corner (2, 3) of everything that some look shows, over all samples, or zeros.

    `placed`: where the root prim's own transformation puts it.
    """
    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    times = {t for a in attributes_of(stage) if a.GetName() == "extent" for t in a.GetTimeSamples()}
    purposes = [UsdGeom.Tokens.default_, UsdGeom.Tokens.render]
    cache = UsdGeom.BBoxCache(0.0, purposes, useExtentsHint=False, ignoreVisibility=True)
    bound = cache.ComputeLocalBound if placed else cache.ComputeUntransformedBound
    corners = []
    for time in sorted(times) or [stage.GetStartTimeCode()]:
        cache.SetTime(time)
        box = bound(root).ComputeAlignedRange()
        if not box.IsEmpty():
            corners.append([box.GetMin(), box.GetMax()])
    if not corners:
        return np.zeros((2, 3))
    whole = np.array(corners, dtype=np.float64)
    return np.stack([whole[:, 0].min(axis=0), whole[:, 1].max(axis=0)])
