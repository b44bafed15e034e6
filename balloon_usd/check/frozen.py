"""Single frames of a stage, held still: validators skip what moves."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf
from balloon_usd.stage.properties.reading import clouds_of, meshes_of

if TYPE_CHECKING:
    from collections.abc import Iterator


def frames_to_freeze(stage: Any) -> list[float]:
    """Time codes of the first, middle and last sample of anything's points; none for what does not move."""
    times = sorted(
        {t for s in (*meshes_of(stage), *clouds_of(stage)) for t in s.GetPointsAttr().GetTimeSamples()}
    )
    return sorted({times[0], times[len(times) // 2], times[-1]}) if times else []


@contextmanager
def frozen(stage: Any, time_code: float) -> Iterator[Any]:
    """Hold a stage at a time code within the block: every attribute with samples has one default instead.

    The defaults stand in a layer over the session layer's, so that nothing of the frame is copied but its
    values, and the stage is as before afterwards.
    """
    session = stage.GetSessionLayer()
    still = Sdf.Layer.CreateAnonymous("still.usda")
    moving = [
        (a, a.Get(time_code))
        for p in stage.TraverseAll()
        for a in p.GetAuthoredAttributes()
        if a.GetNumTimeSamples()
    ]
    with Sdf.ChangeBlock():
        for attribute, value in moving:
            prim = Sdf.CreatePrimInLayer(still, attribute.GetPrim().GetPath())
            spec = Sdf.AttributeSpec(prim, attribute.GetName(), attribute.GetTypeName())
            spec.default = value
    session.subLayerPaths.insert(0, still.identifier)
    try:
        yield stage
    finally:
        session.subLayerPaths.remove(still.identifier)
