"""Values of an attribute as readers see them: those of an indexed primvar are one for each element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Usd, UsdGeom

if TYPE_CHECKING:
    from numpy.typing import NDArray

INDICES = ":indices"
"""End of the name of the attribute with the indices of a primvar."""


class Flattened:
    """The values of one attribute over time."""

    def __init__(self, attribute: Any) -> None:
        """Look at an attribute of an open stage."""
        self._values = Usd.AttributeQuery(attribute)
        indices = indices_of(attribute)
        self._indices = Usd.AttributeQuery(indices) if indices else None
        self._size = UsdGeom.Primvar(attribute).GetElementSize() if indices else 1

    def times(self) -> list[float]:
        """Return the time codes of the samples of values and indices."""
        found: list[float] = self._values.GetTimeSamples()
        return sorted({*found, *self._indices.GetTimeSamples()}) if self._indices else found

    def at(self, time: float | None) -> Any:
        """Return the value at a time code, or the default for None; None where indices lead nowhere."""
        value = _read(self._values, time)
        if self._indices is None:
            return value
        return _flattened(np.asarray(value), np.asarray(self.indices_at(time)), self._size)

    def indices_at(self, time: float | None) -> Any:
        """Return the indices as they are stored, None where there are none."""
        return _read(self._indices, time) if self._indices else None


def indices_of(attribute: Any) -> Any:
    """Return the attribute with the indices of an attribute's values, None where it has none."""
    primvar = UsdGeom.Primvar(attribute) if UsdGeom.Primvar.IsPrimvar(attribute) else None
    return primvar.GetIndicesAttr() if primvar and primvar.IsIndexed() else None


def are_indices(prim: Any, name: str) -> bool:
    """Whether a property of a prim holds the indices of another one's values."""
    values = name.removesuffix(INDICES)
    if values == name or not UsdGeom.Primvar.IsValidPrimvarName(values):
        return False
    attribute = prim.GetAttribute(values)
    return bool(attribute) and indices_of(attribute) is not None


def _flattened(values: NDArray[Any], indices: NDArray[Any], size: int) -> NDArray[Any] | None:
    """The values (N * size, ...) that indices (N,) choose, None where there are not so many."""
    if indices.ndim != 1 or indices.dtype.kind not in "iu" or not values.ndim:
        return None
    if size > 1:
        indices = (indices[:, None] * size + np.arange(size)).ravel()
    if len(indices) and not (indices.min() >= 0 and indices.max() < len(values)):
        return None
    return values.take(indices, axis=0)


def _read(query: Any, time: float | None) -> Any:
    """Return a value at a time code, or the default."""
    return query.Get(Usd.TimeCode.Default() if time is None else time)
