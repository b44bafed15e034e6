"""How the wound joints of a figure that nothing holds come undone, all at once.

Each springs back, and the parts between them turn as fast as the inertia of their rubber and gas and the drag
of the air allow, and so that neither momentum nor angular momentum changes: a bubble between two alike twists
is in balance until one of them has given way.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.hinges import HingedFigure, Limits
from balloon_usd.solver.latex.wound_joint import CLOSED_ANGLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.hinges import HingedParts
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.wound_joint import WoundJoint

Floats = NDArray[np.float64]

STEPS = 16
"""Steps in a frame in which unwinding is followed."""
MOST_ANGLE = 2.6
"""Largest angle by which a part turns in a frame, rad: from half a turn on it would be seen as a turn the
other way.
"""
FASTEST_WALL = 1.0
"""Largest speed of a wall that turns with what one joint unwinds, m/s: three turns between two bubbles of a
260 take a third of a second, of a long arm some seconds.
"""
MOST_SPEED = 2.0
"""Largest speed of a wall with all that unwinds, m/s: about as fast as a 260 may spin."""
SWING = 0.5
"""Largest speed of the centre of a part, m/s: what swings into others faster may be stretched till it tears.
Without it a tree of 24 bubbles was thrown about at 5 m/s.
"""
OPENING_SECONDS = 0.25
"""Least time in which a neck opens from half a turn on, s: in 0.15 s walls were thrown out to twice the
stretch at which they tear, and through themselves in every second chain of small bubbles.
"""
SETTLING_SECONDS = 0.12
"""Time in which gas and walls settle about a neck that has opened, s."""
NEARLY_OPEN = 1.1 * CLOSED_ANGLE
"""Wound angle from which a joint waits until a neck beside it has opened, rad."""
LOCKED = 1.0
"""Viscosity of a joint that waits, N m s: ten thousand times that of others."""


@dataclass(frozen=True, eq=False)
class LooseNeck:
    """A wound neck that nothing holds."""

    name: str
    joint: int
    """Of the scene."""
    wound: WoundJoint


class Unwinding:
    """The loose necks of a figure."""

    def __init__(
        self,
        scene: LatexScene,
        hands: LatexControls,
        necks: Sequence[LooseNeck],
        vertices: NDArray[np.int64],
        beyond: NDArray[np.bool_],
    ) -> None:
        """Begin at rest; `vertices`, `beyond`: of every neck, as of `HingedFigure`."""
        self._hands = hands
        self._drag = scene.settings.drag
        self._all = tuple(necks)
        self._opened: dict[LooseNeck, float] = {}
        """Necks that have opened, and how long ago, s."""
        joints = [neck.joint for neck in necks]
        self._figure = HingedFigure(scene, vertices, beyond, joints, hands.beside[joints])

    @property
    def necks(self) -> list[LooseNeck]:
        """Those that still unwind."""
        return [neck for neck in self._all if neck.wound.turns]

    def advance(self, seconds: float, middle: NDArray[np.float32]) -> list[LooseNeck]:
        """Let them unwind in the coming frame of so many seconds; return those that did.

        `middle`: of all joints, (J, 3), m.
        """
        moving = [number for number, neck in enumerate(self._all) if neck.wound.turns]
        parts = self._figure.parts(self._hands.places, middle, moving)
        necks = [self._all[number] for number in moving]
        wound, limits = [neck.wound for neck in necks], Limits(MOST_SPEED, SWING, MOST_ANGLE / seconds)
        alone = _rates_alone(parts)
        for _ in range(STEPS):
            response = parts.response()
            self._open_in_turns(necks)
            viscosity = np.array([_viscosity(*each) for each in zip(wound, alone, strict=True)])
            impulses = impulses_after(wound, response.compliance, viscosity, self._drag, seconds / STEPS)
            impulses *= parts.share_below(response, impulses, limits)
            parts.turn(response.turns @ impulses, seconds / STEPS)
            for joint, own, rate in zip(wound, impulses, response.compliance @ impulses, strict=True):
                joint.impulse = float(own)
                joint.turn(float(rate) * seconds / STEPS)
        self._figure.follow(self._hands, parts, seconds)
        self._opened = {neck: ago + seconds for neck, ago in self._opened.items()}
        self._opened |= {neck: 0.0 for neck in necks if not neck.wound.turns}
        return necks

    def _open_in_turns(self, necks: Sequence[LooseNeck]) -> None:
        """Let only one neck of a bubble open at a time, and its gas settle: with two it left faster than its
        wall could follow, and small bubbles turned inside out.
        """
        open_yet = [neck for neck, ago in self._opened.items() if ago < SETTLING_SECONDS]
        open_yet += [neck for neck in necks if neck.wound.angle < CLOSED_ANGLE]
        moving = {segment for neck in open_yet for segment in self._beside(neck)}
        for neck in necks:
            nearly, beside = CLOSED_ANGLE <= neck.wound.angle < NEARLY_OPEN, self._beside(neck)
            neck.wound.waits = nearly and not moving.isdisjoint(beside)
            if nearly and not neck.wound.waits:
                moving.update(beside)

    def _beside(self, neck: LooseNeck) -> list[int]:
        """Return the segments of the scene before and beyond a neck."""
        beside: list[int] = self._hands.beside[neck.joint].tolist()
        return beside


def _rates_alone(parts: HingedParts) -> Floats:
    """Return the rate of every hinge at which it alone moves walls as fast as they may go, (H,), rad/s."""
    response = parts.response()
    return np.asarray(FASTEST_WALL * response.compliance.diagonal() / parts.fastest_walls(response))


def _viscosity(joint: WoundJoint, rate: float) -> float:
    """Return the viscosity with which a joint unwinds at a rate (rad/s) in the end, and opens no faster than
    its wall can follow, N m s.
    """
    if joint.waits:
        return LOCKED
    if joint.angle < CLOSED_ANGLE:
        rate = min(rate, CLOSED_ANGLE / OPENING_SECONDS)
    return joint.most_torque / rate


def impulses_after(
    wound: Sequence[WoundJoint], compliance: Floats, viscosity: Floats, drag: float, seconds: float
) -> Floats:
    """Return the impulses of wound joints that have sprung back for a while, (H,), N m s.

    The torques are those at the end of that while (backward Euler), so that light parts do not swing.

    Args:
        wound: the joints.
        compliance: rate of each for an impulse in each, (H, H), 1/(kg m2).
        viscosity: of the rubber of each, (H,), N m s.
        drag: rate at which the air brakes, 1/s.
        seconds: the while.
    """
    spring = np.array([joint.spring for joint in wound])
    torque = np.array([joint.torque for joint in wound])
    before = np.array([joint.impulse for joint in wound])
    laws = np.eye(len(wound)) + (seconds * (seconds * spring + viscosity))[:, None] * compliance
    return np.asarray(np.linalg.solve(laws, before - seconds * torque) * math.exp(-drag * seconds))
