"""What a figure comes apart into where bubbles tear that are popped."""

from __future__ import annotations

import pytest

from balloon_usd.operations.parting import Stretch, parts_of, torn_bubbles
from balloon_usd.recipe import Recipe

HEAD = "format: 1\nname: p\nunits: cm\nballoons:\n  main: {size: 260, length: 40, tail: 12}\n"
CHAIN = "  - bubbles: {a: 6}\n  - ear: {e: 3}\n  - bubbles: {gap: 5}\n  - ear: {f: 3}\n  - rest: end\n"


def piece_of(steps, balloons=""):
    """Return what is made by some steps."""
    return Recipe.parse(f"{HEAD}{balloons}steps:\n{steps}").piece


def test_a_chain_of_which_a_bubble_between_is_popped_comes_apart_there():
    piece = piece_of(CHAIN + "  - pop: gap\n")
    assert torn_bubbles(piece) == {"gap"}
    assert parts_of(piece) == ((Stretch("main", None, "gap"),), (Stretch("main", "gap", None),))


def test_a_figure_of_which_nothing_is_popped_is_one_part_however_many_balloons_it_has():
    two = "  other: {size: 260, length: 12, tail: 4}\n"
    steps = CHAIN.replace("\n", "\n    balloon: main\n").replace("  - rest: end\n    balloon: main\n", "")
    piece = piece_of(f"{steps}  - bubbles: {{o: 5}}\n    balloon: other\n", two)
    assert parts_of(piece) == ((Stretch("main", None, None), Stretch("other", None, None)),)


@pytest.mark.parametrize("popped", ["end", "a"])
def test_what_hangs_on_one_joint_does_not_tear(popped):
    piece = piece_of(f"{CHAIN}  - pop: {popped}\n")
    assert torn_bubbles(piece) == frozenset()
    assert len(parts_of(piece)) == 1


def test_what_is_locked_elsewhere_stays_one_part():
    piece = piece_of(CHAIN + "  - pop: gap\n  - lock: {joints: [a.start, end.start]}\n")
    assert torn_bubbles(piece) == {"gap"}
    (part,) = parts_of(piece)
    assert part == (Stretch("main", None, "gap"), Stretch("main", "gap", None))


def test_what_is_between_two_popped_bubbles_is_a_part_of_its_own():
    more = "  - bubbles: {hole: 5}\n  - ear: {g: 3}\n  - rest: end\n  - pop: gap\n  - pop: hole\n"
    piece = piece_of(CHAIN.replace("  - rest: end\n", more))
    behind = [part[0].behind for part in parts_of(piece)]
    assert behind == [None, "gap", "hole"]


def test_what_was_pushed_through_a_ring_stays_with_it_and_what_nothing_joins_with_the_first_part():
    two = "  other: {size: 260, length: 12, tail: 4}\n"
    ring = (
        "  - bubbles: {p: 6, q: 6}\n    balloon: main\n  - lock: [p, q]\n  - ear: {e: 3}\n    balloon: main\n"
    )
    gap = "  - bubbles: {gap: 5}\n    balloon: main\n  - ear: {f: 3}\n    balloon: main\n"
    alone = "  - bubbles: {o: 5}\n    balloon: other\n"
    steps = f"{ring}{gap}{alone}  - pop: gap\n"
    first, second = parts_of(piece_of(steps, two))
    assert {stretch.balloon for stretch in first} == {"main", "other"}
    assert [stretch.balloon for stretch in second] == ["main"]
