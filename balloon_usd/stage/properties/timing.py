"""Properties 5, 17 to 19 and 24: what moves, when, and how fast."""

from __future__ import annotations

from itertools import pairwise
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.stage.animated import ON_MESH
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.kinds import StageKind, kind_of
from balloon_usd.stage.properties.reading import (
    attributes_of,
    clouds_of,
    is_float,
    meshes_of,
    prims_of,
    samples_of,
    sculpted,
    value_at,
)
from balloon_usd.stage.properties.still import is_still

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.stage.properties.shape import Moment

FASTEST = 5.0
"""Speed [m/s] above which a point jumps: hands move at 0.4 m/s, rubber let go at a few times that."""

VELOCITY_FACTOR = 2.0
"""Velocities per frame instead of per second are wrong by the rate, far more than this factor."""

STILL = 1e-4
"""Speed [m/s] below which velocities are not compared."""

MOVING = frozenset(animated.name for animated in ON_MESH)
"""Attributes of a mesh that have samples wherever its points have."""


def one_sample_per_time_code(stage: Any) -> Iterator[Finding]:
    """Property 5: one points sample per whole time code of the range, the same times on its fellows.

    Primvars of particles may be sampled where they change, if what readers blend stands still between.
    The finished sculpture alone has no samples. In a shot a sculpture may come earlier or later.
    """
    shot = kind_of(stage) is StageKind.SHOT
    for shape in sculpted(stage, [*meshes_of(stage), *clouds_of(stage)]):
        path = str(shape.GetPath())
        times = np.asarray(shape.GetPointsAttr().GetTimeSamples())
        if is_still(shape.GetPrim()):
            if len(times):
                yield Finding(5, f"{len(times)} points samples in a still", path, float(times[0]))
        elif not shot:
            yield from _gaps(times, stage.GetStartTimeCode(), stage.GetEndTimeCode(), path)
        yield from _other_times(shape, times)


def _gaps(times: Any, start: float, end: float, path: str) -> Iterator[Finding]:
    """Time codes without a sample, and samples without a whole time code of the range."""
    if not (isfinite(start) and isfinite(end)):
        yield Finding(5, f"the range is {start:g} to {end:g}", path)
        return
    expected = max(0, int(end - start) + 1)
    if len(times) == expected and np.array_equal(times, start + np.arange(expected)):
        return
    wrong = times[(times < start) | (times > end) | ((times - start) % 1.0 != 0.0)]
    if len(wrong):
        when: float | None = float(wrong[0])
    else:
        # As many as there are samples is enough to come to the first that is missing.
        missing = np.setdiff1d(start + np.arange(min(expected, len(times) + 1)), times)
        when = float(missing[0]) if len(missing) else None
    yield Finding(5, f"{len(times)} points samples, expected {float(expected):.10g}", path, when)


def _other_times(shape: Any, times: Any) -> Iterator[Finding]:
    """Attributes of a shape that are sampled at other times than its points."""
    if not np.array_equal(shape.GetExtentAttr().GetTimeSamples(), times):
        yield Finding(5, "extent has other times than points", str(shape.GetPath()))
    seldom = isinstance(shape, UsdGeom.Points)
    primvars = _primvars(shape)
    for attribute in (shape.GetVelocitiesAttr(), *primvars):
        found = attribute.GetTimeSamples()
        if seldom and attribute in primvars and {*found} <= {*times.tolist()}:
            yield from _blends(attribute)
        elif (found or attribute.GetName() in MOVING) and not np.array_equal(found, times):
            yield Finding(5, "has other times than points", str(attribute.GetPath()))


def _primvars(shape: Any) -> list[Any]:
    """Attributes with the values and indices of the primvars of a shape."""
    primvars = UsdGeom.PrimvarsAPI(shape).GetAuthoredPrimvars()
    return [*(v.GetAttr() for v in primvars), *(v.GetIndicesAttr() for v in primvars if v.IsIndexed())]


def _blends(attribute: Any) -> Iterator[Finding]:
    """Values that are blended over more than one time code, where they should jump."""
    for (before, old), (time, new) in pairwise(samples_of(attribute)):
        if is_float(new) and (time or 0.0) - (before or 0.0) > 1.0 and not np.array_equal(old, new):
            yield Finding(5, "changes between samples that are far apart", str(attribute.GetPath()), time)


def no_hidden_samples(stage: Any) -> Iterator[Finding]:
    """Property 5: no default hides the samples of a weaker layer."""
    for attribute in attributes_of(stage):
        if attribute.GetNumTimeSamples():
            continue
        stack = attribute.GetPropertyStack()
        hidden = next((s for s in stack[1:] if s.layer.GetNumTimeSamplesForPath(s.path)), None)
        if hidden is not None:
            where, below = stack[0].layer.GetDisplayName(), hidden.layer.GetDisplayName()
            text = f"a default in {where} hides the samples in {below}"
            remedy = "remove the default, or put the layer with the samples above the one with the default"
            yield Finding(5, text, str(attribute.GetPath()), remedy=remedy)


def static_topology(stage: Any) -> Iterator[Finding]:
    """Property 17: topology is not time-sampled, nor who the particles are and how large."""
    fixed = [a for m in meshes_of(stage) for a in (m.GetFaceVertexCountsAttr(), m.GetFaceVertexIndicesAttr())]
    fixed += [a for c in clouds_of(stage) for a in (c.GetIdsAttr(), c.GetWidthsAttr())]
    fixed += [subset.GetIndicesAttr() for subset in prims_of(stage, UsdGeom.Subset)]
    for attribute in fixed:
        if attribute.GetNumTimeSamples():
            yield Finding(17, "has time samples", str(attribute.GetPath()))


def velocities_true(moment: Moment) -> Iterator[Finding]:
    """Property 18: velocities are absent, or per second and within a factor 2 of the finite difference."""
    velocities = moment.shape.schema.GetVelocitiesAttr()
    if moment.before is None or not velocities.HasAuthoredValue():
        return
    path, old, new = str(velocities.GetPath()), moment.before.points, moment.points
    found = moment.value(velocities)
    if found.shape != new.shape or old.shape != new.shape:
        yield Finding(18, "velocities do not fit the points", path, moment.time_code)
        return
    true = _root_mean_square(new - old) / moment.seconds
    speed = _root_mean_square(found)
    if true > STILL and not 1.0 / VELOCITY_FACTOR <= speed / true <= VELOCITY_FACTOR:
        text = f"speed is {speed:.3g} m/s, expected about {true:.3g} m/s"
        yield Finding(18, text, path, moment.time_code)


def no_teleport(moment: Moment) -> Iterator[Finding]:
    """Property 19: no point jumps between frames."""
    before = moment.before
    if before is None or before.points.shape != moment.points.shape or not len(moment.points):
        return
    step = moment.points - before.points
    squares = np.einsum("ij,ij->i", step, step)
    farthest = int(np.argmax(squares))
    speed = float(np.sqrt(squares[farthest])) * moment.shape.metre / moment.seconds
    if speed > FASTEST:
        text = f"point {farthest} moves at {speed:.3g} m/s, more than {FASTEST:g} m/s"
        yield Finding(19, text, moment.shape.path, moment.time_code)


def default_is_last(stage: Any) -> Iterator[Finding]:
    """Property 24: default points equal the last sample, so still viewers show the finished sculpture.

    So do the extent and the primvars.
    """
    for shape in sculpted(stage, [*meshes_of(stage), *clouds_of(stage)]):
        for attribute in (shape.GetPointsAttr(), shape.GetExtentAttr(), *_primvars(shape)):
            times = attribute.GetTimeSamples()
            if times and not np.array_equal(value_at(attribute, None), value_at(attribute, times[-1])):
                name = attribute.GetName().removeprefix("primvars:")
                text = f"default {name} differ from the last sample"
                yield Finding(24, text, str(attribute.GetPrim().GetPath()))


def _root_mean_square(vectors: Any) -> float:
    return float(np.sqrt(np.mean(np.sum(np.square(vectors, dtype=np.float64), axis=1))))
