"""Reading a stage: its prims by kind, and attributes sample by sample."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, Usd, UsdGeom
from balloon_usd.stage.component import in_component
from balloon_usd.stage.properties.kinds import StageKind, kind_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray


def prims_of(stage: Any, schema: Any) -> list[Any]:
    """Active, loaded, defined prims of a schema, wrapped in it, in the order of the stage.

    Those with values of other types than the schema's are left out: nothing holds of them.
    """
    return [schema(prim) for prim in stage.Traverse() if prim.IsA(schema) and not any(mistyped(prim))]


def mistyped(prim: Any) -> Iterator[tuple[str, str, str]]:
    """Attributes that a layer gives another type than the prim's schema: path, that type, the schema's."""
    definition = prim.GetPrimDefinition()
    for attribute in prim.GetAuthoredAttributes():
        meant = definition.GetAttributeDefinition(attribute.GetName())
        for spec in attribute.GetPropertyStack() if meant else ():
            wanted = meant.GetTypeName()
            if not isinstance(spec, Sdf.AttributeSpec):
                yield str(attribute.GetPath()), "rel", str(wanted)
            elif spec.typeName.type != wanted.type:
                yield str(attribute.GetPath()), str(spec.typeName), str(wanted)


def meshes_of(stage: Any) -> list[Any]:
    """All meshes."""
    return prims_of(stage, UsdGeom.Mesh)


def clouds_of(stage: Any) -> list[Any]:
    """All points, such as the particles of air."""
    return prims_of(stage, UsdGeom.Points)


def sculpted(stage: Any, shapes: list[Any]) -> list[Any]:
    """Those of the shapes that belong to a sculpture: in a shot what stands in components, else all."""
    if kind_of(stage) is not StageKind.SHOT:
        return shapes
    return [shape for shape in shapes if in_component(shape.GetPrim())]


def attributes_of(stage: Any) -> Iterator[Any]:
    """All authored attributes of all prims."""
    for prim in stage.TraverseAll():
        yield from prim.GetAuthoredAttributes()


def samples_of(attribute: Any) -> Iterator[tuple[float | None, NDArray[Any]]]:
    """Time code and value of each sample, empty if blocked; one value at None where there are no samples."""
    times = attribute.GetTimeSamples()
    for time in times:
        yield time, value_at(attribute, time)
    if not times and attribute.HasValue():
        yield None, value_at(attribute, None)


def value_at(attribute: Any, time_code: float | None) -> NDArray[Any]:
    """Value at a time code, or the default; empty where there is none."""
    value = attribute.Get(Usd.TimeCode.Default() if time_code is None else time_code)
    return np.asarray([] if value is None else value)


def first_value(attribute: Any) -> NDArray[Any]:
    """Earliest value, empty where there is none."""
    return next((value for _, value in samples_of(attribute)), np.asarray([]))


def is_float(values: NDArray[Any]) -> bool:
    """Whether the values are floating-point numbers."""
    return bool(values.dtype.kind == "f")


Opinions = tuple[tuple[str, str, float, float], ...]
"""Where a value comes from: layer, path in it, offset and scale of its time, from strong to weak."""


def opinions_on(*attributes: Any) -> Opinions:
    """Where the values of attributes come from: what is equal for two variants has equal values."""
    return tuple(
        (spec.layer.identifier, str(spec.path), offset.offset, offset.scale)
        for attribute in attributes
        for spec, offset in attribute.GetPropertyStackWithLayerOffsets(Usd.TimeCode.Default())
    )
