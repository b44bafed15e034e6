"""V08, V16, V17: the gas law, free fall, and that nothing pushes itself."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import Rubber, rubber_named
from tests.verification.lone_kernels import balloon_gas
from tests.verification.setups import Rig, cube_sphere, plain, tube

RADIUS, THICKNESS = 0.02, 0.2e-3
LATEX = plain(rubber_named("ogden"))


@pytest.mark.parametrize(("share", "theory"), [(0.99, 8.09e3), (0.95, 12.70e3), (0.90, 19.04e3)])
def test_trapped_gas_that_is_squeezed_follows_the_gas_law(verify, share, theory):
    mesh = cube_sphere(RADIUS, 6)
    rig = Rig(mesh, LATEX, THICKNESS)
    rig.place(mesh.points)
    rig.fill(0, 7.0e3)
    rig.scene.x.assign((mesh.points * share ** (1 / 3)).astype(np.float32))
    rig.stepper._volumes()
    rig.stepper._launch(balloon_gas, 1, fraction=1.0)
    exact = (101325.0 + 7.0e3) / share - 101325.0
    verify("V08", f"gas squeezed to {share:.2f}, Pa", rig.array("pressure")[0], exact, 1e-3)
    assert exact == pytest.approx(theory, rel=1e-3)


def test_an_empty_balloon_falls_with_g(verify):
    feather = Rubber("feather", mu=(1.0,), alpha=(2.0,), softening=None)
    mesh = cube_sphere(RADIUS, 4)
    rig = Rig(mesh, feather, THICKNESS, vented=(0,), gravity=9.81, scale_mass=False, dt=1e-4, substeps=100)
    for _ in range(10):
        rig.advance()
    verify("V16", "free fall in vacuum, speed after 0.1 s, m/s", -rig.array("v")[:, 2].mean(), 0.981, 1e-4)
    fallen = (mesh.points - rig.points)[:, 2].mean()
    verify("V16", "free fall in vacuum, path after 0.1 s, m", fallen, 0.5 * 9.81 * 0.1**2 * 1.001, 1e-4)


def test_a_closed_wall_under_pressure_neither_pushes_nor_turns_itself(verify):
    mesh = cube_sphere(RADIUS, 6)
    rig = Rig(mesh, LATEX, THICKNESS, substeps=2)
    bumps = 1.0 + 0.2 * np.random.default_rng(3).random((len(mesh.points), 1))
    rig.place(mesh.points * bumps + [0.1, -0.2, 0.3])
    rig.fill(0, 7.0e3)
    rig.advance()
    push, turn = rig.momentum()
    scale = 7.0e3 * np.pi * RADIUS**2 * 2 * rig.scene.settings.dt
    verify("V17", "sphere, momentum from inside, of p A t", np.linalg.norm(push) / scale, 0.0, 1e-5)
    verify("V17", "sphere, angular momentum, of p A r t", np.linalg.norm(turn) / (scale * RADIUS), 0.0, 1e-5)


def test_two_chambers_of_different_pressure_neither_push_nor_turn_themselves(verify):
    mesh = tube(4.5e-3, 12, np.linspace(0.0, 0.06, 21), parts=(9,))
    rig = Rig(mesh, LATEX, THICKNESS, gauge=(7.0e3, 3.0e3), substeps=2)
    bend = mesh.points * [1.0, 1.3, 0.9] + [0.0, 0.1, 0.2]
    bend[:, 1] += 2.0 * mesh.points[:, 0] ** 2
    rig.place(bend)
    rig.fill(0, 7.0e3)
    rig.fill(1, 3.0e3)
    rig.advance()
    push, turn = rig.momentum()
    scale = 7.0e3 * np.pi * 4.5e-3**2 * 2 * rig.scene.settings.dt
    verify("V17", "two chambers, momentum from inside, of p A t", np.linalg.norm(push) / scale, 0.0, 1e-4)
    verify(
        "V17", "two chambers, angular momentum, of p A L t", np.linalg.norm(turn) / (scale * 0.06), 0.0, 1e-4
    )
