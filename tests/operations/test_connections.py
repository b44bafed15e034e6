"""What hangs together: the same as a graph library finds in random graphs."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest

from balloon_usd.language.joint import Joint
from balloon_usd.operations.connections import Connections


def random_graph(seed):
    """Bubbles between a few joints at random, some of them loops or side by side: their ends by their names."""
    rng = np.random.default_rng(seed)
    joints = [Joint(f"b{k}", "start") for k in range(int(rng.integers(2, 9)))]
    ends = rng.integers(len(joints), size=(int(rng.integers(1, 14)), 2))
    return {f"b{k}": (joints[one], joints[other]) for k, (one, other) in enumerate(ends)}


@pytest.mark.parametrize("seed", range(40))
def test_blocks_are_those_of_a_graph_library(seed):
    ends = random_graph(seed)
    graph = nx.Graph([pair for pair in ends.values() if pair[0] != pair[1]])
    theirs = [
        frozenset(b for b, pair in ends.items() if pair[0] != pair[1] and {*pair} <= joints)
        for joints in nx.biconnected_components(graph)
    ]
    loops = [frozenset([bubble]) for bubble, (start, end) in ends.items() if start == end]
    ours = Connections(ends).blocks()
    assert {*ours} == {*theirs, *loops}
    names = list(ends)
    assert ours == sorted(ours, key=lambda block: min(map(names.index, block)))
