"""Air that has leaked beyond every offset region is brought back into its own bubble."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kosaka.model import KosakaModel
from tests.solver.kosaka_bench import DEVICES
from tests.solver.kosaka_scenes import AROUND, borders, filled, freeze, one_frame, place_of, small_plan

APART = 0.03
"""How far beside another balloon may lie and still reach where lost air is, m."""


def lost(model: KosakaModel, particle: int, place) -> np.ndarray:
    """Where a particle of the first balloon is that was put somewhere, after it has been looked for."""
    air = model.scene.air.numpy()
    air[particle] = place
    model.scene.air.assign(air)
    one_frame(model)
    model.stepper.find_leaked()
    return model.scene.air.numpy()[particle]


def off_axis(place: np.ndarray) -> float:
    return float(np.hypot(place[1], place[2]))


@pytest.fixture(scope="module")
def radius() -> float:
    return float(np.abs(small_plan()[1].points[:, 1]).max())


@pytest.mark.parametrize("device", DEVICES)
def test_air_far_outside_is_put_behind_the_nearest_wall_at_rest(device, radius):
    model = filled(device, seed=71)
    place = lost(model, 0, (0.07, 2.0 * radius, 0.0))
    face = 2.0 * np.pi * radius / AROUND
    assert place[0] == pytest.approx(0.07, abs=face)
    assert 0.5 * radius < off_axis(place) < 1.1 * radius
    assert not model.scene.air_speed.numpy()[0].any()
    assert model.scene.repairs.numpy()[0] == 1


@pytest.mark.parametrize("device", DEVICES)
def test_air_that_is_alone_deep_inside_is_not_lost(device, radius):
    model = filled(device, seed=73)
    air = model.scene.air.numpy()
    air[:, 0] *= 0.5
    model.scene.air.assign(air)
    place = lost(model, 0, (0.12, 0.0, 0.0))
    assert off_axis(place) < 0.2 * radius
    assert model.scene.repairs.numpy()[0] == 0


@pytest.mark.parametrize("device", DEVICES)
def test_the_wall_of_another_sculpture_holds_no_lost_air(device, radius):
    model = filled(device, seed=72, copies=2)
    x = model.scene.x.numpy()
    x[model.scene.vertex_start[1] :, 1] += APART
    model.scene.x.assign(x)
    place = lost(model, 0, (0.07, 1.5 * radius + 0.5 * APART, 0.0))
    assert off_axis(place) < 1.1 * radius


@pytest.mark.parametrize("device", DEVICES)
def test_lost_air_comes_back_into_its_own_bubble(device, radius):
    model = filled(device, seed=71)
    joint = borders(model)[0]
    border = place_of(model, joint)
    freeze(model, joint)
    own = int(np.flatnonzero(model.clusters.of_air == model.clusters.of_air.min())[0])
    place = lost(model, own, (border + 0.03, 2.0 * radius, 0.0))
    assert off_axis(place) < 1.1 * radius
    assert place[0] < border


@pytest.mark.parametrize("device", DEVICES)
def test_a_lost_cloud_is_spread_where_it_comes_back(device, radius):
    model = filled(device, seed=74)
    place = lost(model, slice(0, 8), (0.07, 2.0 * radius, 0.0))
    apart = np.linalg.norm(place[:, None] - place[None], axis=2)
    assert apart[np.triu_indices(8, 1)].min() > 1e-4
