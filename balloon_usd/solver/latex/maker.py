"""The maker of the latex model: blows up, pinches, twists, and lets the friction of welds hold the pose."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.bubble_shape import tail_volume_per_rest_length, tube_volume_per_rest_length
from balloon_usd.balloon.tube_theory import maxwell_state, pressure_maximum
from balloon_usd.operations.moves import Inflate, LetGo, Pinch, Spin
from balloon_usd.plan.closing import smooth
from balloon_usd.solver.latex.friction import Friction
from balloon_usd.solver.latex.memory import set_bend
from balloon_usd.solver.latex.torsion import Torsion
from balloon_usd.solver.maker import ALONG, Maker
from balloon_usd.solver.model import Status

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.plan.shaped import Shaped
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.struts import Struts

Floats = NDArray[np.float32]

PUMP_RESERVE = 1.15
"""Pressure of the pump over the pressure at which the flat tube gives way."""
PUMP_TIME = 0.985
"""Share of the time given to inflating in which the pump has done its work."""
PUMP_RAMP = 0.2
"""Share of that time in which the pump starts, and stops."""
TAIL_STIFFNESS = 200.0
"""Stiffness of the hand that leads the flat tail while the balloon is blown up, N/m: soft, it only steers."""
SPIN_CLEAR = 1e-6
"""What lies farther than this beyond a joint turns with the balloon, m."""
SOFTENING_SECONDS = 0.1
"""Time in which stretched rubber softens, s: longer than the waves that hands send through a heavy mesh."""


class LatexMaker(Maker):
    """Performs one plan on its balloons in a scene of the latex model."""

    scene: LatexScene
    hands: LatexControls

    def __init__(
        self, plan: Plan, scene: LatexScene, hands: LatexControls, struts: Struts, first_body: int
    ) -> None:
        super().__init__(plan, scene, hands, first_body)
        self.struts = struts
        self._friction = Friction(plan, self._ring)
        self.torsion = Torsion(plan, scene, hands, self._ring, self.body, self._friction)
        self._fronts: dict[str, tuple[int, float]] = {}
        """Ring that leads the tail of every balloon, and how far (m) a flow of one mol/s drives it in a frame
        along with the front.
        """
        self.inflated = -1
        """Frame at whose end the last balloon has its gas."""
        self._performers |= {Inflate: self._inflate, Pinch: self._pinch, Spin: self._spin}

    @property
    def just_inflated(self) -> bool:
        """Whether the last balloon has got its gas in the frame that was performed last."""
        return self.inflated == self._frame

    def _perform(self, begin: float, end: float, middle: Floats) -> None:
        self.hands.stop_turning(self.body.values())
        super()._perform(begin, end, middle)
        self.torsion.unwind(end - begin, middle)

    def _update_status(self) -> None:
        loose, undone = self.torsion.unwinding, self.torsion.undone
        doing = self._text if loose is None else f"comes undone: {loose}"
        if doing is not self.status.doing or undone is not self.status.undone:
            self.status = Status(doing, undone)

    def _let_go(self, k: int, move: LetGo, share: float, fresh: bool, middle: Floats) -> None:
        super()._let_go(k, move, share, fresh, middle)
        if fresh:
            if move.for_good:
                self.torsion.let_go(self.struts)
            self.struts.hold(self._friction.pairs(self.hands))

    def _inflate(self, _: int, move: Inflate, share: float, fresh: bool, middle: Floats) -> None:
        b, shape = self.body[move.balloon], self.plan.strips[move.balloon].shape
        if shape is not None:
            self._fill(b, shape, move, share, fresh=fresh)
            return
        if fresh:
            strip, budget = self.plan.strips[move.balloon], self.plan.budgets[move.balloon]
            scale = strip.size.thickness / strip.size.radius
            n = self.scene.bodies[b].rings[0].around
            # The polygon holds more than the circle that it is drawn about.
            self.hands.pump_goal[b] = budget.gas_amount * n * math.tan(math.pi / n) / math.pi
            self.hands.pump_limit[b] = PUMP_RESERVE * pressure_maximum(strip.rubber).p_star * scale
            self.hands.grip(int(self.scene.joint_start[b]) + 1, middle)
            self.hands.set_drag(b, 0.0)
            # What the mesh's artificial inertia adds to the stretch behind the front must not soften it.
            self.hands.set_softening(b, 0.0)
        self._pump(b, move, share)
        self._lead_tail(move.balloon, float(self.hands.pump_flow[b]), fresh, middle)
        if share >= 1.0:
            self.hands.set_drag(b, self.scene.settings.drag)
            self.hands.set_softening(b, self.scene.settings.dt / SOFTENING_SECONDS)
            self.inflated = self._frame

    def _pump(self, body: int, move: Inflate, share: float) -> None:
        """Set the pump's flow: it starts and stops gently, as a balloon is pushed along by its own front."""
        gentle = min(1.0, share / PUMP_RAMP, (1.0 - share) / PUMP_RAMP)
        flow = self.hands.pump_goal[body] / (PUMP_TIME * (1.0 - PUMP_RAMP) * move.seconds)
        self.hands.pump_flow[body] = flow * max(gentle, 0.0)

    def _fill(self, body: int, shape: Shaped, move: Inflate, share: float, *, fresh: bool) -> None:
        """Blow up a balloon of any shape, which nobody holds."""
        atmosphere = self.scene.settings.atmosphere
        if fresh:
            energy = float(self.scene.air.molar_energy)
            self.hands.pump_goal[body] = (atmosphere + shape.pressure) * shape.volume / energy
            # No wall is so stiff: the pump gives its air in time whatever the shape is.
            self.hands.pump_limit[body] = atmosphere
            self.hands.set_softening(body, 0.0)
            self.hands.touch([body])
        self._pump(body, move, share)
        if share >= 1.0:
            self.hands.set_softening(body, self.scene.settings.dt / SOFTENING_SECONDS)
            self.inflated = self._frame

    def _lead_tail(self, balloon: str, flow: float, fresh: bool, middle: Floats) -> None:
        """Keep the flat tail straight and as fast as the front that a flow of gas (mol/s) drives along."""
        if fresh:
            strip = self.plan.strips[balloon]
            tip = self._ring[self.plan.table.guides(strip.bubbles[-1].name)[-1]]
            self.hands.lead(tip, middle)
            self.hands.stiffness[tip] = TAIL_STIFFNESS
            gained = tube_volume_per_rest_length(strip.size, strip.rubber) - tail_volume_per_rest_length(
                strip.size, strip.rubber
            )
            pressure = self.scene.settings.atmosphere + self.plan.budgets[balloon].pressure
            state = maxwell_state(strip.rubber)
            longer = float(self.scene.air.molar_energy) * (state.bulged.b - state.thin.b)
            self._fronts[balloon] = tip, longer / (pressure * gained * self.plan.recipe.fps)
        tip, step = self._fronts[balloon]
        start, goal = self.hands.start[tip], self.hands.goal[tip]
        start[:] = goal
        # Forward is the first coordinate.
        start[0] += middle[tip, 0] - goal[0]
        goal[0] = start[0] + np.float32(flow * step)
        if flow == 0.0:
            self.hands.free[tip] = ALONG

    def _pinch(self, k: int, move: Pinch, share: float, fresh: bool, middle: Floats) -> None:
        joint = self._ring[move.ring]
        if fresh:
            wide = self._ring_width(joint)
            self._began[k] = np.array([wide])
            self.torsion.pinch(move.ring, wide)
            self.hands.clasp(joint, middle)
            self.hands.split_gas(joint)
            self.hands.radius[joint] = wide
            self.hands.passage[joint] = math.pi * wide**2
        self._steady(move.ring, middle)
        wide, neck = float(self._began[k][0]), float(self.hands.neck[joint])
        radius = neck + (wide - neck) * (1.0 - smooth(share))
        self.hands.squeeze(joint, radius, math.pi * (radius**2 - neck**2))

    def _spin(self, _: int, move: Spin, __: float, ___: bool, middle: Floats) -> None:
        begin, end = self._span
        ring = self.plan.table.rings[move.ring]
        self._steady(move.ring, middle)
        inside = max(0.0, min(end, move.end) - max(begin, move.start))
        self.torsion.wind(move.ring, move.turns * inside / move.seconds)
        rate = 2.0 * math.pi * move.turns / move.seconds * inside / (end - begin)
        self.hands.turn(self.body[ring.balloon], middle[self._ring[move.ring]], ring.along + SPIN_CLEAR, rate)

    def _keep_bend(self, bubble: str) -> None:
        body, faces = self._faces(bubble)
        set_bend(self.scene, body, faces)
