"""Watching a run: what must hold in every frame, and what to say when it does not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.rubber import BURST_STRETCH
from balloon_usd.solver.kernels.contact import HITS

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

FASTEST = 5.0
"""Speed that no part of a balloon reaches between two frames unless the run has gone unstable, m/s."""
STEADIER = "more substeps (physics: substeps) or a longer step (seconds) make the run steadier"
LOWEST_PRESSURE = -20.0e3
"""Gauge pressure that no bubble of a balloon reaches, Pa: hands do not suck."""


class Watch:
    """Checks the frames of one sculpture, one after another."""

    def __init__(self, plan: Plan, meshes: tuple[BalloonMesh, ...], fps: float) -> None:
        self._plan = plan
        self._meshes = meshes
        self._fps = fps
        self._last: Frame | None = None

    def failure(self, frame: Frame) -> str | None:
        """Return what is wrong with a frame, one sentence, or None."""
        cause = (
            self._not_finite(frame) or self._impossible(frame) or self._too_fast(frame) or self._burst(frame)
        )
        self._last = frame
        return cause

    def _not_finite(self, frame: Frame) -> str | None:
        for points, strip in zip(frame.points, self._plan.strips.values(), strict=True):
            if not np.isfinite(points).all():
                return f"balloon {strip.balloon} has flown apart; {STEADIER}"
        return None

    def _impossible(self, frame: Frame) -> str | None:
        """Tell of a bubble that has turned inside out: what follows would be no physics."""
        for bubble, pressure in zip(self._plan.bubbles, frame.pressure, strict=True):
            if not pressure > LOWEST_PRESSURE:
                return f"{bubble.name} has turned inside out ({pressure / 1e3:.0f} kPa): make it longer"
        return None

    def _too_fast(self, frame: Frame) -> str | None:
        if self._last is None:
            return None
        pairs = zip(frame.points, self._last.points, strict=True)
        fastest = max(float(np.abs(now - then).max()) for now, then in pairs) * self._fps
        if fastest <= FASTEST:
            return None
        return f"a part moves at {fastest:.1f} m/s, faster than hands can move it; {STEADIER}"

    def _burst(self, frame: Frame) -> str | None:
        if self._plan.recipe.physics.burst != "stop":
            return None
        for stretch, mesh, strip in zip(frame.stretch, self._meshes, self._plan.strips.values(), strict=True):
            worst = int(np.argmax(stretch))
            if stretch[worst] > BURST_STRETCH:
                bubble = strip.bubble_at(float(mesh.along[worst])).name
                return f"{bubble} bursts: stretch {stretch[worst]:.1f}, latex bears {BURST_STRETCH:.1f}"
        return None


def crowded(most_hits: int) -> str | None:
    """Tell when more vertices have pressed on one face at a time than there is room for."""
    if most_hits <= HITS:
        return None
    return f"{most_hits} vertices press on one face but there is room for {HITS}: use a finer detail"
