"""Nets: which sculptures have one, what shape it has in space, and when hands set it."""

from __future__ import annotations

from itertools import combinations, pairwise
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from balloon_usd.operations.moves import Bring, Gather, LetGo, Loosen, Move, SetNet, Weld
from balloon_usd.plan import plan
from balloon_usd.plan.nets import embed, nets_of
from balloon_usd.plan.setting_nets import SETTING_SPEED
from balloon_usd.recipe import Recipe

RECIPES = Path(__file__).parents[2] / "recipes"
SOLIDS = {
    "tetrahedron": (nx.tetrahedral_graph, np.sqrt(3.0 / 8.0)),
    "cube": (nx.cubical_graph, np.sqrt(3.0) / 2.0),
    "octahedron": (nx.octahedral_graph, np.sqrt(0.5)),
    "dodecahedron": (nx.dodecahedral_graph, np.sqrt(3.0) * (1.0 + np.sqrt(5.0)) / 4.0),
    "icosahedron": (nx.icosahedral_graph, np.sqrt(10.0 + 2.0 * np.sqrt(5.0)) / 4.0),
}
"""Graphs of the regular solids, and the radii of the spheres about them at edges of 1."""

RING = """
format: 1
name: ring
units: cm
balloons:
  red: {size: 260, length: 34, tail: 10}
  blue: {size: 260, length: 34, tail: 10}
steps:
  - {bubbles: {a: 8, b: 8, c: 8}, balloon: red}
  - {bubbles: {d: 8}, balloon: blue}
  - lock: {joints: [a.start, d.start]}
  - {bubbles: {e: 8, f: 8}, balloon: blue}
  - lock: {joints: [c.end, f.end]}
"""


def planned(path):
    return plan(Recipe.load(RECIPES / path))


def nets(path):
    made = planned(path)
    return nets_of(made.recipe.piece, made.strips, made.table)


@pytest.mark.parametrize("solid", SOLIDS)
def test_the_edges_of_a_regular_solid_open_into_that_solid(solid):
    graph, radius = SOLIDS[solid]
    sides = np.array(sorted(graph().edges))
    places = embed(sides, np.full(len(sides), 0.1))
    edges = np.linalg.norm(places[sides[:, 0]] - places[sides[:, 1]], axis=1)
    assert edges == pytest.approx(0.1, rel=1e-3)
    assert np.linalg.norm(places - places.mean(axis=0), axis=1) == pytest.approx(0.1 * radius, rel=1e-3)


def test_bubbles_of_unequal_lengths_keep_them_where_they_can():
    sides = np.array([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)])
    lengths = np.array([0.30, 0.20, 0.25, 0.22, 0.24, 0.26])
    places = embed(sides, lengths)
    edges = np.linalg.norm(places[sides[:, 0]] - places[sides[:, 1]], axis=1)
    assert edges == pytest.approx(lengths, rel=0.01)


def test_locked_pairs_loops_and_lone_rings_are_no_nets():
    assert not any(nets(f"{name}.yaml") for name in ("dog", "poodle", "flower", "book/dog_it"))


def test_a_ring_of_several_balloons_is_a_net_that_hands_set_as_a_circle():
    made = plan(Recipe.parse(RING))
    (net,) = nets_of(made.recipe.piece, made.strips, made.table)
    places = np.unique(np.array(list(net.places.values())), axis=0)
    assert np.linalg.norm(places, axis=1) == pytest.approx(0.08 / (2.0 * np.sin(np.pi / 6.0)), rel=0.02)
    closing = next(move for move in made.choreography.moves if isinstance(move, SetNet))
    names = [made.table.rings[ring].name for ring in (closing.moving, closing.rings[-1])]
    assert sorted(names) == ["c.end", "f.end"]


def test_a_pair_and_a_loop_that_hang_on_a_net_are_closed_as_those_on_nothing():
    made = plan(Recipe.load(Path(__file__).parents[1] / "crowd" / "recipes" / "teddy_bt.yaml"))
    closing = {
        move.text: type(move) for move in made.choreography.moves if isinstance(move, (Gather, SetNet))
    }
    assert closing["lock twist: left_side, right_side"] is Gather
    assert closing["loop twist: muzzle"] is Gather
    assert closing["lock twist: left_foot, left_side"] is SetNet


def test_every_ring_of_a_joint_lies_at_one_place_of_its_net():
    (net,) = nets("book/octahedron.yaml")
    corners = set(net.places.values())
    assert len(net.places) == 13
    assert len(corners) == 6
    far = sorted(float(np.linalg.norm(np.subtract(a, b))) for a, b in combinations(corners, 2))
    assert far == pytest.approx([0.1] * 12 + [0.1 * np.sqrt(2.0)] * 3, rel=0.01)


def test_hands_set_a_net_instead_of_gathering_joints_that_are_one():
    made = planned("book/octahedron.yaml").choreography.moves
    first, *others = [move for move in made if isinstance(move, (Gather, SetNet)) and move.step < 14]
    assert isinstance(first, Gather)
    assert others
    assert all(isinstance(move, SetNet) for move in others)
    welds = {move.step: move for move in made if isinstance(move, Weld)}
    for move in others:
        assert {move.moving, move.rings[-1]} == set(welds[move.step].rings)


def test_what_is_left_of_a_balloon_begins_at_the_ring_that_stays():
    made = planned("book/tetrahedron_centre.yaml")
    last = [move for move in made.choreography.moves if isinstance(move, SetNet)][-2]
    names = [ring.name for ring in made.table.rings]
    # The knot is brought to the centre, where the tip is tied already.
    assert names[last.moving] == "main.knot"
    assert names[last.rings[-1]] == "spoke_3_0.end"
    assert last.onward is not None


def test_two_balloons_meet_before_their_net_is_set():
    made = planned("book/tetrahedron_2.yaml").choreography.moves
    first, *others = [move for move in made if isinstance(move, (Bring, SetNet))]
    assert isinstance(first, Bring)
    assert len(others) == 4
    assert all(isinstance(move, SetNet) for move in others)


def test_a_net_is_set_once_more_before_the_hands_let_go_for_good():
    made = planned("book/octahedron.yaml").choreography.moves
    setting, settling, loosening, let_go = made[-5:-1]
    assert isinstance(setting, SetNet)
    assert setting.moving is None
    assert isinstance(let_go, LetGo)
    assert let_go.for_good
    assert isinstance(loosening, Loosen)
    assert loosening.start == pytest.approx(settling.end)
    assert let_go.start == pytest.approx(loosening.end)


def test_what_is_brought_to_a_net_is_carried_as_a_whole():
    made = planned("book/dodecahedron_3.yaml").choreography.moves
    assert [move.carried for move in made if isinstance(move, Bring)] == [True, True]
    alone = planned("book/scissors_bt.yaml").choreography.moves
    assert [move.carried for move in alone if isinstance(move, Bring)] == [False]


def test_a_split_ear_is_brought_to_a_net_by_the_joint_between_its_halves():
    split = "  - split: {g: 4, h: 4}\n    balloon: red\n  - lock: {joints: [e.end, g.end]}\n"
    made = plan(Recipe.parse(RING + split))
    locked = [move for move in made.choreography.moves if move.step == len(made.recipe.steps) - 1]
    assert [type(move) for move in locked] == [SetNet, Weld, Move, LetGo]


def test_a_wide_net_is_set_in_more_time_and_what_follows_waits():
    made = planned("book/dodecahedron_10.yaml").choreography
    settings = [move for move in made.moves if isinstance(move, SetNet)]
    for move in settings:
        reach = max(np.linalg.norm(np.subtract(place, move.places[-1])) for place in move.places)
        assert move.seconds == pytest.approx(reach / SETTING_SPEED)
    assert len(settings) > 10
    for move, following in pairwise(made.moves[10:]):
        assert following.start == pytest.approx(move.end)
    assert made.seconds == pytest.approx(made.moves[-1].end)


def test_a_net_is_set_in_the_time_that_the_recipe_gives():
    text = (RECIPES / "book/dodecahedron_10.yaml").read_text()
    lock = "  - lock: {joints: [edge_6_10.end, edge_8_10.end]}\n"
    timed = plan(Recipe.parse(text.replace(lock, lock + "    seconds: 3\n")))
    first = next(move for move in timed.choreography.moves if isinstance(move, SetNet))
    step = [move for move in timed.choreography.moves if move.step == first.step]
    assert step[-1].end - step[0].start == pytest.approx(3.0)
