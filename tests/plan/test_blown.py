"""The shape of a blown-up balloon before anything is twisted."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.blown import NECK_AT_KNOT, blown_shape
from balloon_usd.plan.necks import wall_length

DOG = (260, "tail: 10", (10, 10, 10, 7, 12, 12, 15, 12, 12))
CAPSULE = (260, "capsule: 28", (5, 3))
BALLOONS = {
    "a dog": DOG,
    "a full 260": (260, "tail: 0", (20,)),
    "one whose tail runs out": (260, "tail: 0.5", (10, 10, 10, 10)),
    "a short puff": (646, "inflated: 4", ()),
    "a 160": (160, "inflated: 40", (5,)),
    "a 646": (646, "inflated: 60", (20,)),
    "a capsule": CAPSULE,
}
"""Size, filling, and lengths of the bubbles in cm."""


def strip_of(planned, size: int, filling: str, lengths: tuple[int, ...]):
    bubbles = ", ".join(f"b{k}: {length}" for k, length in enumerate(lengths))
    step = f"{{bubbles: {{{bubbles}}}}}" if lengths else "{wait: 1}"
    body = f"balloons: {{main: {{size: {size}, {filling}}}}}\nsteps: [{step}]\nphysics: {{model: kosaka}}\n"
    return planned(body).strips["main"]


@pytest.fixture(params=BALLOONS.values(), ids=BALLOONS)
def strip(request, planned):
    return strip_of(planned, *request.param)


@pytest.fixture
def tube(planned):
    return strip_of(planned, *DOG)


def test_rubber_lies_in_its_order_along_the_balloon(strip):
    shape = blown_shape(strip)
    assert shape.flat[0] == shape.place[0] == 0.0
    assert np.all(np.diff(shape.flat) > 0.0)
    assert np.all(np.diff(shape.place) > 0.0)


def test_places_do_not_turn_back_from_the_knot_to_the_tip(strip):
    places = blown_shape(strip).place_of(np.linspace(0.0, strip.bubbles[-1].rest_end, 500))
    assert np.all(np.diff(places) > 0.0)


def test_radii_are_those_of_rubber_blown_up_or_flat(strip):
    shape = blown_shape(strip)
    radii = shape.radius_at(np.linspace(0.0, shape.place[-1], 500))
    assert shape.wide == pytest.approx(strip.inflated_radius)
    assert radii.max() <= shape.wide
    assert radii.min() >= min(shape.neck, shape.thin)


def test_joints_lie_as_far_along_as_their_bubbles_and_necks_take_wall(tube):
    shape, joints = blown_shape(tube), tube.bubbles[:-1]
    walls = [wall_length(bubble.length, shape.wide, 2) for bubble in joints]
    assert shape.place_of(np.array([b.rest_end for b in joints])) == pytest.approx(np.cumsum(walls))


def test_the_tube_is_narrow_at_its_knot_wide_along_it_and_thin_in_its_tail(tube):
    shape = blown_shape(tube)
    knot, beyond_dome, before_front, front, tip = shape.radius_at(
        np.array([0.0, shape.wide, shape.end - shape.wide, shape.end, shape.place[-1]])
    )
    assert knot == pytest.approx(NECK_AT_KNOT * tube.size.radius)
    assert beyond_dome == before_front == pytest.approx(tube.inflated_radius)
    assert front == tip == pytest.approx(tube.size.radius * maxwell_state(tube.rubber).thin.a)


def test_the_tail_is_what_the_twists_leave_of_it(tube):
    shape, last = blown_shape(tube), tube.bubbles[-1]
    front, tip = shape.place[-2:]
    state = maxwell_state(tube.rubber)
    left = tube.size.length - last.rest_start - last.length / state.bulged.b
    assert shape.end == front
    assert tube.size.length - shape.flat[-2] == pytest.approx(left)
    assert tip - front == pytest.approx(left * state.thin.b)


def test_every_bubble_lies_on_the_wall_that_it_takes(tube):
    shape = blown_shape(tube)
    taken = [wall_length(bubble.length, shape.wide, 2) for bubble in tube.bubbles[:-1]]
    taken.append(wall_length(tube.bubbles[-1].length, shape.wide, 1))
    assert np.diff(shape.place)[:-1] == pytest.approx(taken)


def test_the_ends_of_a_tube_are_half_spheres(tube):
    shape = blown_shape(tube)
    away = np.linspace(0.2, 1.0, 9) * shape.wide
    assert shape.radius_at(away) == pytest.approx(np.sqrt(shape.wide**2 - (shape.wide - away) ** 2))


def test_a_capsule_lies_as_it_is_with_closed_ends(planned):
    strip = strip_of(planned, *CAPSULE)
    shape = blown_shape(strip)
    along = np.linspace(0.0, 0.28, 29)
    assert shape.place_of(along) == pytest.approx(along)
    assert shape.end == pytest.approx(0.28)
    assert shape.radius_at(np.array([0.0, 0.14, 0.28])) == pytest.approx([0.0, strip.inflated_radius, 0.0])
