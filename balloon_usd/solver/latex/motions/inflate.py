"""Blowing up a balloon of latex with a pump."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.balloon.tube_theory import pressure_maximum
from balloon_usd.plan.budget import amount, blown_in
from balloon_usd.plan.nesting import room_left
from balloon_usd.solver.latex.motions.strokes import MOST_FLOW, brought
from balloon_usd.solver.latex.motions.tail import Tail
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.plan.shaped import Shaped
    from balloon_usd.solver.latex.sculpture import LatexSculpture

PUMP_RESERVE = 1.15
"""Pressure of the pump over the pressure at which the flat tube gives way."""
PUMP_TIME = 0.985
"""Share of the time given to inflating in which the pump has done its work."""
PUMP_RAMP = 0.2
"""Share of that time in which the pump starts, and stops."""
RAMP_SECONDS = 1.4
"""Time that it takes for that at least, s, if there is as much: the first bulge jumps out of a tube."""
FIRST_PUSH = 0.3
"""Time in which the first push of a hand pump grows at least, s: pushed harder, a flat tube folds inwards."""
BIRTH = 0.5
"""Share of the start in which the first bulge grows: it leans over the knot, and its walls may touch, which
costs 30 % of the speed of a run; the hand keeps the tail taut.
"""


class Inflate(Motion):
    """A pump at a balloon: at a tube, whose knot is held and whose flat tail is led, at a round balloon,
    whose knot is held, or at any shape.
    """

    def __init__(self, move: moves.Inflate, sculpture: LatexSculpture) -> None:
        """Put the pump on."""
        self._sculpture, self._seconds, self._strokes = sculpture, move.seconds, move.strokes
        self._ramp = PUMP_RAMP
        """Share of its time in which the pump starts, and stops."""
        self._body = sculpture.body[move.balloon]
        self._room = room_left(sculpture.plan.strips, move.balloon)
        """Share of the balloon's volume that what lies in it leaves to its gas."""
        sculpture.hands.keep_from_softening(self._body)
        shape = sculpture.plan.strips[move.balloon].shape
        self._tail: Tail | None = None
        self._touches = False
        """Whether its walls touch for this only."""
        if sculpture.plan.strips[move.balloon].is_round:
            self._pump_round(move.balloon)
        elif shape is None:
            self._ramp = min(max(PUMP_RAMP, RAMP_SECONDS / move.seconds), 0.5)
            self._hold_tube(move.balloon)
            self._tail = Tail(sculpture, move.balloon)
        else:
            self._pump_shape(shape)
        self._begun = self._gas
        """Gas that it has at first, mol."""

    @property
    def _gas(self) -> float:
        """Gas that the balloon has when the coming frame begins, mol."""
        return float(self._sculpture.hands.amount[self._sculpture.scene.bubbles_of(self._body)].sum())

    def _hold_tube(self, balloon: str) -> None:
        scene, hands, b = self._sculpture.scene, self._sculpture.hands, self._body
        strip = self._sculpture.plan.strips[balloon]
        scale = strip.size.thickness / strip.size.radius
        n = scene.bodies[b].rings[0].around
        hands.pump_goal[b] = blown_in(strip) * polygon_share(n) * self._room
        hands.pump_limit[b] = PUMP_RESERVE * pressure_maximum(strip.rubber).p_star * scale
        hands.grip(int(scene.joint_start[b]) + 1, self._sculpture.frame.middle)
        hands.set_drag(b, 0.0)
        if not hands.touching[b]:
            self._touches = True
            hands.touch([b])

    def _pump_round(self, balloon: str) -> None:
        scene, hands, b = self._sculpture.scene, self._sculpture.hands, self._body
        blown = self._sculpture.plan.strips[balloon].blown
        assert blown is not None, "it is a round balloon"
        share = polygon_share(scene.bodies[b].rings[0].around)
        hands.pump_goal[b] = amount(blown.most.pressure, blown.most.volume) * share
        hands.pump_limit[b] = scene.settings.atmosphere
        hands.grip(int(scene.joint_start[b]) + 1, self._sculpture.frame.middle)

    def _pump_shape(self, shape: Shaped) -> None:
        scene, hands, b = self._sculpture.scene, self._sculpture.hands, self._body
        atmosphere = scene.settings.atmosphere
        volume = shape.volume * self._room
        hands.pump_goal[b] = (atmosphere + shape.pressure) * volume / float(scene.air.molar_energy)
        # No wall is so stiff: the pump gives its air in time whatever the shape is.
        hands.pump_limit[b] = atmosphere
        # Also those that are still flat.
        hands.touch(self._sculpture.bodies)

    def advance(self, share: float) -> None:
        """Pump: steadily, or stroke by stroke."""
        hands, b = self._sculpture.hands, self._body
        strokes = self._strokes
        hands.pump_flow[b] = (
            self._steady_flow(share) if strokes is None else self._stroke_flow(share, strokes)
        )
        if self._tail is not None:
            taut = min(max((1.0 - share / self._ramp) / (1.0 - BIRTH), 0.0), 1.0)
            self._tail.lead(float(hands.pump_flow[b]), taut)
        if self._touches and share >= BIRTH * self._ramp:
            self._touches = False
            hands.stop_touching([b])
        if share >= 1.0:
            self._take_pump_off()

    def _steady_flow(self, share: float) -> float:
        """Return the flow after a share of the time, mol/s.

        It starts and stops gently, as a tube is pushed along by its own front.
        """
        gentle = min(1.0, share / self._ramp, (1.0 - share) / self._ramp)
        flow: float = self._sculpture.hands.pump_goal[self._body]
        return flow / (PUMP_TIME * (1.0 - self._ramp) * self._seconds) * max(gentle, 0.0)

    def _stroke_flow(self, share: float, strokes: int) -> float:
        """Return the flow that brings what is due after a share of the time, mol/s."""
        if share >= 1.0:
            return 0.0
        begin, end, _ = self._sculpture.frame
        all_of_it = float(self._sculpture.hands.pump_goal[self._body]) - self._begun
        due = self._begun + brought(share, strokes) * all_of_it
        gentle = min(share * self._seconds / FIRST_PUSH, 1.0)
        most = gentle * MOST_FLOW * all_of_it / self._seconds
        return min(max(due - self._gas, 0.0) / (end - begin), most)

    def _take_pump_off(self) -> None:
        settings, hands = self._sculpture.scene.settings, self._sculpture.hands
        if self._tail is not None:
            self._tail.leave()
            hands.set_drag(self._body, settings.drag)
        hands.let_soften(self._body)
        self._sculpture.inflated_at[self._body] = self._sculpture.frame.end
