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


TWO = "  other: {size: 260, length: 30, tail: 9}\n"


def chain_of(balloon):
    """Return the steps of a chain of which a bubble between two ears is popped, on a balloon."""
    on = f"\n    balloon: {balloon}\n"
    names = [f"{balloon}_{each}" for each in ("a", "e", "gap", "f")]
    kinds = "bubbles", "ear", "bubbles", "ear"
    made = "".join(f"  - {kind}: {{{name}: 3}}{on}" for kind, name in zip(kinds, names, strict=True))
    return f"{made}  - bubbles: {{{balloon}_b: 5}}{on}  - pop: {balloon}_gap\n"


def test_balloons_that_nothing_joins_have_their_first_parts_in_common():
    parts = parts_of(piece_of(chain_of("main") + chain_of("other"), TWO))
    assert [[stretch.balloon for stretch in part] for part in parts] == [
        ["main", "other"],
        ["main"],
        ["other"],
    ]


def test_a_popped_ear_parts_nothing_however_many_balloons_there_are():
    steps = chain_of("main").replace("pop: main_gap", "pop: main_e") + chain_of("other").replace(
        "pop: other_gap", "pop: other_e"
    )
    piece = piece_of(steps, TWO)
    assert torn_bubbles(piece) == {"main_e", "other_e"}
    assert len(parts_of(piece)) == 1


def test_a_figure_in_which_a_balloon_lies_that_is_not_begun_yet_is_told_apart_too():
    shell = "  shell: {size: 646, length: 40, tail: 18}\n  bug: {size: 260, length: 4, tail: 1.5}\n"
    steps = "".join(
        f"  - {step}\n    balloon: shell\n"
        for step in ("bubbles: {a: 12}", "ear: {e: 6}", "bubbles: {gap: 12}", "ear: {f: 6}", "rest: hall")
    )
    text = f"{HEAD.replace('  main: {size: 260, length: 40, tail: 12}', shell.rstrip())}steps:\n  - insert: {{bug: hall}}\n"
    piece = Recipe.parse(f"{text}  - inflate: shell\n{steps}  - pop: gap\n  - inflate: bug\n").piece
    at = next(
        event.step for event in piece.history if getattr(event, "bubble", None) == "gap" and event.step > 5
    )
    assert len(parts_of(piece.after(at))) == 2
    assert {stretch.balloon for stretch in parts_of(piece)[1]} == {"shell", "bug"}
