"""Reading a stage: its prims by kind, and attributes sample by sample."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Usd, UsdGeom

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray


def prims_of(stage: Any, schema: Any) -> list[Any]:
    """Active, loaded, defined prims of a schema, wrapped in it, in the order of the stage."""
    return [schema(prim) for prim in stage.Traverse() if prim.IsA(schema)]


def meshes_of(stage: Any) -> list[Any]:
    """All meshes."""
    return prims_of(stage, UsdGeom.Mesh)


def clouds_of(stage: Any) -> list[Any]:
    """All points, such as the particles of air."""
    return prims_of(stage, UsdGeom.Points)


def attributes_of(stage: Any) -> Iterator[Any]:
    """All authored attributes of all prims."""
    for prim in stage.TraverseAll():
        yield from prim.GetAuthoredAttributes()


def samples_of(attribute: Any) -> Iterator[tuple[float | None, NDArray[Any]]]:
    """Time code and value of each sample; one value at None where there are no samples."""
    times = attribute.GetTimeSamples()
    for time in times:
        yield time, np.asarray(attribute.Get(time))
    if not times and attribute.HasValue():
        yield None, np.asarray(attribute.Get())


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
