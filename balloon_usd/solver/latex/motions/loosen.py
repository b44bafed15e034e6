"""Hands that let go of a finished figure of latex slowly."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.hands import LEAD_FORCE
from balloon_usd.solver.kernels.physics.motion import LEADING_SPEED
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

DECAYS = 8.0
"""How often the force of the hands decays by a factor of e until it is faded: what they hold in the end takes
a thousandth of a newton to some newtons.
"""
FADED = 0.18
"""Share of the time after which it is faded. Then creases that it held go where they stay alone."""
BRAKED = 0.73
"""Share of the time from which on what still moves is braked more and more: earlier, and what is squeezed is
still on its way when hands let go.
"""
LIES_BEFORE = 0.25
"""Time before the let-go from which on a figure lies and sticks to what it lies on, s: makers put down what
they have made before they take their hands off. Squeezed rubber that flutters for ever, a flat tail between
three bubbles of an icosahedron by 3 mm a frame, is at rest when hands let go, and not half a second later.
"""
LEAST_LEADING = 5.0e-4
"""What is left of the speed at which walls are led out of others, m/s: what cannot be led out stays calm."""
PACKED_DRAG = 300.0
"""Drag on rubber that is folded up in a neck of a figure that holds, 1/s. Packed, it does not move; but more
walls press on one vertex there than it may touch, others at every search, and it jittered at up to 1 m/s.
With 1000/s necks hold on to the figure, which then creeps on after the let-go.
"""
MOST_BRAKED = 24.0
"""Drag at the end, in that while hands work: flat tails have swung out then."""


class Loosen(Motion):
    """Hands whose grip fades: a figure goes to where its own rubber, gas and friction hold it, and does not
    jump there.
    """

    def __init__(self, move: moves.Loosen, sculpture: LatexSculpture) -> None:
        """Hold by the middle of each ring only, where it is; welds hold by friction from now on."""
        self._hands, middle = sculpture.hands, sculpture.frame.middle
        joints = np.array([j for j in sculpture.all_joints if self._hands.mode[j] != 0], dtype=np.int64)
        self._hands.let_go(joints)
        for joint in joints:
            self._hands.lead(int(joint), middle)
        self._joints = joints
        sculpture.hold_pose()
        self._bodies = list(sculpture.bodies)
        self._drag = sculpture.scene.settings.drag
        self._puts_down = not sculpture.plan.loose
        # Where a lock slips walls come to touch others, and what leaks shrinks.
        stays = not sculpture.plan.slipping and sculpture.plan.recipe.physics.leak is None
        self._lies = 1.0 - LIES_BEFORE / move.seconds if stays else 1.0
        self._hands.floating[self._bodies] = 1
        if self._puts_down:
            self._hands.packed_drag[self._bodies] = PACKED_DRAG

    def advance(self, share: float) -> None:
        """Loosen the grip by a share; in the end brake what moves and lay it, unless it is to untwist."""
        loosened, lying = share / FADED, (share - BRAKED) / (1.0 - BRAKED)
        self._hands.force[self._joints] = LEAD_FORCE * math.exp(-DECAYS * loosened)
        left = (LEAST_LEADING / LEADING_SPEED) ** min(loosened, 1.0)
        self._hands.leading[self._bodies] = LEADING_SPEED * left
        if self._puts_down and lying > 0.0:
            self._hands.drag[self._bodies] = self._drag * MOST_BRAKED**lying
        if self._puts_down and share > self._lies:
            self._hands.lay(self._bodies)
