"""Every sample of a stage, looked at once, by all properties that want to see it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
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


def look_at_samples(
    stage: Any, of_values: Sequence[OfValue], at_moments: Sequence[AtMoment], seen: set[Opinions]
) -> list[Finding]:
    """Findings of all samples and defaults; memory does not grow with their number.

    In one thread: OpenUSD is not safe with more, and reading, which holds the interpreter's lock, takes most
    of the time.

    Args:
        stage: an open stage, which must not be edited meanwhile.
        of_values: look at one value of one attribute.
        at_moments: look at one mesh or cloud of points at one sample of its points.
        seen: opinions that were looked at already, as in another variant; those of this stage are added.
    """
    shapes = {shape.path: shape for shape in shapes_of(stage)}
    fresh = {path for path, shape in shapes.items() if _is_new(shape.opinions(), seen)}
    findings: list[Finding] = []
    for attribute in attributes_of(stage):
        path = str(attribute.GetPrim().GetPath())
        opinions = opinions_on(attribute)
        if path in fresh or _is_new(opinions, seen):
            seen.add(opinions)
            findings += _look(attribute, shapes.get(path), of_values)
    for path in fresh:
        findings += _follow(shapes[path], at_moments)
    return findings


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


def _look(attribute: Any, shape: Shape | None, of_values: Sequence[OfValue]) -> list[Finding]:
    """Findings of the values of an attribute."""
    times = [*attribute.GetTimeSamples(), None]
    values = (Value(attribute, time, value_at(attribute, time), shape) for time in times)
    return [finding for value in values for look in of_values for finding in look(value)]


def _follow(shape: Shape, at_moments: Sequence[AtMoment]) -> list[Finding]:
    """Findings of a shape at the samples of its points."""
    points = shape.schema.GetPointsAttr()
    before = None
    findings: list[Finding] = []
    for time in points.GetTimeSamples() or [None]:
        # The moment before keeps none before it, or all would be kept.
        positions = value_at(points, time).reshape(-1, 3)
        moment = Moment(shape, time, positions, before)
        with np.errstate(invalid="ignore", over="ignore"):
            findings += [finding for look in at_moments for finding in look(moment)]
        before = Moment(shape, time, positions)
    return findings
