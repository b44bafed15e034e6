"""Rubber that was stretched is softer on the way back: a latex sphere is blown up, and let down again."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.rubber import UnloadedRubber, rubber_named
from balloon_usd.balloon.tube_theory import sphere_pressure
from tests.verification.setups import Rig, cube_sphere

RADIUS, THICKNESS, CELLS = 0.02, 0.2e-3, 10
LATEX = rubber_named()
STRETCHES = (2.0, 3.0, 4.0)
"""Where the pressure is looked at, on the way up and on the way down."""
TOP = 5.0
"""Largest stretch."""
WORKED = UnloadedRubber(LATEX, float(LATEX.energy(TOP, TOP)))
"""The rubber as it is on the way down."""


@pytest.fixture(scope="module")
def there_and_back():
    """p* (Pa) at each of the stretches on the way up, at the top, on the way down, and on the way up again."""
    mesh = cube_sphere(RADIUS, CELLS)
    rig = Rig(mesh, LATEX, THICKNESS)
    rig.place(mesh.points)
    # All spheres of this mesh are alike: a stretch is the cube root of a volume.
    flat = float(rig.array("volume")[0])

    def blown(stretch, law):
        pressure = float(sphere_pressure(law, stretch)) * THICKNESS / RADIUS
        # The wall is led to where it will be, as it is: it would overshoot, and rubber remembers that.
        led = rig.points * stretch * (flat / float(rig.array("volume")[0])) ** (1.0 / 3.0)
        rig.scene.x.assign(led.astype(np.float32))
        amount = (pressure + ATMOSPHERE) * flat * stretch**3 / (GAS_CONSTANT * ROOM_TEMPERATURE)
        rig.scene.amount.assign(np.array([amount]))
        rig.settle(most=2000)
        # Gas at 1 atm hardly lets its volume change, whatever the wall does.
        assert float(rig.array("volume")[0]) == pytest.approx(flat * stretch**3, rel=1e-3)
        return float(rig.array("pressure")[0]) * RADIUS / THICKNESS

    up = [blown(stretch, LATEX) for stretch in STRETCHES]
    top = blown(TOP, LATEX)
    down = [blown(stretch, WORKED) for stretch in reversed(STRETCHES)][::-1]
    again = [blown(stretch, WORKED) for stretch in STRETCHES]
    return up, top, down, again, blown(TOP + 0.5, LATEX)


@pytest.mark.parametrize("place", range(len(STRETCHES)), ids=[str(s) for s in STRETCHES])
def test_at_one_volume_the_pressure_on_the_way_back_is_lower_by_the_softening_factor(
    verify, there_and_back, place
):
    up, _, down, _, _ = there_and_back
    stretch = STRETCHES[place]
    theory = LATEX.softening_factor(LATEX.energy(stretch, stretch), WORKED.w_max)
    assert theory < 0.8
    name = f"sphere let down from {TOP:g} to {stretch:g}, of pressure before"
    verify("M1", name, down[place] / up[place], theory, 1e-2)


@pytest.mark.parametrize("place", range(len(STRETCHES)), ids=[str(s) for s in STRETCHES])
def test_both_ways_have_the_pressures_of_theory(verify, there_and_back, place):
    up, _, down, _, _ = there_and_back
    stretch = STRETCHES[place]
    verify("M1", f"sphere blown up to {stretch:g}, p*, Pa", up[place], sphere_pressure(LATEX, stretch), 1e-2)
    verify(
        "M1", f"sphere let down to {stretch:g}, p*, Pa", down[place], sphere_pressure(WORKED, stretch), 1e-2
    )


def test_worked_rubber_goes_up_again_as_it_came_down(verify, there_and_back):
    _, _, down, again, _ = there_and_back
    for stretch, first, second in zip(STRETCHES, down, again, strict=True):
        verify(
            "M1",
            f"sphere blown up again to {stretch:g}, of pressure on the way down",
            second / first,
            1.0,
            1e-3,
        )


def test_beyond_its_largest_stretch_rubber_is_as_it_was_when_new(verify, there_and_back):
    theory = sphere_pressure(LATEX, TOP + 0.5)
    verify("M1", f"sphere blown up beyond {TOP:g}, p*, Pa", there_and_back[4], theory, 1e-2)
