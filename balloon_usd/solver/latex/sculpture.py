"""One sculpture of the latex model, with what its welds and wound joints hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.plan.nesting import hosts_of
from balloon_usd.solver.latex.friction import Friction
from balloon_usd.solver.latex.put_aside import PutAside
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.latex.torsion import Torsion
from balloon_usd.solver.sculpture import ALL, Sculpture

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from balloon_usd.plan import Plan
    from balloon_usd.plan.nesting import Host
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.struts import Struts
    from balloon_usd.solver.torn import OpenBubble


class LatexSculpture(Sculpture):
    """A plan, its balloons in a scene of the latex model, and the hands on them."""

    scene: LatexScene
    hands: LatexControls

    def __init__(
        self, plan: Plan, scene: LatexScene, hands: LatexControls, struts: Struts, first_body: int
    ) -> None:
        super().__init__(plan, scene, hands, first_body)
        self.struts = struts
        self.friction = Friction(plan, self.joints)
        struts.expect(self.friction.most_pairs())
        self.torsion = Torsion(plan, scene, hands, self.joints, self.body, self.friction)
        self.inflated_at: dict[int, float] = {}
        """Time at which each body had its gas, s."""
        self.open_bubbles: list[OpenBubble] = []
        """Bubbles that have torn or were cut off."""
        self._put_aside = PutAside(self, hands)
        self.pose_kept: dict[tuple[int, ...], set[tuple[int, int]]] = {}
        """Pairs of joints (of the scene) whose distance friction keeps, by the weld whose it is."""

    def contents(self, balloon: str) -> Iterator[tuple[VertexSet, Host]]:
        """Yield the vertices of each balloon that lies in another one, and where it lies."""
        for name, host in hosts_of(self.plan.strips).items():
            if host.balloon == balloon:
                yield VertexSet(self.scene.vertices_of(self.body[name])), host

    def mass(self, body: int) -> float:
        """Return the mass of the rubber of a body, kg."""
        return float(self.scene.true_mass.numpy()[self.scene.vertices_of(body)].sum())

    def inertia(self, body: int) -> float:
        """Return the mass of the mesh of a body, kg: more than of its rubber, as steps in time are long."""
        return float(self.scene.mass.numpy()[self.scene.vertices_of(body)].sum())

    def take_up(self) -> None:
        """Take the hands from what they hold lest it drifts away."""
        self._put_aside.take_up()

    def look_after(self, end: float, *, begun: bool) -> None:
        """Hold what drifts away while hands work on other balloons."""
        self._put_aside.look(end, begun=begun)

    def hold_pose(self) -> None:
        """Let the friction of the welds keep the pose that the figure has."""
        self.struts.hold(self._kept_pairs())

    def give_up_pose(self) -> None:
        """Let friction keep of the pose only what the welds keep that hold by now."""
        self.struts.release(set(self.joints), self._kept_pairs())

    def _kept_pairs(self) -> set[tuple[int, int]]:
        """Take note of what friction keeps by now, and return all pairs."""
        self.pose_kept = self.friction.kept(self.hands)
        return set().union(*self.pose_kept.values())

    def centre(
        self, points: NDArray[np.float64], part: NDArray[np.int64] | slice = ALL
    ) -> NDArray[np.float64]:
        """Return the centre of the mass of the rubber of a part, (3,), m; `points`: all its vertices,
        (V, 3), m.
        """
        mass = self.scene.true_mass.numpy()[self.vertices].astype(np.float64)[part]
        middle: NDArray[np.float64] = mass @ points[part] / mass.sum()
        return middle

    def weigh_nothing(self, body: int, vertices: NDArray[np.int64]) -> None:
        """Take the weight of some vertices of a body away."""
        mass = self.scene.true_mass.numpy()
        mass[vertices + int(self.scene.vertex_start[body])] = 0.0
        self.scene.true_mass.assign(mass)

    @property
    def unwinding(self) -> tuple[str, ...]:
        """Names of the joints that are coming undone."""
        return self.torsion.unwinding

    @property
    def undone(self) -> tuple[str, ...]:
        """Locks that have slipped and joints that have come undone so far."""
        return self.torsion.undone
