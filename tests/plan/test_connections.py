"""What hangs together, against networkx."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.plan.connections import Connections

GRAPHS = st.integers(1, 12).flatmap(
    lambda joints: st.tuples(
        st.just(joints), st.lists(st.tuples(*2 * [st.integers(0, joints - 1)]), max_size=20)
    )
)
"""Numbers of joints and edges, loops and several between two joints included."""


def multigraph(joints, edges):
    graph = nx.MultiGraph()
    graph.add_nodes_from(range(joints))
    graph.add_edges_from(edges)
    return graph


@given(GRAPHS)
def test_pieces_are_those_of_networkx(drawn):
    joints, edges = drawn
    expected = [frozenset(piece) for piece in nx.connected_components(multigraph(joints, edges))]
    assert list(Connections(joints, edges).pieces) == expected


@given(GRAPHS)
def test_an_edge_is_a_bridge_if_there_are_more_pieces_without_it(drawn):
    joints, edges = drawn
    pieces = nx.number_connected_components(multigraph(joints, edges))
    without = [multigraph(joints, edges[:k] + edges[k + 1 :]) for k in range(len(edges))]
    expected = {k for k, graph in enumerate(without) if nx.number_connected_components(graph) > pieces}
    assert Connections(joints, edges).bridges == expected


def test_a_long_chain_is_all_bridges():
    chain = [(k, k + 1) for k in range(5000)]
    assert Connections(5001, chain).bridges == frozenset(range(5000))
