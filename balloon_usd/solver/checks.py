"""Checks of a run: what must hold in every frame, and the message when it does not."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.burst import least_burst_stretch
from balloon_usd.solver.bursting import NEAR, Bursting
from balloon_usd.solver.remedy import steadier
from balloon_usd.solver.scene import NO_LIMIT

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.solver.frame import Frame
    from balloon_usd.solver.frame_arrays import FrameArrays, Place

FASTEST = 5.0
"""Speed that no part of a balloon reaches between two frames unless the run has gone unstable, m/s."""
FARTHEST = 1.0e3
"""Distance beyond which a part has flown apart, m."""
LOWEST_PRESSURE = -20.0e3
"""Gauge pressure that no bubble of a balloon reaches, Pa: hands do not suck."""


class SculptureCheck:
    """Checks the frames of one sculpture, one after another."""

    def __init__(self, plan: Plan, meshes: tuple[BalloonMesh, ...], fps: float, substeps: int) -> None:
        self._plan = plan
        self._meshes = meshes
        self._fps = fps
        self._substeps = substeps
        self._bursting = Bursting(plan, meshes) if plan.recipe.physics.burst == "stop" else None
        self._last: Frame | None = None

    def failure(self, frame: Frame) -> str | None:
        """Return what is wrong with a frame, where and what helps, or None."""
        cause = (
            self._not_finite(frame) or self._impossible(frame) or self._too_fast(frame) or self._burst(frame)
        )
        self._last = frame
        return cause

    def skip(self, frame: Frame) -> None:
        """Take a frame that needs no check as the last one."""
        self._last = frame

    def _not_finite(self, frame: Frame) -> str | None:
        """Tell of a wall, stretch or gas that is no number any more."""
        for index, (strip, mesh, points) in enumerate(self._balloons(frame)):
            if not (np.isfinite(points).all() and np.isfinite(frame.stretch[index]).all()):
                lost = ~(np.isfinite(points).all(axis=1) & np.isfinite(frame.stretch[index]))
                share = f"{lost.sum()} of {len(lost)} vertices are no numbers any more"
                where = self._begun(index) if lost.all() else self._name(strip, mesh, int(np.argmax(lost)))
                return f"{where} has flown apart: {share}; {self._steadier()}"
        for bubble, volume in zip(self._plan.bubbles, frame.volume, strict=True):
            if not np.isfinite(volume):
                return f"the gas of {bubble.name} is no number any more; {self._steadier()}"
        return None

    def _begun(self, index: int) -> str:
        """Return where a balloon that is wholly lost was stretched most in the frame before."""
        strip, mesh = list(self._plan.strips.values())[index], self._meshes[index]
        if self._last is None:
            return f"balloon {strip.balloon}"
        return self._name(strip, mesh, int(np.argmax(self._last.stretch[index])))

    def _impossible(self, frame: Frame) -> str | None:
        """Tell of a bubble that has turned inside out: what follows would be no physics. Limp rubber may, and
        what is folded in a tube that gas fills by and by.
        """
        measured = zip(self._plan.bubbles, frame.pressure, frame.volume, strict=True)
        firm = (each for each in measured if each[0].name not in self._plan.limp)
        # Bubbles of one open tube have one pressure, to the last bit.
        for (_, pressure), open_tube in groupby(firm, key=lambda each: (each[0].balloon, float(each[1]))):
            parts = list(open_tube)
            if not (pressure > LOWEST_PRESSURE and sum(float(volume) for _, _, volume in parts) > 0.0):
                bubble, _, volume = min(parts, key=lambda each: float(each[2]))
                found = f"{pressure / 1e3:.0f} kPa in {volume * 1e6:.1f} cm3"
                return f"{bubble.name} has turned inside out ({found}): make it longer"
        return None

    def _too_fast(self, frame: Frame) -> str | None:
        if self._last is None:
            return None
        worst, where = 0.0, ""
        torn = {b.name for b, volume in zip(self._plan.bubbles, frame.volume, strict=True) if volume == 0.0}
        for (strip, mesh, now), then in zip(self._balloons(frame), self._last.points, strict=True):
            moved = np.abs(now - then)
            if torn:
                # No hands hold rags, and these snap back as fast as rubber can.
                moved[_walls_of(strip, mesh, torn)] = 0.0
            moved = moved.ravel()
            most = int(np.argmax(moved))
            if moved[most] > worst:
                worst, where = float(moved[most]), self._name(strip, mesh, most // 3)
        if worst * self._fps <= FASTEST:
            return None
        if worst > FARTHEST:
            return f"{where} has flown apart; {self._steadier()}"
        speed = f"{worst * self._fps:.1f} m/s"
        return f"a part of {where} moves at {speed}, faster than hands can move it; {self._steadier()}"

    def _burst(self, frame: Frame) -> str | None:
        if self._bursting is None:
            return None
        load, bubble = self._bursting.load(frame, NEAR)
        if load > 1.0:
            return f"{bubble} bursts: its wall has {load:.0%} of the load at which latex tears"
        return None

    def _balloons(self, frame: Frame) -> Iterator[tuple[Strip, BalloonMesh, NDArray[np.float32]]]:
        return zip(self._plan.strips.values(), self._meshes, frame.points, strict=True)

    def _name(self, strip: Strip, mesh: BalloonMesh, vertex: int) -> str:
        """Return the bubble that a vertex belongs to."""
        return strip.bubble_at(float(mesh.along[vertex])).name

    def _steadier(self) -> str:
        return steadier(self._plan.recipe, self._substeps)


def _walls_of(strip: Strip, mesh: BalloonMesh, bubbles: Container[str]) -> NDArray[np.int32]:
    """Return the vertices of the walls of those of some bubbles that are of a balloon, joints included."""
    own = [k for k, bubble in enumerate(strip.bubbles) if bubble.name in bubbles]
    return np.unique(mesh.quads[np.isin(mesh.quad_bubble, own)])


class BatchCheck:
    """Checks the sculptures of a flat state: all of them quickly, and one in detail where something may be
    wrong.
    """

    def __init__(
        self,
        plans: Sequence[Plan],
        meshes: Sequence[tuple[BalloonMesh, ...]],
        places: Sequence[Place],
        fps: float,
        substeps: int,
    ) -> None:
        """Check plans that lie at these places in the arrays of a frame."""
        self._places = places
        self._checks = [SculptureCheck(plan, m, fps, substeps) for plan, m in zip(plans, meshes, strict=True)]
        self._bubble = np.array([place.bubbles.start for place in places])
        """First bubble of every sculpture, (W,)."""
        self._arrays: FrameArrays | None = None
        self._last: FrameArrays | None = None

    def suspicious(self, arrays: FrameArrays, suspects: NDArray[np.int32]) -> list[int]:
        """Return the sculptures in which something may be wrong; the arrays of the frame before must be
        unchanged.

        `suspects`: 1 for those with walls that went too far or are stretched too much, (W,).
        """
        self._last, self._arrays = self._arrays, arrays
        # Comparisons with NaN are false.
        gas = (arrays.pressure > LOWEST_PRESSURE) & (arrays.volume >= 0.0) & (arrays.volume < np.inf)
        if not suspects.any() and gas.all():
            return []
        return np.flatnonzero((suspects != 0) | ~np.logical_and.reduceat(gas, self._bubble)).tolist()

    def failure(self, world: int) -> str | None:
        """Return what is wrong with a sculpture in the arrays checked last, or None."""
        assert self._arrays is not None, "no arrays were checked yet"
        place, check = self._places[world], self._checks[world]
        if self._last is not None:
            check.skip(self._last.frame(place, 0))
        return check.failure(self._arrays.frame(place, 0))


def travel_limit(seconds: float) -> float:
    """Return how far (m) a wall may go in some seconds before it is checked in detail, just below too far."""
    return 0.999 * FASTEST * seconds


def stretch_limits(plans: Sequence[Plan], bodies: Sequence[range]) -> NDArray[np.float32]:
    """Return how far every balloon may be stretched before it is checked in detail, (B,).

    `bodies`: balloons of every plan.
    """
    limits = [_least_burst_stretch(plan) for plan in plans]
    return np.repeat(limits, [len(run) for run in bodies]).astype(np.float32)


def _least_burst_stretch(plan: Plan) -> float:
    if plan.recipe.physics.burst != "stop":
        return NO_LIMIT
    return min(least_burst_stretch(strip.rubber) for strip in plan.strips.values())
