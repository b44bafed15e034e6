"""Figures in order of quality."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

T = TypeVar("T")


def excess(result: Mapping[str, Any]) -> float:
    """Return a value in its limits; where the limit is 0, the value itself."""
    return float(result["value"] or 0.0) / (result["limit"] or 1.0)


def worst_first(figures: Iterable[T], quality: Callable[[T], Mapping[str, Any]]) -> list[T]:
    """Sort figures: by how many measures are beyond their limits, then by how far the worst one is."""

    def badness(figure: T) -> tuple[int, float]:
        data = quality(figure)
        return len(data["off"]), max((excess(data[key]) for key in data["off"]), default=0.0)

    return sorted(figures, key=badness, reverse=True)
