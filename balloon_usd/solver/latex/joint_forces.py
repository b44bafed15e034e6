"""The force with which the friction of each joint keeps its bubbles where they lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.latex.sculpture import LatexSculpture
    from balloon_usd.solver.latex.struts import Struts

Floats = NDArray[np.float32]
Integers = NDArray[np.int64]

NO_WELD = -1
"""Number of the weld of an end that none holds."""


class _Welds(NamedTuple):
    """The welds of one sculpture, numbered, and what each of them keeps."""

    number: int
    struts: Integers
    """Struts of the scene, (N,)."""
    holders: Integers
    """Weld whose friction each of these is, (N,)."""
    ends: Integers
    """Weld that the start and the end of each bubble are part of, (bubbles, 2)."""


class JointForces:
    """Sums up the struts of each weld of all sculptures of a scene."""

    def __init__(self, sculptures: Sequence[LatexSculpture], struts: Struts) -> None:
        """Nothing is held yet."""
        self._sculptures, self._struts = sculptures, struts
        self._kept: list[object] = [None for _ in sculptures]
        self._welds = [_Welds(0, *_no_struts(), _no_ends(sculpture)) for sculpture in sculptures]
        self._join()

    def follow(self) -> None:
        """Take note of poses that are kept since, once their struts are put down."""
        changed = [k for k, each in enumerate(self._sculptures) if each.pose_kept is not self._kept[k]]
        for k in changed:
            self._kept[k] = self._sculptures[k].pose_kept
            self._welds[k] = _welds_of(self._sculptures[k], self._struts)
        if changed:
            self._join()

    def _join(self) -> None:
        first = np.cumsum([0, *(welds.number for welds in self._welds)])
        self._count = int(first[-1])
        self._of_struts = np.concatenate([welds.struts for welds in self._welds])
        self._holders = np.concatenate([w.holders + f for w, f in zip(self._welds, first, strict=False)])
        ends = [np.where(w.ends < 0, NO_WELD, w.ends + f) for w, f in zip(self._welds, first, strict=False)]
        self._ends = np.concatenate(ends)

    def at_ends(self, strut_force: Floats) -> Floats:
        """Return the largest force of friction that keeps two bubbles where they lie, of those that meet at
        the start and at the end of each bubble of all sculptures, (bubbles, 2), N; 0 where there is none.

        `strut_force`: of all struts of the scene, (S, 3), N.
        """
        # The last is of the ends that no weld holds.
        most = np.zeros(self._count + 1, dtype=np.float32)
        force = strut_force[self._of_struts]
        # Struts of what has flown apart have no force.
        np.fmax.at(most, self._holders, np.sqrt(np.einsum("ij,ij->i", force, force)))
        found: Floats = most[self._ends]
        return found


def _no_struts() -> tuple[Integers, Integers]:
    return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)


def _no_ends(sculpture: LatexSculpture) -> Integers:
    return np.full((len(sculpture.plan.bubbles), 2), NO_WELD, dtype=np.int64)


def _welds_of(sculpture: LatexSculpture, struts: Struts) -> _Welds:
    kept, table, ends = sculpture.pose_kept, sculpture.plan.table, _no_ends(sculpture)
    if not kept:
        # Balloons from meshes have no rings.
        return _Welds(0, *_no_struts(), ends)
    number = {joint: k for k, weld in enumerate(kept) for joint in weld}
    for bubble, at in zip(sculpture.plan.bubbles, ends, strict=True):
        for side, ring in enumerate(table.ends(bubble.name)):
            if ring is not None:
                at[side] = number.get(sculpture.joints[ring], NO_WELD)
    put = struts.pairs
    found = [(put[pair], k) for k, pairs in enumerate(kept.values()) for pair in sorted(pairs) if pair in put]
    strut, holder = np.array(found, dtype=np.int64).reshape(-1, 2).T
    return _Welds(len(kept), strut, holder, ends)
