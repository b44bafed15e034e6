"""Balloons in balloons: gas round a wall, walls that touch from inside, and all that in batches."""

from __future__ import annotations

from itertools import islice

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.ball_pressure import ball_pressure
from balloon_usd.balloon.closed_shape import ClosedShape
from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.operations.insert import Insert
from balloon_usd.operations.moves import Sink
from balloon_usd.plan import plan
from balloon_usd.plan.laying_shapes import WALL
from balloon_usd.plan.meshing import made_meshes
from balloon_usd.plan.nesting_fit import MOST_GUESTS
from balloon_usd.recipe import Recipe
from balloon_usd.recipe.recipe import EARTH
from balloon_usd.solver.kernels.arrays.rows import SPINS
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.watched import crossings, watched
from tests.mesh_file.shapes import ball, write_obj

BALLS = """
format: 1
name: balls
units: cm
balloons:
  outer: {mesh: outer.obj, unit: m, swell: 2}
  inner: {mesh: inner.obj, unit: m, swell: 1.5}
steps:
  - insert: {inner: outer}
  - inflate: ORDER
    seconds: 1.5
"""
SQUEEZED = (
    Insert.example.replace("size: 260", "size: 350").replace("length: 9", "length: 10")
    + "  - squeeze: {bubble: cocoon, by: 60 %}\nphysics: {hold: 0.5}\n"
)
POD = """
format: 1
name: pod
units: cm
balloons:
  pod: {size: 350, length: 16, tail: 7}
  one: {size: 160, length: 1.9, tail: 0.7}
  two: {size: 160, length: 1.9, tail: 0.7}
  three: {size: 160, length: 1.9, tail: 0.7}
steps:
  - insert: {one: a, two: b, three: c}
  - inflate: pod
  - inflate: [one, two, three]
  - bubbles: {a: 9, b: 9, c: 9}
    balloon: pod
  - lock: {joints: [a.start, c.end]}
pose: stand
physics: {hold: 0.5}
"""


def two_balls(folder, order, end="physics: {hold: 0.5, softening: false}"):
    for name, radius in (("outer", 0.08), ("inner", 0.04)):
        shape = ball(radius, 6)
        write_obj(folder / f"{name}.obj", shape.points, shape.quads.tolist())
    return plan(Recipe.parse(BALLS.replace("ORDER", order) + end, file=str(folder / "balls.yaml")))


def frames_of(planned):
    return [frame for (frame,) in simulate_many([planned], detail="draft", device="cpu").frames()]


def box_middle(points):
    """Middle of the box of some points, (3,), m."""
    return 0.5 * (points.min(axis=0) + points.max(axis=0))


def outside(planned, frame, guest, host):
    """How many points of one balloon are outside another."""
    quads = made_meshes(planned, detail_named("draft"))[host].quads
    wall = ClosedShape(frame.points[host].astype(np.float64), quads)
    return int((~wall.encloses(frame.points[guest].astype(np.float64))).sum())


def theory(planned):
    """Volumes of gas of both balls, m3, by the law of their rubber and that of gas, from what is blown in."""
    law = rubber_named().without_softening()
    shapes = [strip.shape for strip in planned.strips.values()]
    amounts = [(ATMOSPHERE + shape.pressure) * shape.volume for shape in shapes]
    amounts[0] = (ATMOSPHERE + shapes[0].pressure) * (shapes[0].volume - shapes[1].volume)
    rest = [shape.surface.ball_volume for shape in shapes]

    def pressure(k, volume):
        return ball_pressure(law, (volume / rest[k]) ** (1 / 3), WALL / shapes[k].surface.ball_radius)

    outer, inner = shapes[0].volume, shapes[1].volume
    for _ in range(200):
        about = pressure(0, outer)
        inner = 0.5 * (inner + amounts[1] / (ATMOSPHERE + about + pressure(1, inner)))
        outer = 0.5 * (outer + inner + amounts[0] / (ATMOSPHERE + about))
    return [outer - inner, inner], [pressure(0, outer), pressure(1, inner)]


@pytest.mark.parametrize("order", ["[inner, outer]", "[outer, inner]"], ids=["at once", "the other first"])
def test_two_balls_have_the_gas_and_the_pressures_of_theory(tmp_path, order):
    planned = two_balls(tmp_path, order)
    last = frames_of(planned)[-1]
    volumes, pressures = theory(planned)
    assert last.volume == pytest.approx(volumes, rel=5e-3)
    assert last.pressure == pytest.approx(pressures, rel=5e-3)
    # Less than planned: the gas about it presses the inner one together.
    assert last.volume[1] < 0.995 * planned.strips["inner"].shape.volume
    assert outside(planned, last, 1, 0) == 0


def test_the_gas_between_two_walls_does_not_swing_up():
    frames = frames_of(plan(Recipe.parse(Insert.example)))
    pressure = np.array([frame.pressure for frame in frames])
    assert np.abs(np.diff(pressure[-48:], axis=0)).max() < 5.0
    # From the first frame on: what lies in a flat balloon leaves it less air.
    assert np.abs(pressure[:12, 1]).max() < 3e3


def gas_in_the_hold(text):
    """Pressure times volume of the gas of every bubble at the beginning and the end of the hold, (2, bubbles), J."""
    planned = plan(Recipe.parse(text + "physics: {hold: 1, leak: 12 h}\n"))
    frames = frames_of(planned)
    ends = frames[-24], frames[-1]
    pressure = np.array([frame.pressure for frame in ends])
    if len(planned.strips) > 1:
        pressure[:, 1] += pressure[:, 0]
    return (ATMOSPHERE + pressure) * np.array([frame.volume for frame in ends])


def test_what_leaks_from_a_balloon_in_another_comes_into_that():
    lines = [line for line in Insert.example.splitlines(keepends=True) if "bug" not in line]
    nested, alone = gas_in_the_hold(Insert.example), gas_in_the_hold("".join(lines))
    lost, inner = nested[0] - nested[1]
    assert inner > 0.1 * nested[0, 1]
    assert lost == pytest.approx((alone[0] - alone[1])[0] - inner, rel=0.15)


def test_what_two_hands_squeeze_through_a_wall_slips_aside_and_stays_inside():
    planned = plan(Recipe.parse(SQUEEZED))
    squeezed = next(move for move in planned.choreography.moves if move.text.startswith("squeeze"))
    frames = frames_of(planned)[round(squeezed.start * planned.recipe.fps) :]
    contact, pressure = (
        np.array([getattr(frame, name)[1] for frame in frames]) for name in ("contact", "pressure")
    )
    assert contact.max() > 0.4
    assert pressure.max() > 1.02 * pressure[0]
    middles = np.array([frame.points[1].mean(axis=0) for frame in frames])
    assert np.linalg.norm(middles[-1] - middles[0]) > 0.01
    assert not any(outside(planned, frame, 1, 0) for frame in frames[::4])


@pytest.mark.parametrize(
    "pose",
    ["pose: stand", "pose: stand\ntop: down", "front: down\nphysics: {gravity: 9.81, hold: 0.5}"],
    ids=["stands", "upside down", "as made, under gravity"],
)
def test_what_lies_in_a_ball_sinks_and_lies_on_its_wall_with_its_own_weight(tmp_path, pose):
    planned = two_balls(tmp_path, "[inner, outer]", pose)
    frames = frames_of(planned)
    sinking = [frame for frame in frames if frame.doing == "what lies inside sinks"]
    # Hands hold the outer one meanwhile.
    ways = [box_middle(frame.points[0]) - box_middle(sinking[0].points[0]) for frame in sinking]
    assert np.linalg.norm(ways, axis=1).max() < 0.015
    last = next(
        frame for frame in frames if frame.doing == "hold" and frame.time_code > sinking[-1].time_code + 6
    )
    law = rubber_named()
    surface = planned.strips["inner"].shape.surface
    weight = 4.0 * np.pi * surface.ball_radius**2 * WALL * law.density * EARTH
    assert last.contact == pytest.approx([weight, weight], rel=0.03)
    posed = frames[-1].points
    low = [points[:, 2].min() for points in posed]
    assert low[0] < low[1] < low[0] + 0.01
    assert outside(planned, frames[-1], 1, 0) == 0


def test_what_lies_in_a_ball_that_floats_where_it_was_made_floats_too(tmp_path):
    planned = two_balls(tmp_path, "[inner, outer]")
    assert not any(isinstance(move, Sink) for move in planned.choreography.moves)


def test_hands_bring_as_many_balloons_at_a_time_as_a_plan_puts_into_one():
    assert MOST_GUESTS <= SPINS


def test_what_lies_in_bubbles_stays_in_them_when_they_are_locked():
    quality = watched(Recipe.parse(POD))
    assert not crossings(quality)


def test_a_sculpture_of_a_batch_is_the_same_as_alone():
    planned = plan(Recipe.parse(Insert.example.replace("name: cocoon", "name: one")))
    other = plan(
        Recipe.parse(
            "format: 1\nname: other\nballoons: {main: {size: 260, length: 0.1 m, tail: 0.04 m}}\nsteps: [wait: 2]\n"
        )
    )
    alone, beside = (
        next(islice(simulate_many(plans, detail="draft", device="cpu").frames(), 40, None))[-1]
        for plans in ([planned], [other, planned])
    )
    assert all(np.array_equal(a, b) for a, b in zip(beside.points, alone.points, strict=True))


RATTLE = """
format: 1
name: rattle
units: cm
balloons:
  shell: {size: 350, inflated: 24}
  bead: {size: 160, inflated: 5, length: 2}
steps:
  - insert: {bead: shell_rest}
  - inflate: shell
  - inflate: bead
pose: hang
physics: {hold: 0.5}
"""


def test_what_lies_in_a_tube_that_hangs_by_its_knot_lies_at_its_lower_end():
    planned = plan(Recipe.parse(RATTLE))
    frames = frames_of(planned)
    shell, bead = frames[-1].points
    # The thread is tied to the knot of the outer one, at the origin.
    assert np.abs(shell[:, :2].mean(axis=0)).max() < 0.01
    wide = shell[np.linalg.norm(shell[:, :2], axis=1) > 0.02]
    # Its flat tip lies where the shell narrows towards its own.
    assert bead[:, 2].min() < wide[:, 2].min() + 0.01
    assert outside(planned, frames[-1], 1, 0) == 0
