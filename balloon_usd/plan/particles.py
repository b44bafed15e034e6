"""Air particles of a blown-up balloon before the simulation (Kosaka 2008, 3.2 and 4.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.plan.blown import blown_shape

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip

Floats = NDArray[np.float64]

EXPERIMENT = (40, 4, 5)
"""Particles of the experiment along, across and up."""
EXPERIMENT_LENGTH = 0.20
"""Length of its capsule, m."""
EXPERIMENT_RADIUS = 0.0255
"""Radius of its capsule, m."""
PACKED = 0.4 / 2.55
"""Spacing of the experiment's particles at the start, in radii of its capsule."""
FROM_WALL = 0.5
"""Least distance of an evenly placed particle from the wall, in spacings."""


def experiment_spacing(radius: float) -> float:
    """Return how far apart (m) the experiment's particles are once spread, for a capsule's radius (m)."""
    scale = radius / EXPERIMENT_RADIUS
    straight = EXPERIMENT_LENGTH - 2.0 * EXPERIMENT_RADIUS
    volume = np.pi * EXPERIMENT_RADIUS**2 * (straight + 4.0 / 3.0 * EXPERIMENT_RADIUS)
    return float(scale * (volume / np.prod(EXPERIMENT)) ** (1.0 / 3.0))


def start_particles(strip: Strip, spacing: float | None = None) -> Floats:
    """Return where the air particles of a balloon are at the start, (P, 3) float64, m.

    In a capsule they are packed as in the thesis's experiment; in a whole balloon they are spread evenly, at
    the density that the experiment's have once spread, or `spacing` (m) apart.
    """
    shape = blown_shape(strip)
    if strip.capsule and spacing is None:
        return _packed(shape.end, shape.wide)
    step = spacing or experiment_spacing(shape.wide)
    counts = (int(np.ceil(shape.end / step)), *(int(np.ceil(2.0 * shape.wide / step)),) * 2)
    lattice = _lattice((shape.end, 2.0 * shape.wide, 2.0 * shape.wide), counts)
    lattice[:, 0] += 0.5 * shape.end
    room = shape.radius_at(lattice[:, 0]) - FROM_WALL * step
    return lattice[np.hypot(lattice[:, 1], lattice[:, 2]) < room]


def _packed(length: float, radius: float) -> Floats:
    """The experiment's block in the middle of a capsule, as long as that asks for."""
    along = round(EXPERIMENT[0] * length / EXPERIMENT_LENGTH * EXPERIMENT_RADIUS / radius)
    counts = (max(along, 1), *EXPERIMENT[1:])
    block = _lattice(tuple(PACKED * radius * n for n in counts), counts)
    block[:, 0] += 0.5 * length
    return block


def _lattice(size: tuple[float, ...], counts: tuple[int, ...]) -> Floats:
    """Middles of the cells of a box about the origin, in order along x, then y, then z."""
    axes = [extent * ((np.arange(n) + 0.5) / n - 0.5) for extent, n in zip(size, counts, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
