"""The workpiece: made step by step, and asked at any of them."""

from __future__ import annotations

import pickle

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.language.joint import Joint
from balloon_usd.operations.workpiece import Workpiece
from balloon_usd.recipe import Recipe

DOG_HEAD = """\
format: 1
name: head
units: cm
balloons: {main: {size: 260, color: red, tail: 10}}
steps:
  - bubbles: {nose: 8, left_ear: 6, right_ear: 6}
  - lock: [left_ear, right_ear]
  - rest: neck
"""


def start(bubble: str) -> Joint:
    return Joint(bubble, "start")


def end(bubble: str) -> Joint:
    return Joint(bubble, "end")


def chain(*bubbles: str, balloon: str = "main") -> Workpiece:
    piece = Workpiece([balloon])
    for step, bubble in enumerate(bubbles):
        piece.make(step, bubble, balloon)
    return piece


@pytest.fixture
def head() -> Workpiece:
    return Recipe.parse(DOG_HEAD).piece


def test_the_end_of_one_bubble_is_the_start_of_the_next(head):
    assert head.joint(end("left_ear")) == (end("left_ear"), start("right_ear"))
    assert head.trails == (("nose", "left_ear", "right_ear", "neck"),)


def test_a_ring_is_closed_from_the_step_on_that_closes_it(head):
    ears = ["left_ear", "right_ear"]
    assert not head.after(0).is_closed(ears)
    assert head.after(1).is_closed(ears)
    assert not head.after(1).is_closed(["nose", *ears])
    assert not head.after(1).is_closed([])


def test_a_joint_is_free_to_spin_until_a_ring_closes_over_it(head):
    assert head.after(0).free_to_spin(end("left_ear"))
    assert not head.after(1).free_to_spin(end("left_ear"))
    assert not head.after(1).free_to_spin(end("nose"))


def test_what_is_left_of_a_balloon_is_its_last_bubble_at_every_step(head):
    assert head.after(0).row("main") == ["nose", "left_ear", "right_ear", "neck"]
    assert head.bubbles["neck"].step == 2
    assert head.open_ends == {"main": None}
    assert chain("a", "b").open_ends == {"main": end("b")}


def test_what_hangs_on_an_end_comes_along_when_it_is_moved(head):
    assert head.hangs_on(end("nose")) == {"left_ear", "right_ear", "neck"}
    assert head.hangs_on(start("nose")) == set()
    assert head.after(0).hangs_on(start("right_ear")) == {"nose", "left_ear"}
    assert head.after(1).hangs_on(start("right_ear")) == {"nose", "left_ear", "neck"}


def test_a_piece_of_several_balloons_hangs_together_once_they_are_joined():
    piece = Workpiece(["one", "other"])
    piece.make(0, "a", "one")
    piece.make(1, "b", "other")
    assert piece.pieces() == [{"a"}, {"b"}]
    piece.join(2, (end("a"), start("b")))
    assert piece.pieces() == [{"a", "b"}]
    assert piece.hangs_on(end("a")) == {"b"}
    assert piece.are_one([end("a"), start("b")])


def test_a_balloon_begins_with_its_first_bubble():
    piece = Workpiece(["one", "other"])
    piece.make(3, "b", "other")
    assert piece.balloons == ("other",)
    assert piece.after(2).balloons == ()


def test_a_cut_makes_two_trails_of_one_and_parts_the_joint():
    piece = chain("a", "b", "c", "d")
    piece.join(4, (start("a"), end("d")))
    piece.cut(5, end("b"))
    assert piece.trails == (("a", "b"), ("c", "d"))
    assert not piece.are_one([end("b"), start("c")])
    assert piece.are_one([start("a"), end("d")])
    assert piece.after(4).is_closed("abcd")
    assert not piece.is_closed("abcd")
    assert piece.row("main") == ["a", "b", "c", "d"]


@pytest.mark.parametrize("at", [end("c"), start("b")])
def test_only_a_joint_between_two_bubbles_of_a_balloon_can_be_cut(at):
    with pytest.raises(ValueError, match="does not part two bubbles"):
        chain("a", "b", "c").cut(3, at)


def test_a_bubble_in_a_ring_is_gripped_while_the_ring_is_closed_and_nothing_unwinds_it():
    piece = chain("a", "b", "c", "d")
    piece.join(4, (start("a"), end("b")))
    assert piece.free_to_spin(end("c"))
    piece.touch(5, "roll", "c", ["a", "b"])
    assert piece.gripped() == {"c"}
    assert not piece.free_to_spin(end("c"))
    assert piece.after(4).contacts == ()
    assert piece.after(5, without={4}).gripped() == set()
    piece.pop(6, "a")
    assert piece.gripped() == set()


def test_the_end_of_a_bubble_unwinds_whose_start_alone_lies_in_a_ring():
    threaded = chain("a", "b", "c", "d")
    threaded.join(4, (start("a"), end("b")))
    threaded.touch(5, "thread", "c", ["a", "b"])
    assert threaded.free_to_spin(end("c"))
    wrapped = chain("throat", "muzzle", "behind", "nose", "tip")
    wrapped.join(5, (start("muzzle"), end("muzzle")))
    wrapped.touch(6, "wrap", "nose", ["muzzle"])
    assert not wrapped.free_to_spin(end("behind"))
    assert wrapped.free_to_spin(end("nose"))


def test_a_limb_is_the_smallest_part_that_hangs_on_one_joint(head):
    ears = head.after(1)
    assert ears.limb("nose").bubbles == {"nose"}
    assert ears.limb("left_ear").bubbles == {"left_ear", "right_ear"}
    assert end("nose") in ears.joint(ears.limb("left_ear").joint)
    assert ears.limb("neck").bubbles == {"neck"}


def test_a_bubble_in_a_row_takes_its_shorter_end_along():
    piece = chain("a", "b", "c", "d", "e")
    assert piece.limb("b").bubbles == {"a", "b"}
    assert piece.limb("d").bubbles == {"d", "e"}
    assert piece.limb("a").joint in piece.joint(end("a"))


def test_a_bubble_of_a_closed_ring_that_is_all_there_is_is_no_limb():
    piece = chain("a", "b", "c")
    piece.join(3, [start("a"), end("c")])
    piece.make(4, "rest", "main", last=True)
    assert piece.limb("b").bubbles == {"a", "b", "c"}
    piece.pop(5, "rest")
    assert piece.limb("b") is None


def test_a_row_leads_from_a_ring_to_a_bubble_if_nothing_else_hangs_on_it():
    piece = Workpiece(["main", "more"])
    for step, bubble in enumerate("abcdef"):
        piece.make(step, bubble, "main")
    piece.join(6, [start("b"), end("b")])
    piece.join(7, [start("d"), end("d")])
    assert piece.row_from(["b"], "f") == ("c", "e")
    assert piece.row_from(["b"], "c") == ()
    assert piece.row_from(["d"], "a") is None
    piece.make(8, "g", "more")
    piece.join(9, [start("g"), end("c")])
    assert piece.row_from(["b"], "f") is None


def test_joints_of_a_step_that_slips_come_apart(head):
    assert head.after(2, without={1}).free_to_spin(end("left_ear"))


def test_every_bubble_has_its_own_gas(head):
    assert head.chambers == (("nose",), ("left_ear",), ("right_ear",), ("neck",))


def test_a_pickled_workpiece_answers_as_before(head):
    bridges = head.bridges()
    assert pickle.loads(pickle.dumps(head)).bridges() == bridges == {"nose", "neck"}


JOINED = st.lists(st.tuples(*2 * [st.integers(0, 11)]), max_size=8)


@given(JOINED)
def test_a_bubble_is_a_bridge_if_there_are_more_pieces_without_it(pairs):
    piece = chain(*(f"b{k}" for k in range(12)))
    for one, other in pairs:
        piece.join(12, (start(f"b{one}"), end(f"b{other}")))
    number = {e: k for k, ends in enumerate(piece.joints) for e in ends}
    edges = {b: (number[start(b)], number[end(b)]) for b in piece.bubbles}

    def pieces(without: str | None = None) -> int:
        graph = nx.Graph()
        graph.add_nodes_from(number.values())
        graph.add_edges_from(ends for bubble, ends in edges.items() if bubble != without)
        return nx.number_connected_components(graph)

    several = {b for b, ends in edges.items() if list(map(set, edges.values())).count(set(ends)) > 1}
    expected = {b for b in edges if pieces(b) > pieces()} - several
    assert piece.bridges() == expected


def test_a_long_chain_is_all_bridges():
    piece = chain(*(f"b{k}" for k in range(2000)))
    assert len(piece.bridges()) == 2000


def test_a_ring_of_which_a_bubble_is_popped_is_open_and_hangs_together_all_the_same():
    piece = chain("nose", "a", "b", "c", "tail")
    piece.join(5, [start("a"), end("c")])
    assert piece.bridges() == {"nose", "tail"}
    piece.pop(6, "b")
    assert piece.bridges() == {"nose", "a", "c", "tail"}
    assert piece.popped == {"b"}
    assert piece.after(5).popped == frozenset()
    assert len(piece.pieces()) == 1
    assert piece.hangs_on(end("a")) == frozenset()
