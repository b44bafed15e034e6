"""Every sample of a stage, looked at once, by all properties that want to see it."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom

from balloon_usd.stage.properties.reading import (
    Opinions,
    attributes_of,
    clouds_of,
    meshes_of,
    opinions_on,
    sculpted,
    value_at,
)
from balloon_usd.stage.properties.shape import Moment, Shape, Value

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from balloon_usd.stage.properties.finding import Finding

    OfValue = Callable[[Value], Iterator[Finding]]
    AtMoment = Callable[[Moment], Iterator[Finding]]
    Times = Sequence[float | None]
    Job = Callable[[], list[Finding]]

TOGETHER = 16
"""Samples that a thread looks at one after another; the one before them is read once more."""


def look_at_samples(
    stage: Any, of_values: Sequence[OfValue], at_moments: Sequence[AtMoment], seen: set[Opinions]
) -> list[Finding]:
    """Findings of all samples and defaults; memory does not grow with their number.

    Args:
        stage: an open stage, which must not be edited meanwhile.
        of_values: look at one value of one attribute.
        at_moments: look at one mesh or cloud of points at one sample of its points.
        seen: opinions that were looked at already, as in another variant; those of this stage are added.
    """
    shapes = {shape.path: shape for shape in shapes_of(stage)}
    fresh = {path for path, shape in shapes.items() if _is_new(shape.opinions(), seen)}
    jobs: list[Job] = []
    for attribute in attributes_of(stage):
        path = str(attribute.GetPrim().GetPath())
        opinions = opinions_on(attribute)
        if path in fresh or _is_new(opinions, seen):
            seen.add(opinions)
            times = [*attribute.GetTimeSamples(), None]
            jobs += [partial(_look, attribute, part, shapes.get(path), of_values) for part in _parts(times)]
    for path in fresh:
        shape = shapes[path]
        times = shape.schema.GetPointsAttr().GetTimeSamples() or [None]
        starts = range(0, len(times), TOGETHER)
        jobs += [partial(_follow, shape, times, start, at_moments) for start in starts]
    return _done(jobs)


def shapes_of(stage: Any) -> list[Shape]:
    """All meshes and clouds of points."""
    found = [*meshes_of(stage), *clouds_of(stage)]
    of_sculptures = {str(schema.GetPath()) for schema in sculpted(stage, found)}
    rate, metre = stage.GetTimeCodesPerSecond(), UsdGeom.GetStageMetersPerUnit(stage)
    return [
        Shape(schema, str(schema.GetPath()) in of_sculptures, rate or 1.0, metre or 1.0) for schema in found
    ]


def _is_new(opinions: Opinions, seen: set[Opinions]) -> bool:
    new = opinions not in seen
    seen.add(opinions)
    return new


def _parts(times: Times) -> list[Times]:
    return [times[start : start + TOGETHER] for start in range(0, len(times), TOGETHER)]


def _look(attribute: Any, times: Times, shape: Shape | None, of_values: Sequence[OfValue]) -> list[Finding]:
    """Findings of values of an attribute."""
    values = (Value(attribute, time, value_at(attribute, time), shape) for time in times)
    return [finding for value in values for look in of_values for finding in look(value)]


def _follow(shape: Shape, times: Times, start: int, at_moments: Sequence[AtMoment]) -> list[Finding]:
    """Findings of a shape at some samples of its points, from the one with the number `start` on."""
    points = shape.schema.GetPointsAttr()
    before = None
    findings: list[Finding] = []
    for number in range(max(0, start - 1), min(start + TOGETHER, len(times))):
        # The moment before keeps none before it, or all would be kept.
        positions = value_at(points, times[number]).reshape(-1, 3)
        moment = Moment(shape, times[number], positions, before)
        if number >= start:
            with np.errstate(invalid="ignore", over="ignore"):
                findings += [finding for look in at_moments for finding in look(moment)]
        before = Moment(shape, times[number], positions)
    return findings


def _done(jobs: Sequence[Job]) -> list[Finding]:
    """Do the jobs side by side: NumPy leaves the interpreter free for another thread."""
    threads = ThreadPoolExecutor(min(os.cpu_count() or 1, max(1, len(jobs))))
    try:
        return [finding for findings in threads.map(lambda job: job(), jobs) for finding in findings]
    finally:
        threads.shutdown(cancel_futures=True)
