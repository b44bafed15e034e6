"""Properties 5, 17 to 19 and 24: what moves, when, and how fast."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom

from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.reading import meshes_of, prims_of, samples_of, value_at

if TYPE_CHECKING:
    from collections.abc import Iterator

FASTEST = 5.0
"""Speed [m/s] above which a point jumps: hands move at 0.4 m/s, rubber let go at a few times that."""

VELOCITY_FACTOR = 2.0
"""Velocities per frame instead of per second are wrong by the rate, far more than this factor."""

STILL = 1e-4
"""Speed [m/s] below which velocities are not compared."""


def one_sample_per_time_code(stage: Any) -> Iterator[Finding]:
    """Property 5: one points sample per whole time code of the range, the same times on its fellows."""
    expected = np.arange(stage.GetStartTimeCode(), stage.GetEndTimeCode() + 1.0)
    for mesh in meshes_of(stage):
        path = str(mesh.GetPath())
        times = np.asarray(mesh.GetPointsAttr().GetTimeSamples())
        if not np.array_equal(times, expected):
            wrong = sorted({*times.tolist()} ^ {*expected.tolist()})
            when = wrong[0] if wrong else None
            yield Finding(5, f"{len(times)} points samples, expected {len(expected)}", path, when)
        if not np.array_equal(mesh.GetExtentAttr().GetTimeSamples(), times):
            yield Finding(5, "extent has other times than points", path)
        primvars = [v.GetAttr() for v in UsdGeom.PrimvarsAPI(mesh).GetPrimvars()]
        for attribute in (mesh.GetVelocitiesAttr(), *primvars):
            found = attribute.GetTimeSamples()
            if found and not np.array_equal(found, times):
                yield Finding(5, "has other times than points", str(attribute.GetPath()))


def static_topology(stage: Any) -> Iterator[Finding]:
    """Property 17: topology is not time-sampled."""
    for mesh in meshes_of(stage):
        for attribute in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()):
            if attribute.GetNumTimeSamples():
                yield Finding(17, "has time samples", str(attribute.GetPath()))
    for subset in prims_of(stage, UsdGeom.Subset):
        if subset.GetIndicesAttr().GetNumTimeSamples():
            yield Finding(17, "has time samples", str(subset.GetIndicesAttr().GetPath()))


def velocities_true(stage: Any) -> Iterator[Finding]:
    """Property 18: velocities are absent, or per second and within a factor 2 of the finite difference."""
    rate = stage.GetTimeCodesPerSecond()
    for mesh in meshes_of(stage):
        velocities = mesh.GetVelocitiesAttr()
        if not velocities.HasAuthoredValue():
            continue
        path = str(velocities.GetPath())
        for (before, old), (time, new) in pairwise(samples_of(mesh.GetPointsAttr())):
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
    """Property 24: default points equal the last sample, so still viewers show the finished sculpture."""
    for mesh in meshes_of(stage):
        points = mesh.GetPointsAttr()
        times = points.GetTimeSamples()
        default = value_at(points, None)
        if times and not np.array_equal(default, value_at(points, times[-1])):
            yield Finding(24, "default points differ from the last sample", str(mesh.GetPath()))


def _root_mean_square(vectors: Any) -> float:
    return float(np.sqrt(np.mean(np.sum(np.square(vectors, dtype=np.float64), axis=1))))
