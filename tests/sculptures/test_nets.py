"""Nets of several balloons open into their solids."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.sculptures.conftest import middles

BOOK = Path(__file__).parents[2] / "recipes" / "book"


@pytest.mark.long
def test_a_tetrahedron_of_two_balloons_has_six_edges_of_about_one_length():
    planned = plan(Recipe.load(BOOK / "tetrahedron_2.yaml"))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    *_, last = simulation.frames()
    at = middles(simulation, last[0])
    rings = {joint: planned.table.joint(joint.ends[0]) for joint in planned.graph.joints if joint.merged}
    corners = np.array([at[ring] for ring in rings.values()])
    edges = [float(np.linalg.norm(one - other)) for one, other in combinations(corners, 2)]
    assert len(edges) == 6
    assert max(edges) < 1.25 * min(edges)
