"""Two values of an attribute: whether they are the same within a tolerance, and how far apart."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.diff.tolerance import Allowed

NUMBERS = "fiub"
"""Kinds of arrays that hold numbers."""


@dataclass(frozen=True)
class Gap:
    """How two values differ at one time code."""

    by: float
    """Largest difference in the attribute's unit; infinite where the values cannot be subtracted."""
    text: str
    """What differs: `differ by up to 0.003`."""


def same_bits(one: Any, other: Any) -> bool:
    """Whether two values are arrays of the same bytes: quick, and almost always so."""
    if not (hasattr(one, "__array_interface__") or hasattr(one, "__len__")):
        return False
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape or first.dtype != second.dtype or first.dtype.kind not in NUMBERS:
        return False
    return np.array_equal(_words(first), _words(second))


def gap_between(one: Any, other: Any, allowed: Allowed) -> Gap | None:
    """Return how far two values are apart, None if they are the same within the tolerance.

    NaN is the same as NaN; floats alone have a tolerance.
    """
    if one is None or other is None:
        without = "first" if one is None else "second"
        return None if one is other else Gap(math.inf, f"no value in the {without} stage")
    first, second = _numbers(one), _numbers(other)
    if first is None or second is None:
        return None if alike(one, other) else Gap(math.inf, "values differ")
    if first.shape != second.shape:
        return Gap(math.inf, f"{_length(first)} and {_length(second)} values")
    if first.dtype.kind == "f" and second.dtype.kind == "f":
        return _float_gap(first, second, allowed)
    wrong = int(np.count_nonzero(first != second))
    if not wrong:
        return None
    far = float(np.abs(first.astype(np.float64) - second.astype(np.float64)).max())
    return Gap(far, f"{wrong} of {first.size} values differ" if first.size > 1 else "values differ")


def alike(one: Any, other: Any) -> bool:
    """Whether two values of any type are the same; a path of a file by its name, not by where it lies."""
    if isinstance(one, Sdf.AssetPath) and isinstance(other, Sdf.AssetPath):
        return str(one.path) == str(other.path)
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(alike(one[key], other[key]) for key in one)
    if _is_list(one) and _is_list(other):
        return len(one) == len(other) and all(alike(a, b) for a, b in zip(one, other, strict=True))
    return type(one) is type(other) and bool(one == other)


def _is_list(value: Any) -> bool:
    return hasattr(value, "__len__") and hasattr(value, "__iter__") and not isinstance(value, (str, dict))


def _numbers(value: Any) -> NDArray[Any] | None:
    """Return a value as an array of numbers, None if it is of another kind."""
    if hasattr(value, "imaginary"):
        return np.array([value.real, *value.imaginary])
    found = np.asarray(value)
    return found if found.dtype.kind in NUMBERS else None


def _float_gap(first: NDArray[Any], second: NDArray[Any], allowed: Allowed) -> Gap | None:
    # Halves would overflow where they are far apart.
    one, other = (
        values.astype(np.promote_types(values.dtype, "f4"), copy=False) for values in (first, second)
    )
    with np.errstate(invalid="ignore", over="ignore"):
        apart = np.abs(one - other)
        by = float(apart.max(initial=0.0))
        if not math.isfinite(by):
            return _unbounded_gap(one, other, allowed)
        if allowed.relative:
            larger = np.maximum(np.abs(one), np.abs(other), dtype=np.float64)
            by = float(apart[apart > allowed.absolute + allowed.relative * larger].max(initial=0.0))
    return _told(one, other, by) if by > allowed.absolute else None


def _unbounded_gap(one: NDArray[Any], other: NDArray[Any], allowed: Allowed) -> Gap | None:
    """Compare what holds NaN or infinity, or is so far apart."""
    if (np.isnan(one) != np.isnan(other)).any():
        counts = [int(np.count_nonzero(np.isnan(values))) for values in (one, other)]
        return Gap(math.inf, f"{counts[0]} and {counts[1]} values are NaN")
    # No number is near infinity, whatever is allowed; equal infinities and NaN are the same.
    same = (one == other) | np.isnan(one)
    if (~same & ~(np.isfinite(one) & np.isfinite(other))).any():
        return _told(one, other, math.inf)
    return _float_gap(np.where(same, 0.0, one), np.where(same, 0.0, other), allowed)


def _told(one: NDArray[Any], other: NDArray[Any], by: float) -> Gap:
    return Gap(by, f"differ by up to {by:.3g}" if one.size > 1 else f"{one.item():g} and {other.item():g}")


def _length(values: NDArray[Any]) -> str:
    return str(len(values)) if values.ndim else "one"


def _words(values: NDArray[Any]) -> NDArray[Any]:
    """Return the bytes of an array in the largest words that hold them."""
    flat = np.ascontiguousarray(values).reshape(-1)
    return flat.view(np.uint64) if flat.nbytes % 8 == 0 else flat.view(np.uint8)
