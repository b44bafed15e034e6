"""Struts: the rotational dry friction that keeps the pose of a weld."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.hands import STEP_STIFFNESS

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene

Floats = NDArray[np.float32]


STRUT_SHARE = 0.6
"""Stiffness of one strut as a share of the largest that a ring bears."""


@dataclass(frozen=True)
class StrutLaw:
    """Rotational dry friction of a weld, as a yielding strut between neighbouring joints."""

    stiffness: float = 800.0
    """N/m, where the time step allows it."""
    yielding: float = 3.0
    """Force at which it gives way, N: friction 0.8 x bubble pressure 7 kPa x two contact patches of 3 cm2."""


class Struts:
    """The pool of struts of a scene."""

    def __init__(self, scene: LatexScene, law: StrutLaw) -> None:
        self.scene = scene
        self.law = law
        self.pairs: dict[tuple[int, int], int] = {}
        """Strut of every pair of joints."""
        self._wanted: set[tuple[int, int]] = set()

    def hold(self, pairs: set[tuple[int, int]]) -> None:
        """Ask for a strut between every new pair of joints."""
        self._wanted |= pairs

    def release(self, joints: set[int], kept: set[tuple[int, int]]) -> None:
        """Take away the struts between some joints, but for those pairs that are kept."""
        self._wanted = {pair for pair in self._wanted if not joints.issuperset(pair) or pair in kept}
        gone = [p for p in self.pairs if joints.issuperset(p) and p not in kept]
        if gone:
            stiffness, damping = self.scene.strut_stiffness.numpy(), self.scene.strut_damping.numpy()
            for pair in gone:
                k = self.pairs[pair]
                stiffness[k] = damping[k] = 0.0
            self.scene.strut_stiffness.assign(stiffness)
            self.scene.strut_damping.assign(damping)

    def put(self, middle: Floats) -> None:
        """Put down the struts that were asked for, at the distances that their joints have now.

        `middle`: of all joints, (J, 3), m.

        Raises:
            ValueError: there is no room for so many struts, or too many end at one joint.
        """
        fresh = sorted(self._wanted.difference(self.pairs))
        self._wanted.clear()
        if not fresh:
            return
        s = self.scene
        joint, length = s.strut_joint.numpy(), s.strut_length.numpy()
        stiffness, damping, yielding = (
            s.strut_stiffness.numpy(),
            s.strut_damping.numpy(),
            s.strut_yield.numpy(),
        )
        slots, mass = s.joint_struts.numpy(), s.joint_mass.numpy()
        if len(self.pairs) + len(fresh) > len(joint):
            raise ValueError(f"{len(self.pairs) + len(fresh)} struts but room for {len(joint)}")
        for a, b in fresh:
            k = self.pairs[a, b] = len(self.pairs)
            joint[k] = (a, b)
            length[k] = np.linalg.norm(middle[b] - middle[a])
            least = float(min(mass[a], mass[b]))
            stiffness[k] = min(self.law.stiffness, STRUT_SHARE * STEP_STIFFNESS * least / s.settings.dt**2)
            damping[k] = 0.3 * np.sqrt(stiffness[k] * least)
            yielding[k] = self.law.yielding
            for end, sign in ((a, 1), (b, -1)):
                room = np.flatnonzero(slots[end] == 0)
                if len(room) == 0:
                    raise ValueError(f"more than {slots.shape[1]} struts at one joint")
                slots[end, room[0]] = sign * (k + 1)
        for name, values in (
            ("strut_joint", joint),
            ("strut_length", length),
            ("strut_stiffness", stiffness),
            ("strut_damping", damping),
            ("strut_yield", yielding),
            ("joint_struts", slots),
        ):
            s.arrays[name].assign(values)
