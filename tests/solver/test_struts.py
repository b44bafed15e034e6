"""Struts, which keep the pose of welds."""

from __future__ import annotations

from collections import Counter
from itertools import chain
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from balloon_usd.operations.moves import LetGo, Pinch, Weld
from balloon_usd.plan import plan
from balloon_usd.plan.holding import PRESSING
from balloon_usd.plan.nets import nets_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.joint_forces import JointForces
from balloon_usd.solver.latex.struts import CROWD, StrutLaw
from balloon_usd.solver.simulation import simulate_many
from tests.solver.test_motions import Room


@pytest.fixture
def room():
    return Room()


def put(room, pair, far):
    """Ask for a strut between two joints that are so far apart (m), and return what the device has of it."""
    struts, (a, b) = room.sculpture.struts, pair
    room.middle[b] = room.middle[a] + (far, 0.0, 0.0)
    struts.hold({pair})
    struts.put(room.middle)
    at, scene = struts.pairs[pair], room.model.scene
    return float(scene.strut_length.numpy()[at]), float(scene.strut_stiffness.numpy()[at])


def test_a_strut_keeps_its_length_however_often_it_is_asked_for(room):
    pair = room.joint("nose.end"), room.joint("right.end")
    length, stiffness = put(room, pair, 0.1)
    assert length == pytest.approx(0.1)
    assert stiffness > 0.0
    assert put(room, pair, 0.3) == (length, stiffness)


def test_a_loosened_strut_holds_nothing_until_it_is_asked_for_at_a_new_length(room):
    pair, other = (room.joint("nose.end"), room.joint("right.end")), (room.joint("nose.end"), 0)
    struts, scene = room.sculpture.struts, room.model.scene
    before = put(room, other, 0.2)
    _, stiffness = put(room, pair, 0.1)
    struts.loosen(set(pair))
    assert scene.strut_stiffness.numpy()[struts.pairs[pair]] == 0.0
    assert put(room, pair, 0.3) == (pytest.approx(0.3), stiffness)
    assert put(room, other, 0.4) == before
    assert np.count_nonzero(scene.strut_stiffness.numpy()) == 2


def test_struts_that_crowd_at_one_joint_share_what_it_bears(room):
    pair = room.joint("nose.end"), room.joint("right.end")
    alone = put(room, pair, 0.1)[1]
    crowded = Room()
    for _ in range(2 * CROWD):
        crowded.sculpture.struts.expect({pair})
    assert put(crowded, pair, 0.1)[1] == pytest.approx(0.5 * alone)


@pytest.fixture
def welded(room):
    """A room whose figure has one weld; all its necks are closed, and friction keeps its pose."""
    hands, sculpture = room.hands, room.sculpture
    hands.radius_goal[:] = 0.001
    room.middle[:, 0] = 0.1 * np.arange(len(room.middle))
    hands.weld((room.joint("nose.end"), room.joint("right.end")))
    hands.settle()
    sculpture.hold_pose()
    sculpture.struts.put(room.middle)
    return room


def test_the_force_of_a_joint_is_the_largest_of_its_struts_at_all_ends_that_meet_in_it(welded):
    sculpture = welded.sculpture
    forces = JointForces([sculpture], sculpture.struts)
    pulls = np.zeros((len(welded.model.scene.strut_joint), 3), dtype=np.float32)
    pulls[: len(sculpture.struts.pairs)] = [3.0, 0.0, -4.0]
    pulls[0] = [0.0, 6.0, 0.0]
    assert not forces.at_ends(pulls).any()
    forces.follow()
    names = [bubble.name for bubble in sculpture.plan.bubbles]
    found = {
        f"{name}.{end}": float(force)
        for name, ends in zip(names, forces.at_ends(pulls), strict=True)
        for end, force in zip(("start", "end"), ends, strict=True)
        if force
    }
    assert set(found) == {"nose.end", "left.start", "right.end", "red_rest.start"}
    assert set(found.values()) == {6.0}


def test_what_a_pop_gives_up_before_it_was_held_has_no_force(room):
    hands, sculpture = room.hands, room.sculpture
    hands.radius_goal[:] = 0.001
    hands.weld((room.joint("nose.end"), room.joint("right.end")))
    hands.settle()
    sculpture.hold_pose()
    sculpture.friction.popped.update({"left", "right"})
    sculpture.give_up_pose()
    sculpture.hold_pose()
    sculpture.friction.popped.clear()
    sculpture.give_up_pose()
    sculpture.struts.put(room.middle)
    forces = JointForces([sculpture], sculpture.struts)
    forces.follow()
    kept = set().union(*sculpture.pose_kept.values())
    assert set(sculpture.struts.pairs) < kept
    pulls = np.ones((len(room.model.scene.strut_joint), 3), dtype=np.float32)
    assert np.count_nonzero(forces.at_ends(pulls)) == 4 * bool(sculpture.struts.pairs)


@pytest.fixture(scope="module")
def icosahedron():
    """A finished icosahedron of three balloons with a centre, in which nothing is simulated: its struts."""
    path = Path(__file__).parents[2] / "recipes/book/icosahedron_centre.yaml"
    made = plan(Recipe.load(path))
    model = simulate_many([made], device="cpu").model
    sculpture, hands = model.performers[0].sculpture, model.hands
    (net,) = nets_of(made.recipe.piece, made.strips, made.table)
    middle = np.zeros((len(hands.mode), 3), dtype=np.float32)
    for ring, place in net.places.items():
        middle[sculpture.joints[ring]] = place
    for move in made.choreography.moves:
        if isinstance(move, Pinch):
            hands.radius_goal[sculpture.joints[move.ring]] = 0.001
        elif isinstance(move, Weld):
            hands.weld(tuple(sculpture.joints[ring] for ring in move.rings))
        elif isinstance(move, LetGo):
            sculpture.struts.hold(sculpture.friction.pairs(hands))
            sculpture.struts.put(middle)
    return SimpleNamespace(scene=model.scene, pairs=sculpture.struts.pairs, middle=middle.astype(float))


def test_a_net_has_room_for_all_the_struts_that_its_welds_come_to_need(icosahedron):
    ends = Counter(chain.from_iterable(icosahedron.pairs))
    assert max(ends.values()) == icosahedron.scene.joint_struts.shape[1] == 35


def test_the_struts_of_a_crowded_net_are_no_stiffer_than_explicit_steps_bear(icosahedron):
    scene, dt = icosahedron.scene, icosahedron.scene.settings.dt
    mass, stiffness, damping = (
        array.numpy() for array in (scene.joint_mass, scene.strut_stiffness, scene.strut_damping)
    )
    total = np.zeros((3 * len(mass), 3 * len(mass)))
    for (a, b), k in icosahedron.pairs.items():
        far = icosahedron.middle[b] - icosahedron.middle[a]
        along = far / max(float(np.linalg.norm(far)), 1e-9)
        pull = np.zeros((len(mass), 3))
        pull[a], pull[b] = along / np.sqrt(mass[a]), -along / np.sqrt(mass[b])
        total += (stiffness[k] * dt**2 + 2.0 * damping[k] * dt) * np.outer(pull, pull)
    # 4 is the limit of struts alone; walls, welds and hands take their part of it.
    assert np.linalg.eigvalsh(total)[-1] < 3.0


def test_a_strut_yields_the_later_the_rougher_the_rubber():
    assert StrutLaw.of_friction(0.8).yielding == pytest.approx(StrutLaw().yielding)
    assert StrutLaw.of_friction(0.0).yielding == 0.0


SLIPPERY = """
format: 1
name: slippery
units: cm
balloons:
  main: {size: 260, length: 13, tail: 5, color: red}
steps:
  - bubbles: {nose: 4, left: 4, right: 4}
  - lock: [left, right]
  - rest: tail
physics: {friction: 0.2, hold: 0.2}
"""


def test_a_joint_of_slippery_rubber_needs_all_the_force_that_its_friction_bears_and_no_more():
    made = plan(Recipe.parse(SLIPPERY))
    let_go = 1 + round(made.choreography.let_go * made.recipe.fps)
    frames = [frame for (frame,) in simulate_many([made], device="cpu").frames() if frame.time_code >= let_go]
    ends = np.array([frame.joint_force for frame in frames])
    names = [bubble.name for bubble in made.bubbles]
    assert ends[:, names.index("left"), 0].max() == pytest.approx(0.2 * PRESSING, rel=0.02)
    # Two ends of one joint.
    assert (ends[:, names.index("left"), 0] == ends[:, names.index("nose"), 1]).all()
    assert not ends[:, names.index("left"), 1].any()
