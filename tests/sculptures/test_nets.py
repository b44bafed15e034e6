"""Nets come out as their solids."""

from __future__ import annotations

from itertools import combinations, islice
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from balloon_usd.operations.moves import Bring
from balloon_usd.plan import plan
from balloon_usd.plan.nets import embed
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.sculptures.conftest import middles

BOOK = Path(__file__).parents[2] / "recipes" / "book"
FAR = """
format: 1
name: far
units: cm
tempo: brisk
balloons:
  red: {size: 260, length: 24, tail: 7}
  blue: {size: 260, length: 24, tail: 7}
steps:
  - {bubbles: {a: 16, b: 16, c: 16}, balloon: red}
  - {bubbles: {d: 9}, balloon: blue}
  - lock: {joints: [c.end, d.start]}
  - {bubbles: {e: 16}, balloon: blue}
  - lock: {joints: [a.start, e.end]}
  - {bubbles: {f: 12}, balloon: blue}
  - lock: {joints: [b.end, f.end]}
"""
"""A net to whose far side the second balloon is brought by its knot."""


CROWD = Path(__file__).parents[1] / "crowd" / "recipes"
SOLIDS = [
    (BOOK / "tetrahedron_2.yaml", nx.tetrahedral_graph, 0.3, 0.12),
    (BOOK / "tetrahedron_pop.yaml", nx.tetrahedral_graph, 0.16, 0.12),
    (BOOK / "octahedron.yaml", nx.octahedral_graph, 0.1, 0.12),
    (BOOK / "cube_4.yaml", nx.cubical_graph, 0.3, 0.15),
    (CROWD / "icosahedron_6.yaml", nx.icosahedral_graph, 0.15, 0.15),
]


def distances(corners):
    """All distances between corners, (N, 3), m, the shortest first."""
    return np.sort([np.linalg.norm(one - other) for one, other in combinations(corners, 2)])


@pytest.mark.long
@pytest.mark.parametrize(
    ("path", "graph", "edge", "off"), SOLIDS, ids=lambda value: getattr(value, "stem", "")
)
def test_the_joints_of_a_finished_net_lie_as_the_corners_of_its_solid(path, graph, edge, off):
    planned = plan(Recipe.load(path))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    *_, last = simulation.frames()
    at = middles(simulation, last[0])
    corners = [
        at[[planned.table.joint(end) for end in joint.ends]].mean(axis=0)
        for joint in planned.graph.joints
        if joint.merged
    ]
    sides = np.array(sorted(graph().edges))
    solid = embed(sides, np.full(len(sides), edge))
    assert distances(corners) == pytest.approx(distances(solid), rel=off)


def test_what_is_left_of_a_balloon_stays_straight_while_its_knot_is_brought_to_a_net():
    planned = plan(Recipe.parse(FAR))
    simulation = simulate_many([planned], device="cpu")
    bring = next(move for move in planned.choreography.moves if isinstance(move, Bring))
    *_, (last,) = islice(simulation.frames(), int(bring.end * simulation.fps) + 1)
    names = [ring.name for ring in planned.table.rings]
    rest = middles(simulation, last)[names.index("d.end") :]
    along = np.linalg.norm(np.diff(rest, axis=0), axis=1).sum()
    # Left behind, it is bent to three quarters of this, and the next twist swings it round.
    assert np.linalg.norm(rest[-1] - rest[0]) > 0.97 * along
