"""A finished figure as a rigid body in air: its mass, what it weighs, and what moves with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.air import OUTSIDE_DENSITY
from balloon_usd.solver.corners import vector_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ADDED_MASS = 0.5
"""Air that moves with a body, in what it displaces: that of a sphere, between the 0 and 1 of a long cylinder
that moves along its axis and across it (Lamb 1932, Hydrodynamics, arts. 92 and 103).
"""


@dataclass(frozen=True)
class Lumps:
    """Rubber and gas of a figure, as points."""

    place: Floats
    """Where they are, (N, 3), m."""
    mass: Floats
    """Mass of rubber or gas, (N,), kg."""
    displaced: Floats
    """Volume of air that is not there, (N,), m3."""

    def at(self, part: Ints | slice) -> Lumps:
        """Return those with some numbers."""
        return Lumps(self.place[part], self.mass[part], self.displaced[part])

    @classmethod
    def of(cls, parts: Sequence[Self]) -> Self:
        """Return the lumps of several together."""
        return cls(
            np.concatenate([part.place for part in parts]),
            np.concatenate([part.mass for part in parts]),
            np.concatenate([part.displaced for part in parts]),
        )


@dataclass(frozen=True)
class RigidFigure:
    """What of a figure decides how it falls; places from its centre of inertia, m."""

    points: Floats
    """Its vertices, (V, 3), m."""
    panels: Floats
    """Middles of its faces, (Q, 3), m."""
    areas: Floats
    """Outward vector areas of these, (Q, 3), m2."""
    centre: Floats
    """Centre of inertia when it was made, (3,), m."""
    inertial: float
    """Mass that has to be moved: rubber, gas and the air that moves with it, kg."""
    tensor: Floats
    """Its tensor of inertia, (3, 3), kg m2."""
    heavy: float
    """Mass that it weighs: rubber and gas, less the air that it displaces, kg."""
    heavy_arm: Floats
    """Where this weight acts, (3,), m."""
    firmness: Floats
    """Stiffness of the ground's push on every vertex, (V,), N/m."""

    @classmethod
    def of(cls, lumps: Lumps, points: Floats, quads: Ints, firmness: Floats) -> Self:
        """Return the body of a figure with these vertices (V, 3), m, and faces (Q, 4)."""
        moved = lumps.mass + ADDED_MASS * OUTSIDE_DENSITY * lumps.displaced
        inertial = float(moved.sum())
        centre = moved @ lumps.place / inertial
        arms = lumps.place - centre
        square = float(moved @ (arms * arms).sum(axis=1))
        tensor = square * np.eye(3) - (moved[:, None] * arms).T @ arms
        weighing = lumps.mass - OUTSIDE_DENSITY * lumps.displaced
        heavy = float(weighing.sum())
        return cls(
            points=points - centre,
            panels=points[quads].mean(axis=1) - centre,
            areas=vector_areas(points, quads),
            centre=centre,
            inertial=inertial,
            tensor=tensor,
            heavy=heavy,
            heavy_arm=weighing @ arms / heavy,
            firmness=firmness,
        )
