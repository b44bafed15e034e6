"""V38: a strap round a drum that turns holds by e to its friction times the angle (Euler 1769, Eytelwein 1808)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.solver.settings import SceneSettings
from tests.verification.setups import Floats, Meeting, Part, plain, plate, revolved

RADIUS, WIDTH, THICKNESS = 0.05, 0.02, 1e-3
"""Of the drum, of the strap, and of its wall, m."""
FREE = 0.05
"""Length of the strap from the drum to the hands at either end, m."""
STRAIN = 0.1
"""Of the strap before the drum turns."""
CELL = 5e-3
"""Length of a face of the strap, m."""
SPEED = 0.3
"""Of the drum's surface, m/s."""
SETTINGS = SceneSettings(dt=4e-5, drag=20.0, scale_mass=False, contact_offset=1e-3, contact_pressure=1e4)
FRAME = 50
"""Substeps of a frame."""
SETTLED, WATCHED = 0.35, 0.1
"""Times until it slides everywhere, and in which it is watched then, s."""


class Capstan(Meeting):
    """A strap whose ends are held, round a drum that turns about x."""

    def __init__(self, friction: float, angle: float, facets: int) -> None:
        self.half, self.turned = 0.5 * angle, 0.0
        drum = revolved(np.full(3, RADIUS), facets, np.array([-0.6, 0.0, 0.6]) * WIDTH)
        self.radius = RADIUS + SETTINGS.contact_offset
        path = angle * self.radius + 2.0 * FREE
        rows = round(path / CELL)
        flat = plate(2, rows, 1.0)
        rest = flat.points * [WIDTH, path / (1.0 + STRAIN), 0.0]
        # The first row is one end of the strap, and it faces the drum.
        last = len(rest) - 1 - np.arange(3) * (rows + 1)
        ends = np.concatenate([last, last - rows])
        strap = replace(flat, points=rest, quads=flat.quads[:, ::-1].copy())
        parts = [
            Part(strap, THICKNESS, held=ends),
            Part(drum, THICKNESS, held=np.arange(len(drum.points))),
        ]
        super().__init__(parts, plain(rubber_named()), replace(SETTINGS, friction=friction), substeps=FRAME)
        self.drum = drum.points
        self.place(np.concatenate([self._wound(flat.points * [WIDTH, path, 0.0], path), drum.points]))

    def _wound(self, flat: Floats, path: float) -> Floats:
        """The strap round the drum, from its flat points."""
        along = flat[:, 1] - 0.5 * path
        angle = np.clip(along / self.radius, -self.half, self.half)
        beyond = along - angle * self.radius
        out = np.stack([np.sin(angle), np.cos(angle)], axis=1) * self.radius
        ahead = np.stack([np.cos(angle), -np.sin(angle)], axis=1) * beyond[:, None]
        return np.column_stack([flat[:, 0] - 0.5 * WIDTH, out + ahead])

    def turn(self) -> None:
        """Advance by a frame in which the drum turns."""
        self.advance()
        rate = SPEED / RADIUS
        self.turned += rate * FRAME * SETTINGS.dt
        cos, sin = math.cos(self.turned), math.sin(self.turned)
        # About x: y goes to z.
        around = np.array([[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]])
        x, v = self.points, self.array("v")
        own = self.vertices[1]
        x[own] = self.drum @ around.T
        v[own] = np.cross([rate, 0.0, 0.0], x[own])
        self.scene.x.assign(x.astype(np.float32))
        self.scene.v.assign(v.astype(np.float32))

    def tensions(self) -> tuple[float, float]:
        """Pull of both ends, as the drum's push on the strap tells, N."""
        pull = np.array(
            [
                [-math.cos(self.half), -math.sin(self.half)],
                [math.cos(self.half), -math.sin(self.half)],
            ]
        )
        first, second = np.linalg.solve(pull.T, -self.push(0, 1)[1:])
        return float(first), float(second)


@pytest.mark.parametrize("facets", [24, 96])
@pytest.mark.parametrize("degrees", [90, 120, 270])
def test_a_strap_round_a_drum_holds_as_euler_says(verify, degrees, facets):
    friction = 0.3
    capstan = Capstan(friction, math.radians(degrees), facets)
    seconds = FRAME * SETTINGS.dt
    for _ in range(round(SETTLED / seconds)):
        capstan.turn()
    pulls = []
    for _ in range(round(WATCHED / seconds)):
        capstan.turn()
        pulls.append(capstan.tensions())
    slack, tight = sorted(np.mean(pulls, axis=0))
    name = f"friction {friction:g}, {degrees} degrees of a drum of {facets} facets, exponent"
    verify("V38", name, math.log(tight / slack), friction * math.radians(degrees), 0.05)
