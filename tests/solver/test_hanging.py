"""What hangs on a ring: all that bubbles and welds connect to it without passing another held ring."""

from __future__ import annotations

from balloon_usd.solver.motions.hanging import folded_between, hanging_on

RED, BLUE, GREEN = ("red",) * 5, ("blue",) * 3, ("green",) * 2


def test_what_lies_on_both_sides_of_a_chain_hangs_on_its_ends():
    assert hanging_on((1, 3), RED, ()) == ((0,), (4,))


def test_all_of_a_balloon_hangs_on_a_ring_that_is_held_alone():
    assert hanging_on((2,), RED, ()) == ((0, 1, 3, 4),)


def test_what_lies_between_two_held_rings_hangs_on_neither():
    assert hanging_on((0, 4), RED, ()) == ((), ())


def test_another_balloon_hangs_on_the_ring_that_it_is_welded_to():
    assert hanging_on((1, 3), RED + BLUE, ((1, 6),)) == ((0, 5, 6, 7), (4,))


def test_another_balloon_hangs_on_what_hangs_on_a_ring():
    assert hanging_on((1, 3), RED + BLUE + GREEN, ((0, 6), (7, 9))) == ((0, 5, 6, 7, 8, 9), (4,))


def test_a_balloon_that_is_welded_to_nothing_hangs_on_no_ring_of_another():
    assert hanging_on((1, 3), RED + BLUE, ()) == ((0,), (4,))


def test_what_is_welded_inside_a_chain_hangs_on_its_corner():
    assert hanging_on((1, 2, 3), RED + BLUE, ((2, 5),)) == ((0,), (5, 6, 7), (4,))


def test_what_two_held_rings_draw_hangs_on_neither():
    """Two balloons joined at 1 = 5, and to be joined at 3 = 7."""
    assert hanging_on((3, 7), RED + BLUE + ("blue",), ((1, 5),)) == ((4,), (8,))


def test_no_way_passes_what_is_welded_to_a_held_ring():
    """From 4 back to 1 there is a way through the weld of 3, which is one joint with the held 2."""
    assert hanging_on((1, 2), ("red",) * 6, ((2, 4),)) == ((0,), (3, 4, 5))


def test_a_loop_hangs_on_the_joint_that_it_is_closed_at():
    assert hanging_on((2, 4), RED, ((0, 2),)) == ((0, 1), ())


def test_what_is_folded_between_two_joined_rings_is_all_between_them():
    assert folded_between(1, 3, RED, ((1, 3),)) == (2,)


def test_what_hangs_on_a_fold_is_of_it():
    assert folded_between(1, 3, RED + BLUE, ((1, 3), (2, 6))) == (2, 5, 6, 7)


def test_a_fold_that_hangs_together_with_the_rest_elsewhere_is_none():
    assert folded_between(1, 3, RED, ((1, 3), (2, 4))) == ()
    assert folded_between(1, 3, RED + BLUE, ((1, 3), (2, 5), (0, 7))) == ()


def test_what_hangs_on_the_joint_itself_is_not_of_the_fold():
    assert folded_between(1, 3, RED + BLUE, ((1, 3, 6),)) == (2,)
