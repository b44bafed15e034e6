"""Turns: one thread at a time works with Warp, unless it gives its turn away."""

from __future__ import annotations

import threading

from balloon_usd.solver.capture_lock import turn, turn_given_away

PATIENCE = 0.2


def in_another_thread(event):
    """Start a thread that sets an event in its turn."""

    def work():
        with turn():
            event.set()

    thread = threading.Thread(target=work)
    thread.start()
    return thread


def test_another_thread_waits_for_its_turn():
    came = threading.Event()
    with turn():
        thread = in_another_thread(came)
        assert not came.wait(PATIENCE)
    thread.join()
    assert came.is_set()


def test_a_turn_that_is_given_away_is_taken_by_another_thread_and_comes_back():
    came, late = threading.Event(), threading.Event()
    with turn():
        thread = in_another_thread(came)
        with turn_given_away():
            assert came.wait(100 * PATIENCE)
            thread.join()
        thread = in_another_thread(late)
        assert not late.wait(PATIENCE)
    thread.join()


def test_a_thread_that_has_no_turn_gives_none_away():
    came = threading.Event()
    with turn_given_away():
        in_another_thread(came).join()
    assert came.is_set()
    with turn():
        pass
