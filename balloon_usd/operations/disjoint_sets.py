"""Things that become one: disjoint sets (union-find)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

T = TypeVar("T", bound="Hashable")


class DisjointSets(Generic[T]):
    """Sets that grow together; what was never merged is a set of its own."""

    def __init__(self) -> None:
        self._parent: dict[T, T] = {}

    def root(self, thing: T) -> T:
        """Return what stands for the set of a thing."""
        while thing in self._parent:
            thing = self._parent[thing]
        return thing

    def merge(self, things: Iterable[T]) -> None:
        """Let the sets of some things become that of the first."""
        first, *others = things
        root = self.root(first)
        for other in others:
            if (below := self.root(other)) != root:
                self._parent[below] = root


def roots_of(count: int, groups: Iterable[Iterable[int]]) -> list[int]:
    """Return for each of so many things the one that stands for all that become one with it by groups."""
    sets: DisjointSets[int] = DisjointSets()
    for group in groups:
        sets.merge(group)
    return [sets.root(thing) for thing in range(count)]
