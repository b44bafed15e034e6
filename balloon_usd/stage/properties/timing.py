"""Properties 5, 17 to 19 and 24: what moves, when, and how fast."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom

from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import (
    clouds_of,
    is_float,
    meshes_of,
    prims_of,
    samples_of,
    value_at,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

FASTEST = 5.0
"""Speed [m/s] above which a point jumps: hands move at 0.4 m/s, rubber let go at a few times that."""

VELOCITY_FACTOR = 2.0
"""Velocities per frame instead of per second are wrong by the rate, far more than this factor."""

STILL = 1e-4
"""Speed [m/s] below which velocities are not compared."""


def one_sample_per_time_code(stage: Any) -> Iterator[Finding]:
    """Property 5: one points sample per whole time code of the range, the same times on its fellows.

    Primvars of particles may be sampled where they change, if what readers blend stands still between.
    """
    expected = np.arange(stage.GetStartTimeCode(), stage.GetEndTimeCode() + 1.0)
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        path = str(shape.GetPath())
        times = np.asarray(shape.GetPointsAttr().GetTimeSamples())
        if not np.array_equal(times, expected):
            wrong = sorted({*times.tolist()} ^ {*expected.tolist()})
            when = wrong[0] if wrong else None
            yield Finding(5, f"{len(times)} points samples, expected {len(expected)}", path, when)
        if not np.array_equal(shape.GetExtentAttr().GetTimeSamples(), times):
            yield Finding(5, "extent has other times than points", path)
        seldom = isinstance(shape, UsdGeom.Points)
        primvars = [v.GetAttr() for v in UsdGeom.PrimvarsAPI(shape).GetPrimvars()]
        for attribute in (shape.GetVelocitiesAttr(), *primvars):
            found = attribute.GetTimeSamples()
            if seldom and attribute in primvars and {*found} <= {*times.tolist()}:
                yield from _blends(attribute)
            elif found and not np.array_equal(found, times):
                yield Finding(5, "has other times than points", str(attribute.GetPath()))


def _blends(attribute: Any) -> Iterator[Finding]:
    """Values that are blended over more than one time code, where they should jump."""
    for (before, old), (time, new) in pairwise(samples_of(attribute)):
        if is_float(new) and (time or 0.0) - (before or 0.0) > 1.0 and not np.array_equal(old, new):
            yield Finding(5, "changes between samples that are far apart", str(attribute.GetPath()), time)


def static_topology(stage: Any) -> Iterator[Finding]:
    """Property 17: topology is not time-sampled, nor who the particles are and how large."""
    for mesh in meshes_of(stage):
        for attribute in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()):
            if attribute.GetNumTimeSamples():
                yield Finding(17, "has time samples", str(attribute.GetPath()))
    for cloud in clouds_of(stage):
        for attribute in (cloud.GetIdsAttr(), cloud.GetWidthsAttr()):
            if attribute.GetNumTimeSamples():
                yield Finding(17, "has time samples", str(attribute.GetPath()))
    for subset in prims_of(stage, UsdGeom.Subset):
        if subset.GetIndicesAttr().GetNumTimeSamples():
            yield Finding(17, "has time samples", str(subset.GetIndicesAttr().GetPath()))


def velocities_true(stage: Any) -> Iterator[Finding]:
    """Property 18: velocities are absent, or per second and within a factor 2 of the finite difference."""
    rate = stage.GetTimeCodesPerSecond()
    for shape in (*meshes_of(stage), *clouds_of(stage)):
        velocities = shape.GetVelocitiesAttr()
        if not velocities.HasAuthoredValue():
            continue
        path = str(velocities.GetPath())
        for (before, old), (time, new) in pairwise(samples_of(shape.GetPointsAttr())):
            found = value_at(velocities, time)
            if found.shape != new.shape or old.shape != new.shape:
                yield Finding(18, "velocities do not fit the points", path, time)
                continue
            true = _root_mean_square(new - old) * rate / ((time or 0.0) - (before or 0.0))
            speed = _root_mean_square(found)
            if true > STILL and not 1.0 / VELOCITY_FACTOR <= speed / true <= VELOCITY_FACTOR:
                yield Finding(18, f"speed is {speed:.3g} m/s, expected about {true:.3g} m/s", path, time)


def no_teleport(stage: Any) -> Iterator[Finding]:
    """Property 19: no point jumps between frames."""
    rate = stage.GetTimeCodesPerSecond()
    for mesh in meshes_of(stage):
        for (before, old), (time, new) in pairwise(samples_of(mesh.GetPointsAttr())):
            if old.shape != new.shape or not len(new):
                continue
            seconds = ((time or 0.0) - (before or 0.0)) / rate
            speed = float(np.linalg.norm(new - old, axis=1).max()) / seconds
            if speed > FASTEST:
                text = f"a point moves at {speed:.3g} m/s, more than {FASTEST:g} m/s"
                yield Finding(19, text, str(mesh.GetPath()), time)


def default_is_last(stage: Any) -> Iterator[Finding]:
    """Property 24: default points equal the last sample, so still viewers show the finished sculpture.

    So do the clusters and colours of particles.
    """
    moving = [(mesh.GetPointsAttr(), "points") for mesh in meshes_of(stage)]
    for cloud in clouds_of(stage):
        moving += [(v.GetAttr(), v.GetPrimvarName()) for v in UsdGeom.PrimvarsAPI(cloud).GetPrimvars()]
        moving.append((cloud.GetPointsAttr(), "points"))
    for attribute, name in moving:
        times = attribute.GetTimeSamples()
        if times and not np.array_equal(value_at(attribute, None), value_at(attribute, times[-1])):
            text = f"default {name} differ from the last sample"
            yield Finding(24, text, str(attribute.GetPrim().GetPath()))


def _root_mean_square(vectors: Any) -> float:
    return float(np.sqrt(np.mean(np.sum(np.square(vectors, dtype=np.float64), axis=1))))
