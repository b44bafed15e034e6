"""V40: what palms feel that squeeze a bubble of a 260 is its pressure on the flat of its wall.

Where a tube lies between plates its wall is under even tension about even pressure: each cross-section is two
half circles and two straight lines, whose length follows from its girth and the distance of the plates.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.solver.pressed import Pressed


def flat_area(bubble, frame):
    """Area of a palm that the wall lies on, m2: from the girths of all rings and the height between palms."""
    around = bubble.simulation.meshes[0][0].around
    points = bubble.shapes[frame]
    rings = points[: len(points) // around * around].reshape(-1, around, 3)
    chords = np.linalg.norm(rings - np.roll(rings, -1, axis=1), axis=2).sum(axis=1)
    girths = chords * (np.pi / around) / np.sin(np.pi / around)
    low, high = np.quantile(points[:, 2], (0.02, 0.98))
    flat = np.maximum(0.5 * (girths - np.pi * (high - low)), 0.0)
    return float(np.trapezoid(flat, rings.mean(axis=1)[:, 0]))


@pytest.mark.parametrize("percent", [20, 40])
def test_palms_feel_the_pressure_on_what_lies_flat_on_them(verify, percent):
    bubble = Pressed(f'squeeze: {{bubble: belly, by: "{percent} %"}}', held=20)
    theory = bubble.pressures[bubble.held] * flat_area(bubble, bubble.held)
    verify("V40", f"squeezed by {percent} %, force of a palm, N", bubble.forces[bubble.held][0], theory, 0.06)
