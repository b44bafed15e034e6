"""The sculpture graph: joints, rings, odd joints, and joints that spring back."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Joint


def test_the_dog_has_eight_joints_and_three_rings(dog):
    graph = dog.graph
    assert (len(graph.joints), len(graph.edges), graph.rings) == (8, 10, 3)
    assert sorted(graph.degree(joint.index) for joint in graph.joints) == [1, 1, 2, 2, 2, 4, 4, 4]
    assert len(graph.odd_joints) == 2
    assert graph.one_stroke


def test_a_lock_makes_one_joint_of_the_outer_ends(dog):
    joint = dog.graph.joint_of(Joint("left_ear", "start"))
    assert joint == dog.graph.joint_of(Joint("right_ear", "end"))
    assert joint.merged
    assert str(joint) == "nose.end = left_ear.start = right_ear.end = neck.start"
    assert not dog.graph.joint_of(Joint("left_ear", "end")).merged


def test_an_unknown_bubble_has_no_joint(dog):
    with pytest.raises(KeyError, match="beak"):
        dog.graph.joint_of(Joint("beak", "start"))


def test_rings_and_chains_have_different_bridges(dog):
    assert dog.graph.bridges == {"nose", "neck", "body", "tail"}


def test_twists_within_a_ring_hold_and_twists_of_a_chain_spring_back(planned):
    graph = planned("""
        balloons: {a: {size: 260, tail: 10}}
        steps:
          - bubbles: {b: 5, c: 5, d: 5, e: 5, f: 5}
          - lock: [d, e]
          - ear: {g: 3}
        """).graph
    loose = {str(joint) for joint in graph.joints if graph.springs_back(joint.index)}
    assert loose == {"b.end = c.start"}
    assert not graph.joint_of(Joint("d", "end")).merged


@pytest.mark.parametrize("kind", ["loop", "fold", "ear"])
def test_loops_folds_and_ears_close_on_themselves(planned, kind):
    graph = planned(f"balloons: {{a: {{size: 260, tail: 10}}}}\nsteps: [{{{kind}: {{b: 10, c: 10}}}}]").graph
    assert (len(graph.joints), len(graph.edges), graph.rings) == (2, 3, 2)
    assert graph.bridges == {"a_rest"}
    assert graph.joints[0].merged
    assert graph.degree(0) == 5


def test_an_octahedron_is_one_stroke(planned):
    trail = [1, 2, 3, 4, 5, 2, 6, 4, 1, 5, 6, 3, 1]
    first: dict[int, str] = {}
    locks = []
    for at, vertex in enumerate(trail):
        joint = "e0.start" if at == 0 else f"e{at - 1}.end"
        if vertex in first:
            locks.append(f"  - lock: {{joints: [{first[vertex]}, {joint}]}}")
        first.setdefault(vertex, joint)
    edges = ", ".join(f"e{at}: 5" for at in range(12))
    graph = planned(
        f"balloons: {{a: {{size: 260, tail: 12}}}}\nsteps:\n  - bubbles: {{{edges}}}\n" + "\n".join(locks)
    ).graph
    # The unnamed rest hangs on as a thirteenth bubble with an end of its own.
    assert (len(graph.joints), len(graph.edges), graph.rings) == (7, 13, 7)
    assert sorted(graph.degree(joint.index) for joint in graph.joints) == [1, 4, 4, 4, 4, 4, 5]
    assert graph.one_stroke


def test_balloons_joined_by_a_lock_are_one_piece(planned):
    body = """
        balloons: {{a: {{size: 260, tail: 10}}, b: {{size: 260, tail: 10}}}}
        steps:
          - {{bubbles: {{c: 5}}, balloon: a}}
          - {{bubbles: {{d: 5}}, balloon: b}}
          {}
        """
    apart = planned(body.format("")).graph
    joined = planned(body.format("- lock: {joints: [c.end, d.end]}")).graph
    assert (len(apart.pieces), len(joined.pieces)) == (2, 1)
    assert len(apart.joints) - len(joined.joints) == 1
    assert joined.fewest_balloons == 2
    assert {edge.balloon for edge in joined.edges} == {"a", "b"}


def test_every_edge_runs_between_the_joints_of_its_bubble(dog):
    for edge in dog.graph.edges:
        assert dog.graph.joint_of(Joint(edge.bubble, "start")).index == edge.start
        assert dog.graph.joint_of(Joint(edge.bubble, "end")).index == edge.end


def test_the_multigraph_says_the_same(dog):
    graph = dog.graph
    assert graph.multigraph.number_of_edges() == len(graph.edges)
    assert [degree for _, degree in graph.multigraph.degree] == [
        graph.degree(joint.index) for joint in graph.joints
    ]
