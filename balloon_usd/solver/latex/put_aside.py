"""Figures that hands have put aside while they work on others of the same sculpture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.operations.disjoint_sets import DisjointSets
from balloon_usd.plan.nesting import hosts_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.sculpture import Sculpture

FAR = 0.03
"""How far a figure drifts from where it was put aside until a hand holds it, m. Walls that are kept apart
move without regard to momentum: a fold beside a bubble that was rolled between two others was 4.5 m away
after 36 s, and is 0.1 m away so.
"""
EVERY = 0.25
"""Time between two looks, s."""


class PutAside:
    """Holds figures that drift away, softly at one ring, until hands work on them again."""

    def __init__(self, sculpture: Sculpture, hands: LatexControls) -> None:
        """Begin with nothing put aside."""
        self._sculpture, self._hands = sculpture, hands
        starts = sculpture.scene.joint_start
        self._joints = {body: np.arange(starts[body], starts[body + 1]) for body in sculpture.bodies}
        self._inside = [
            (sculpture.body[name], sculpture.body[host.balloon])
            for name, host in hosts_of(sculpture.plan.strips).items()
        ]
        """Bodies that lie in another, each with that."""
        self._places: dict[int, NDArray[np.float64]] = {}
        """Where the figure of each body was put aside, (3,), m."""
        self._grips: dict[int, tuple[int, NDArray[np.float32]]] = {}
        """The joint of the scene by which the figure of each body is held that has drifted away, and where,
        (3,), m.
        """
        self._held: set[int] = set()
        """Those of these joints on which hands are."""
        self._looked = 0.0
        """When it was looked at last, s."""

    def take_up(self) -> None:
        """Take the hands from what drifts, before they begin something else."""
        if self._held:
            self._hands.let_go(np.array(sorted(self._held), dtype=np.int64))
            self._held.clear()

    def look(self, end: float, *, begun: bool) -> None:
        """Hold what has drifted away since it was put aside, and nothing else.

        `end`: when the coming frame ends, s; `begun`: whether hands begin something else in it.
        """
        if len(self._joints) < 2 or not (begun or end > self._looked + EVERY):
            return
        self._looked = end
        mode = self._hands.mode
        worked_on = {
            body
            for body, joints in self._joints.items()
            if not self._held.issuperset(joints[mode[joints] != 0].tolist())
        }
        for figure in self._figures():
            if not worked_on or not worked_on.isdisjoint(figure) or any(map(self._is_moved, figure)):
                self._forget(figure)
            else:
                self._hold(figure)

    def _figures(self) -> list[list[int]]:
        """Return the bodies that hang together by welds, or lie in each other."""
        sculpture = self._sculpture
        together: DisjointSets[int] = DisjointSets()
        for pair in self._inside:
            together.merge(pair)
        for weld in sculpture.welds:
            together.merge([sculpture.body[sculpture.balloons[ring]] for ring in weld])
        figures: dict[int, list[int]] = {}
        for body in self._joints:
            figures.setdefault(together.root(body), []).append(body)
        return list(figures.values())

    def _is_moved(self, body: int) -> bool:
        """Whether hands displace vertices of a body as they are."""
        return self._hands.spins.moves(self._sculpture.scene.vertices_of(body))

    def _hold(self, figure: list[int]) -> None:
        """Take note of where a figure lies, and hold it by its middle if it has drifted away from there."""
        joints = np.concatenate([self._joints[body] for body in figure])
        middle = self._sculpture.frame.middle
        place = middle[joints].mean(axis=0, dtype=np.float64)
        far = [np.linalg.norm(place - self._places.setdefault(body, place)) for body in figure]
        if max(far) > FAR and not self._grips.keys() & figure:
            nearest = int(joints[np.argmin(np.linalg.norm(middle[joints] - place, axis=1))])
            self._grips[figure[0]] = nearest, middle[nearest].copy()
        for joint, goal in (self._grips[body] for body in figure if body in self._grips):
            self._hands.lead(joint, middle)
            self._hands.goal[joint] = goal
            self._held.add(joint)

    def _forget(self, figure: Iterable[int]) -> None:
        """Leave a figure to what hands do with it, or to itself where they work on nothing else."""
        for body in figure:
            self._places.pop(body, None)
            joint, _ = self._grips.pop(body, (-1, None))
            if joint in self._held:
                self._hands.let_go(np.array([joint], dtype=np.int64))
                self._held.remove(joint)
