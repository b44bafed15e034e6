"""Stretching the tip of a flat tail: rubber that was stretched is softer, and gives way to the gas."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class StretchTip(Motion):
    """Fingers that stretch a tip as far as gas would, and let it go."""

    def __init__(self, move: moves.StretchTip, sculpture: LatexSculpture) -> None:
        """Stretch it at once: what its rubber remembers is the highest energy that it has had."""
        scene, strip = sculpture.scene, sculpture.strip_of(sculpture.plan.table.ends(move.bubble)[0])
        body = sculpture.body[strip.balloon]
        mesh = scene.bodies[body]
        along = mesh.along[mesh.quads].mean(axis=1)
        tip = int(scene.quad_start[body]) + np.flatnonzero(along > strip.size.length - move.length)
        bulged = maxwell_state(strip.rubber).bulged
        peak = scene.peak_energy.numpy()
        peak[tip] = np.maximum(peak[tip], np.float32(strip.rubber.energy(bulged.a, bulged.b)))
        scene.peak_energy.assign(peak)
