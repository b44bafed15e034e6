"""V31: a sheet of rubber stays on a slope up to the tangent that is its friction, and on a steeper one it slides.

It lies on the slope all over and so can neither roll nor topple. Its mass is that of its rubber, and no air drags.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import chain

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.solver.settings import SceneSettings
from tests.verification.setups import Floats, Meeting, Mesh, Part, plain, plate, turned

NEAR = 0.03
"""How near to the limit of friction the sheet is watched, as a share of that."""
SLIDING = 0.1e-3
"""Way after which it slides, m: before, friction gives way by a sixth of that."""
FAST, SLOW = 0.5, 0.02
"""Speed at which the slope is tilted where the sheet surely stays, and near the limit, rad/s."""
HOLD = 0.5
"""How long a tilt is held, s."""
RUBBER = plain(rubber_named())
THICKNESS = 2e-3
GRAVITY = 9.81
SETTINGS = SceneSettings(
    dt=5e-5, drag=0.0, gravity=GRAVITY, scale_mass=False, contact_offset=1e-3, contact_pressure=1e3
)
"""The least contact pressure is a tenth of what scenes have: so light a sheet else presses itself in by less than what
float32 tells apart well.
"""
FRAME = 20
"""Substeps of a frame."""
HEIGHT = SETTINGS.contact_offset * (
    1.0 - 0.5 * RUBBER.density * THICKNESS * GRAVITY / SETTINGS.contact_pressure
)
"""Of the sheet above the ground, as it is pressed from above and from below, m."""
TURN = 0.3
"""Angle between the cells of the sheet and those of the slope, radians."""
BEGIN, TRAVEL, LONGEST = 0.05, 0.1, 0.3
"""Where above the middle a slide begins (m), how far it leads at most (m), and how long it takes at most (s)."""
START = 0.02
"""How long it takes until friction is all there, s."""
FRICTIONS = (0.4, 0.8)


def centred(mesh: Mesh) -> Mesh:
    """A plate about the origin."""
    return replace(mesh, points=mesh.points - mesh.points.mean(axis=0))


class Slope(Meeting):
    """A sheet on a slope that can be tilted: it falls towards +x."""

    def __init__(self, friction: float, angle: float, above: float = 0.0) -> None:
        """Lay the sheet down so far above the middle of the slope (m)."""
        sheet, ground = centred(plate(7, 7, 0.07)), centred(plate(21, 21, 0.21))
        # It faces the slope.
        sheet = replace(sheet, quads=sheet.quads[:, ::-1].copy())
        parts = [Part(sheet, THICKNESS), Part(ground, THICKNESS, held=np.arange(len(ground.points)))]
        super().__init__(parts, RUBBER, replace(SETTINGS, friction=friction), substeps=FRAME)
        self.ground, self.angle, self.speed = ground.points, angle, 0.0
        self.place(
            np.concatenate([turned(sheet.points, TURN) + [-above, 0.0, HEIGHT], ground.points]) @ self.axes
        )

    @property
    def axes(self) -> Floats:
        """Unit vectors down the slope, along it, and away from it, as rows."""
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        return np.array([[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]])

    @property
    def seconds(self) -> float:
        """Of a frame."""
        return FRAME * self.scene.settings.dt

    @property
    def way(self) -> float:
        """How far the sheet is below the middle of the slope, m."""
        return float((self.points[self.vertices[0]] @ self.axes[0]).mean())

    def pushes(self) -> tuple[float, float]:
        """Force of the slope on the sheet, up the slope and away from it, N."""
        down, _, away = self.axes @ self.push(0, 1)
        return -float(down), float(away)

    def tilt(self, angle: float, speed: float) -> Iterator[None]:
        """Tilt the slope to another angle at this speed (rad/s); tell after every frame."""
        self.speed = speed
        while self.angle < angle:
            self.advance()
            self.angle += speed * self.seconds
            self._put_ground()
            yield
        self.speed = 0.0
        self._put_ground()

    def _put_ground(self) -> None:
        x, v = self.points, self.array("v")
        x[self.vertices[1]] = self.ground @ self.axes
        v[self.vertices[1]] = np.cross([0.0, self.speed, 0.0], x[self.vertices[1]])
        self.scene.x.assign(x.astype(np.float32))
        self.scene.v.assign(v.astype(np.float32))


@cache
def tilted(friction: float) -> tuple[float, float, float]:
    """Tilt a slope to just below its limit, hold it, and tilt it on until the sheet slides.

    Returns the way that it crept while it was held (m), and the tangent of the slope and the largest share of the push
    away from the slope that the push up it has been when it slid.
    """
    slope = Slope(friction, 0.0)
    watched = math.atan((1.0 - NEAR) * friction)
    for _ in chain(slope.tilt(0.95 * watched, FAST), slope.tilt(watched, 2.0 * SLOW)):
        pass
    begin = slope.way
    for _ in range(round(HOLD / slope.seconds)):
        slope.advance()
    here, most = slope.way, 0.0
    for _ in slope.tilt(math.atan(2.0 * friction), SLOW):
        up, away = slope.pushes()
        most = max(most, up / away)
        if slope.way > here + SLIDING:
            break
    return here - begin, math.tan(slope.angle), most


@pytest.mark.parametrize("friction", FRICTIONS)
def test_a_sheet_stays_on_a_slope_just_below_its_limit(verify, friction):
    crept, _, _ = tilted(friction)
    verify("V31", f"friction {friction:g}, 3 % below it, crept in 0.5 s, mm", 1e3 * crept, 0.0, 0.1)


@pytest.mark.parametrize("friction", FRICTIONS)
def test_a_slope_that_is_tilted_holds_a_sheet_up_to_its_friction(verify, friction):
    _, tangent, share = tilted(friction)
    verify("V31", f"friction {friction:g}, slope on which it slides", tangent, friction, 3e-2)
    verify("V31", f"friction {friction:g}, largest push up, in that away", share, friction, 3e-2)


@pytest.mark.parametrize("steeper", [1.0 + NEAR, 1.5, 2.0])
@pytest.mark.parametrize("friction", FRICTIONS)
def test_a_sheet_slides_down_a_steeper_slope_as_coulomb_says(verify, friction, steeper):
    angle = math.atan(steeper * friction)
    theory = GRAVITY * (math.sin(angle) - friction * math.cos(angle))
    slope = Slope(friction, angle, BEGIN)
    ways = []
    for _ in range(round(min(LONGEST, math.sqrt(2.0 * TRAVEL / theory)) / slope.seconds)):
        slope.advance()
        ways.append(slope.way)
    seconds = slope.seconds * np.arange(1, len(ways) + 1)
    sliding = seconds > START
    found = 2.0 * np.polyfit(seconds[sliding], np.array(ways)[sliding], 2)[0]
    name = f"friction {friction:g}, slope of {steeper:g} of it"
    verify("V31", f"{name}, acceleration, m/s2", found, theory, 3e-2)
