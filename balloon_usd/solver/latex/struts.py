"""Struts: the rotational dry friction that keeps the pose of a weld."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.plan.holding import pose_force
from balloon_usd.solver.hands import STEP_STIFFNESS
from balloon_usd.solver.upload import ArrayUpload

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.solver.latex.scene import LatexScene

Floats = NDArray[np.float32]


ARRAYS = (
    "strut_joint",
    "strut_length",
    "strut_stiffness",
    "strut_damping",
    "strut_yield",
    "joint_struts",
)
"""Device arrays of struts."""
STRUT_SHARE = 0.6
"""Stiffness of one strut as a share of the largest that a ring bears."""
CROWD = 18
"""Struts at one joint beyond which they share their stiffness and damping: with 35 at one joint of an
icosahedron (stiffness dt^2 + 2 damping dt) / mass came to 4.3, and explicit steps bear 4.
"""


@dataclass(frozen=True)
class StrutLaw:
    """Rotational dry friction of a weld, as a yielding strut between neighbouring joints."""

    stiffness: float = 800.0
    """N/m, where the time step allows it."""
    yielding: float = 3.0
    """Force at which it gives way, N."""

    @classmethod
    def of_friction(cls, friction: float) -> Self:
        """Return that of rubber with some friction on rubber."""
        return cls(yielding=pose_force(friction))


class Struts:
    """The pool of struts of a scene."""

    def __init__(self, scene: LatexScene, law: StrutLaw) -> None:
        self.scene = scene
        self.law = law
        self.pairs: dict[tuple[int, int], int] = {}
        """Strut of every pair of joints."""
        self._wanted: set[tuple[int, int]] = set()
        self._loosened: set[tuple[int, int]] = set()
        """Pairs whose struts hold nothing until they are asked for again."""
        self._uploads = {name: ArrayUpload(scene, name) for name in ARRAYS}
        self._mass = scene.joint_mass.numpy().copy()
        self._ends = np.zeros(len(self._mass), dtype=np.int64)
        """How many struts come to end at every joint, (J,)."""

    def expect(self, pairs: set[tuple[int, int]]) -> None:
        """Take note of all pairs of a sculpture's joints for which struts may be asked."""
        np.add.at(self._ends, np.array(list(chain.from_iterable(pairs)), dtype=np.int64), 1)

    def hold(self, pairs: set[tuple[int, int]]) -> None:
        """Ask for a strut between every new pair of joints."""
        self._wanted |= pairs

    def release(self, joints: set[int], kept: set[tuple[int, int]]) -> None:
        """Take away the struts between some joints, but for those pairs that are kept."""
        self._wanted = {pair for pair in self._wanted if not joints.issuperset(pair) or pair in kept}
        self._slacken([p for p in self.pairs if joints.issuperset(p) and p not in kept])

    def loosen(self, joints: set[int]) -> None:
        """Let the struts between some joints hold nothing, until they are asked for again."""
        loose = [pair for pair in self.pairs if joints.issuperset(pair)]
        self._loosened.update(loose)
        self._slacken(loose)

    def _slacken(self, pairs: Sequence[tuple[int, int]]) -> None:
        if pairs:
            for name in ("strut_stiffness", "strut_damping"):
                self._uploads[name].staged()[[self.pairs[pair] for pair in pairs]] = 0.0
                self._uploads[name].send()

    def put(self, middle: Floats) -> None:
        """Put down the struts that were asked for, at the distances that their joints have now.

        `middle`: of all joints, (J, 3), m.

        Raises:
            ValueError: more struts than the capacity, or too many end at one joint.
        """
        fresh = sorted(self._wanted.difference(self.pairs))
        again = sorted(self._wanted & self._loosened)
        self._wanted.clear()
        if again:
            self._tighten(again, middle)
        if not fresh:
            return
        before, capacity = len(self.pairs), len(self.scene.strut_joint)
        if before + len(fresh) > capacity:
            raise ValueError(f"{before + len(fresh)} struts but room for {capacity}")
        arrays = {name: upload.staged() for name, upload in self._uploads.items()}
        for a, b in fresh:
            k = self.pairs[a, b] = len(self.pairs)
            arrays["strut_joint"][k] = (a, b)
            arrays["strut_yield"][k] = self.law.yielding
            self._measure((a, b), arrays, middle)
            _enter(arrays["joint_struts"], k, a, b)
        for name, upload in self._uploads.items():
            if name == "joint_struts":
                upload.send()
            else:
                # Earlier struts may have yielded since: their lengths on the device stay.
                upload.send(before, len(self.pairs))

    def _tighten(self, pairs: Sequence[tuple[int, int]], middle: Floats) -> None:
        """Let loosened struts hold the distances that their joints have now."""
        names = ("strut_length", "strut_stiffness", "strut_damping")
        arrays = {name: self._uploads[name].staged() for name in names}
        for pair in pairs:
            self._measure(pair, arrays, middle)
        for name in names:
            for k in (self.pairs[pair] for pair in pairs):
                self._uploads[name].send(k, k + 1)
        self._loosened.difference_update(pairs)

    def _measure(
        self, pair: tuple[int, int], arrays: Mapping[str, NDArray[np.float32]], middle: Floats
    ) -> None:
        """Give the strut of a pair its length, its stiffness and its damping."""
        k, (a, b) = self.pairs[pair], pair
        arrays["strut_length"][k] = np.linalg.norm(middle[b] - middle[a])
        least = float(min(self._mass[a], self._mass[b]))
        most = STRUT_SHARE * STEP_STIFFNESS * least / self.scene.settings.dt**2
        stiffness = np.float32(min(self.law.stiffness, most))
        share = CROWD / max(CROWD, self._ends[a], self._ends[b])
        arrays["strut_stiffness"][k] = share * stiffness
        arrays["strut_damping"][k] = share * 0.3 * np.sqrt(stiffness * least)


def _enter(slots: NDArray[np.int32], strut: int, first: int, second: int) -> None:
    """Enter a strut at the joints of its ends, with its sign.

    Raises:
        ValueError: too many end there.
    """
    for end, sign in ((first, 1), (second, -1)):
        free = np.flatnonzero(slots[end] == 0)
        if len(free) == 0:
            raise ValueError(f"more than {slots.shape[1]} struts at one joint")
        slots[end, free[0]] = sign * (strut + 1)
