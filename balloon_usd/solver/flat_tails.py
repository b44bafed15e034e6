"""Flat tails in the frames of a run: the rubber at the tip of each tube that holds no gas beyond the front.

In latex the front is a slope of some centimetres. It counts as where it would be if it were steep, so that
the gas of the open part fills the rubber behind it as a tube of even width: as in the plan's budget. Balloons
of model kosaka have a steep front, which does not move: there the tail is what is thin.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.balloon.wound_neck import drawn_rubber
from balloon_usd.operations.moves import Pinch, Spin
from balloon_usd.operations.tempo import eased
from balloon_usd.plan.open_tube import OpenTube, softened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.frame import Frame

FLAT_BELOW = 2.0
"""Hoop stretch below which rubber counts as flat: between the thin phase (1.15) and the bulged one (5.7)."""


class _Neck(NamedTuple):
    """A neck that is closed at some time."""

    name: str
    start: float
    """When it begins to close, s."""
    end: float
    """When it is closed, s."""
    made: int
    """Bubbles of its balloon that are made then."""
    turning: Spin | None
    """Its turns, where it is wound."""

    def turned(self, time: float) -> float:
        """Return the full turns that are wound into it at a time, s."""
        if self.turning is None:
            return 0.0
        return self.turning.turns * eased((time - self.turning.start) / self.turning.seconds)


class _Tube(NamedTuple):
    """A tube among the balloons of a plan."""

    balloon: int
    """Among the balloons."""
    first: int
    """Its first bubble, among all."""
    strip: Strip
    mesh: BalloonMesh
    necks: tuple[_Neck, ...]


class FlatTails:
    """Measures the flat tails of one sculpture."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Take note of its tubes; one mesh a balloon, in the order of `Plan.strips`."""
        self._plan = plan
        self._tubes: list[_Tube] = []
        first = 0
        for index, (strip, mesh) in enumerate(zip(plan.strips.values(), meshes, strict=True)):
            if strip.has_tail:
                self._tubes.append(_Tube(index, first, strip, mesh, _necks(plan, strip)))
            first += len(strip.bubbles)

    @property
    def names(self) -> tuple[str, ...]:
        """Balloons that have a tail: only tubes do."""
        return tuple(tube.strip.balloon for tube in self._tubes)

    def left(self, frame: Frame) -> list[float]:
        """Return the flat tail of every such balloon in a frame, m."""
        return [self._left(frame, tube) for tube in self._tubes]

    def _left(self, frame: Frame, tube: _Tube) -> float:
        time = (frame.time_code - 1) / self._plan.recipe.fps
        necks = [each for each in tube.necks if each.start <= time and each.name not in frame.undone]
        made = necks[-1].made if necks else 0
        if not necks or time >= necks[-1].end:
            turns = necks[-1].turned(time) if necks else 0.0
            return self._behind(frame, tube, made, turns)
        # A neck that is closing parts the gas by and by.
        share = (time - necks[-1].start) / (necks[-1].end - necks[-1].start)
        before, turns = (necks[-2].made, necks[-2].turned(time)) if len(necks) > 1 else (0, 0.0)
        open_still = self._behind(frame, tube, before, turns)
        return (1.0 - share) * open_still + share * self._behind(frame, tube, made, 0.0)

    def _behind(self, frame: Frame, tube: _Tube, made: int, turns: float) -> float:
        """Return the flat tail of what is open behind so many bubbles and a neck of so many turns, m."""
        strip, mesh = tube.strip, tube.mesh
        start = strip.bubbles[made].rest_start
        if turns:
            start += 0.5 * drawn_rubber(strip.size, softened(strip.rubber), turns)
        if self._plan.recipe.physics.traits.starts_blown_up:
            return thin_rubber(mesh, frame.points[tube.balloon], start, strip.size.radius)
        if strip.tip_is_tied and made == len(strip.bubbles) - 1:
            return strip.size.length - start
        gas = frame.volume[tube.first + made : tube.first + len(strip.bubbles)]
        return unfilled_rubber(strip, mesh.around, start, float(gas.sum()))


def _necks(plan: Plan, strip: Strip) -> tuple[_Neck, ...]:
    names = [bubble.name for bubble in strip.bubbles]
    pinches = [move for move in plan.choreography.moves if isinstance(move, Pinch)]
    turning = {move.ring: move for move in plan.choreography.moves if isinstance(move, Spin)}
    rings = [(plan.table.rings[move.ring], move) for move in pinches]
    return tuple(
        _Neck(ring.name, move.start, move.end, names.index(ring.bubble) + 1, turning.get(move.ring))
        for ring, move in rings
        if ring.balloon == strip.balloon
    )


def unfilled_rubber(strip: Strip, around: int, start: float, volume: float) -> float:
    """Return the unstressed length (m) of the rubber at the tip of a tube that holds no gas.

    Args:
        strip: the tube.
        around: vertices round it: such a polygon holds more than the circle that it is drawn about.
        start: unstressed distance from the knot at which its open part begins (m).
        volume: of that part (m3).
    """
    length = strip.size.length - start
    tube = OpenTube(strip.size, softened(strip.rubber), length, volume / polygon_share(around))
    return min(tube.tail, length) if tube.blown_up else length


def thin_rubber(mesh: BalloonMesh, points: NDArray[np.float32], start: float, radius: float) -> float:
    """Return the unstressed length (m) of the rubber at the tip of a tube that is thin.

    Args:
        mesh: the balloon.
        points: (V, 3) m.
        start: unstressed distance from the knot at which its open part begins (m).
        radius: unstressed tube radius (m).
    """
    rings = mesh.ring_start[:, None] + np.arange(mesh.around)
    corners = points[rings].astype(np.float64)
    girth = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum(axis=1)
    unstressed = 2.0 * np.pi * polygon_share(mesh.around) * radius
    flat = (girth / unstressed < FLAT_BELOW) & (mesh.ring_along > start)
    last = len(flat) - 1
    while last >= 0 and flat[last]:
        last -= 1
    return float(mesh.ring_along[-1] + radius - mesh.ring_along[last]) if last < len(flat) - 1 else 0.0
