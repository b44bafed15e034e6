"""Air particles of a blown-up balloon before the simulation (Kosaka 2008, 3.2 and 4.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.capsule_mesh import EXPERIMENT_LENGTH, EXPERIMENT_RADIUS
from balloon_usd.plan.blown import blown_shape

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip

Floats = NDArray[np.float64]

EXPERIMENT = (40, 4, 5)
"""Particles of the experiment along, across and up."""
PACKED = 0.4 / 2.55
"""Spacing of the experiment's particles at the start, in radii of its capsule."""
FROM_WALL = 0.5
"""Least distance of an evenly placed particle from the wall, in spacings of its lattice."""
HALVINGS = 50
"""Bisections for that spacing."""


def experiment_spacing(radius: float) -> float:
    """Return how far apart (m) the experiment's particles are once spread, for a capsule's radius (m)."""
    volume = _volume(EXPERIMENT_LENGTH, EXPERIMENT_RADIUS)
    return float(radius / EXPERIMENT_RADIUS * (volume / np.prod(EXPERIMENT)) ** (1.0 / 3.0))


def start_particles(strip: Strip, spacing: float | None = None) -> Floats:
    """Return where the air particles of a balloon are at the start, (P, 3) float64, m.

    In a capsule they are packed as in the thesis's experiment; in a whole balloon they are spread evenly, as
    many as fill it at the density that the experiment's have once spread, or `spacing` (m) apart.
    """
    shape = blown_shape(strip)
    if strip.capsule and spacing is None:
        return _packed(shape.end, shape.wide)
    return _even(shape.end, min(shape.wide, 0.5 * shape.end), spacing or experiment_spacing(shape.wide))


def _volume(length: float, radius: float) -> float:
    """Volume (m3) of a tube with round ends."""
    return float(np.pi * radius**2 * (length - 2.0 / 3.0 * radius))


def _even(length: float, radius: float, spacing: float) -> Floats:
    """An even lattice in a tube with round ends: as many particles as fill it to the wall at a spacing (m).

    None is at the wall itself, so the lattice is a little closer than that.
    """
    wanted = max(_volume(length, radius) / spacing**3, 1.0)
    step = _lattice_step(length, radius, wanted)
    along = max(round(length / step), 1)
    found = len(_inside(length, radius, step, along))
    return _inside(length, radius, step, max(round(along * wanted / found), 1))


def _inside(length: float, radius: float, step: float, along: int) -> Floats:
    """What is not near the wall, at least the deepest, of a lattice of a spacing (m) in `along` layers."""
    across = max(int(np.ceil(2.0 * radius / step)), 1)
    lattice = _lattice((length, across * step, across * step), (along, across, across))
    lattice[:, 0] += 0.5 * length
    x = lattice[:, 0]
    beyond = x - np.clip(x, radius, length - radius)
    depth = radius - np.sqrt(beyond**2 + lattice[:, 1] ** 2 + lattice[:, 2] ** 2)
    kept: Floats = lattice[depth >= min(FROM_WALL * step, depth.max())]
    return kept


def _lattice_step(length: float, radius: float, count: float) -> float:
    """Spacing (m) at which so many particles fill what is not near the wall of a tube with round ends."""
    low, high = 0.0, radius / FROM_WALL
    for _ in range(HALVINGS):
        step = 0.5 * (low + high)
        free = _volume(length - 2.0 * FROM_WALL * step, radius - FROM_WALL * step)
        low, high = (step, high) if count * step**3 < free else (low, step)
    return low


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
