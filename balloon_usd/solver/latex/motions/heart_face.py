"""Turning a heart about itself until one sees its lobes beside each other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.operations.moves import FRONTS
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, unit

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.sculpture import LatexSculpture

    Floats = NDArray[np.float64]

NEARLY_ALONG = 0.9
"""Cosine beyond which a heart points to its maker, or away, who sees it from above then."""


class HeartFace:
    """A heart that hands turn about the way in which it points, while they lead it there."""

    def __init__(
        self, sculpture: LatexSculpture, bubble: str, base: Floats, turn: Floats, toward: Floats, spin: float
    ) -> None:
        """Find where its lobes shall lie.

        Args:
            sculpture: the figure.
            bubble: the heart.
            base: joint on which it hangs, (3,), m.
            turn: turn that brings it to where it points in the end, (3, 3).
            toward: unit direction in which it does, (3,).
            spin: how far beyond its face it is turned, rad.
        """
        self._sculpture, self._base = sculpture, base
        body = sculpture.body[sculpture.plan.recipe.piece.bubbles[bubble].balloon]
        self._vertices = VertexSet(sculpture.scene.vertices_of(body))
        self._ring = sculpture.joints[sculpture.plan.table.guides(bubble)[0]]
        across = turn_about(toward, spin) @ np.cross(toward, faced(toward))
        self._across: Floats = turn.T @ across
        """Where its lobes shall lie, as if it had not been led yet."""
        self._angle = _halved(self._left(np.eye(3), turn.T @ toward))
        """How far it shall turn about itself, rad."""

    def advance(self, share: float, turn: Floats, way: Floats) -> None:
        """Turn it on, up to a share of the time.

        `turn`, `way`: how far it has been led by now, (3, 3), and in which direction it points, (3,).
        """
        begin, end, _ = self._sculpture.frame
        due = (1.0 - smooth(share)) * self._angle
        # What holds its nozzle turns it back: how far it still has to turn is measured.
        more = self._left(turn, way) - due
        self._sculpture.hands.spin(self._vertices, self._base, way, _halved(more) / (end - begin))

    def _left(self, turn: Floats, way: Floats) -> float:
        """Return how far it has to turn about itself, rad."""
        lobes, across = self._lobes(), turn @ self._across
        return math.atan2(float(np.cross(lobes, across) @ way), float(lobes @ across))

    def _lobes(self) -> Floats:
        """Return the unit direction from one lobe to the other, (3,)."""
        first, around = self._sculpture.hands.rings
        one = int(first[self._ring])
        places = self._sculpture.hands.places
        return unit(places[one].astype(np.float64) - places[one + int(around[self._ring]) // 2])


def faced(toward: Floats) -> Floats:
    """Return to which side a heart faces that points in a direction, both (3,): forward, or up."""
    forward = np.array(FRONTS["forward"])
    return np.array(FRONTS["up"]) if abs(float(forward @ toward)) > NEARLY_ALONG else forward


def _halved(angle: float) -> float:
    """Return an angle without half turns, which bring one lobe to where the other was, rad."""
    return math.remainder(angle, math.pi)
