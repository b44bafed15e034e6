"""The prims of two stages, path by path."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Usd

if TYPE_CHECKING:
    from collections.abc import Iterator

ALL = Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)
"""Prims of every kind, those inside instances too."""


@dataclass
class PrimPairs:
    """A walk over two stages, parents first; each pair of prototypes that stay in place is entered once."""

    elsewhere: list[str] = field(default_factory=list)
    """Paths below which all stands elsewhere in the second stage; may be added to during the walk."""
    repeated: dict[str, list[str]] = field(default_factory=dict)
    """Instances that were not entered, by the path of the instance that shows the same prototypes."""
    _entered: dict[tuple[str, str], str] = field(default_factory=dict)

    def walk(self, one: Any, other: Any) -> Iterator[tuple[Any, Any]]:
        """Yield the prims below two prims: both of a path, or the one that there is and None."""
        ours, theirs = ({child.GetName(): child for child in _children(prim)} for prim in (one, other))
        for name in [*ours, *(name for name in theirs if name not in ours)]:
            pair = ours.get(name), theirs.get(name)
            yield pair
            if pair[0] and pair[1] and not self._seen(*pair):
                yield from self.walk(*pair)

    def stands_elsewhere(self, path: str) -> bool:
        """Whether a prim stands at another place of the world."""
        return any(path == above or path.startswith(above.rstrip("/") + "/") for above in self.elsewhere)

    def _seen(self, one: Any, other: Any) -> bool:
        """Whether both are instances of prototypes that were entered already."""
        if not (one.IsInstance() and other.IsInstance()):
            return False
        key = str(one.GetPrototype().GetPath()), str(other.GetPrototype().GetPath())
        path = str(one.GetPath())
        if self.stands_elsewhere(path):
            return False
        first = self._entered.setdefault(key, path)
        if first != path:
            self.repeated.setdefault(first, []).append(path)
        return first != path


def _children(prim: Any) -> list[Any]:
    return list(prim.GetFilteredChildren(ALL))
