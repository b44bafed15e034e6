"""Nets come out as their solids."""

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
@pytest.mark.parametrize(
    ("name", "edge", "edges", "across"),
    [("tetrahedron_2", 0.3, 6, 0.0), ("octahedron", 0.1, 12, 0.1 * 2**0.5)],
)
def test_the_joints_of_a_finished_net_lie_as_the_corners_of_its_solid(name, edge, edges, across):
    planned = plan(Recipe.load(BOOK / f"{name}.yaml"))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    *_, last = simulation.frames()
    at = middles(simulation, last[0])
    corners = [
        at[[planned.table.joint(end) for end in joint.ends]].mean(axis=0)
        for joint in planned.graph.joints
        if joint.merged
    ]
    far = sorted(float(np.linalg.norm(one - other)) for one, other in combinations(corners, 2))
    assert far[:edges] == pytest.approx([edge] * edges, rel=0.12)
    assert far[edges:] == pytest.approx([across] * (len(far) - edges), rel=0.12)
