"""How near the walls of a sculpture are to bursting, measured in its frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.burst import SCATTER, WHOLE, burst_energy, burst_load, least_burst_stretch
from balloon_usd.balloon.rubber import relaxed_stretches
from balloon_usd.solver.corners import vector_areas

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.frame import Frame

NEAR = 0.955
"""Share of `least_burst_stretch` below which a wall is far from bursting even where it is as taut across."""
HUGE = 1e3
"""Load above which a wall has burst long since: the energy of a Gent rubber is infinite at its limit."""


class WallLoad(NamedTuple):
    """The load of the wall of one balloon in one frame."""

    load: float
    """1 where the wall bursts, as of `burst_load`."""
    bubble: str
    """Where most of it is."""


NO_LOAD = WallLoad(0.0, "")


class Bursting:
    """Measures the loads of the walls of one sculpture."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Prepare for the balloons of a plan; one mesh a balloon, in the order of `Plan.strips`."""
        bursts = plan.recipe.physics.traits.burst_stretch is not None
        pairs = zip(plan.strips.values(), meshes, strict=True)
        self._walls = [_Wall(strip, mesh) for strip, mesh in pairs] if bursts else []

    def load(self, frame: Frame, above: float = 0.0) -> WallLoad:
        """Return the highest load of its walls in a frame; springs have none.

        What is led out of other walls bears none: creases that hands close are stretched by that, for some
        frames, to many times the load at which latex tears.

        `above`: share of `least_burst_stretch` below which the wall is left out; `NEAR` makes it quick, and
        changes no load of 1.
        """
        loads = [
            wall.load(frame.points[balloon], frame.forced(balloon), above)
            for balloon, wall in enumerate(self._walls)
        ]
        return max(loads, default=NO_LOAD)

    def near(self, balloon: int, stretch: NDArray[np.float32], highest: float) -> bool:
        """Tell whether a balloon may be bursting at the stretches of its vertices, (V,), in microseconds."""
        return bool(self._walls) and self._walls[balloon].near(stretch, highest)


class _Wall:
    """The wall of one balloon."""

    def __init__(self, strip: Strip, mesh: BalloonMesh) -> None:
        self._rubber = strip.rubber
        self._names = [bubble.name for bubble in strip.bubbles]
        self._quads, self._bubble = mesh.quads, mesh.quad_bubble
        self._rest = np.linalg.norm(vector_areas(mesh.points, mesh.quads), axis=1)
        self._volume = strip.size.thickness * self._rest
        corners = np.repeat(0.25 * self._volume, 4)
        vertices = np.bincount(mesh.quads.ravel(), corners, minlength=len(mesh.points))
        self._vertex_volume = vertices.astype(np.float32)
        self._least = least_burst_stretch(strip.rubber)
        self._stretches = np.linspace(NEAR * self._least, 1.5 * self._least, 64)
        worst = strip.rubber.energy(self._stretches, self._stretches) / burst_energy(strip.rubber)
        self._worst = np.minimum(worst, HUGE) ** SCATTER
        self._below = float(self._worst[0]) * self._volume.sum() / WHOLE

    def near(self, stretch: NDArray[np.float32], highest: float) -> bool:
        """Tell whether the load may be 1, were all that is high as high as that and as taut across."""
        if highest <= self._least:
            return False
        share = float(self._vertex_volume[stretch > NEAR * self._least].sum()) / WHOLE
        most = float(np.interp(highest, self._stretches, self._worst))
        return bool(share * most + self._below >= 1.0)

    def load(self, points: NDArray[np.float32], stretch: NDArray[np.float32], above: float) -> WallLoad:
        """Return the load, from vertex positions, (V, 3) m, and the largest stretch at every vertex, (V,), 0
        where it is not counted.
        """
        corners = stretch[self._quads]
        large = corners.mean(axis=1, dtype=np.float64)
        taut = np.flatnonzero((large > above * self._least) & corners.all(axis=1))
        if not taut.size:
            return NO_LOAD
        large, volume = large[taut], self._volume[taut]
        grown = np.linalg.norm(vector_areas(points, self._quads[taut]), axis=1) / self._rest[taut]
        energies = self._rubber.energy(*relaxed_stretches(large, grown / large))
        energies = np.minimum(energies, HUGE * burst_energy(self._rubber))
        parts = np.bincount(self._bubble[taut], volume * (energies / energies.max()) ** SCATTER)
        return WallLoad(burst_load(self._rubber, volume, energies), self._names[int(np.argmax(parts))])
