"""One thread at a time launches kernels, unless it releases the lock."""

from __future__ import annotations

import threading

from balloon_usd.solver.capture_lock import capture_lock, capture_lock_released

PATIENCE = 0.2


def in_another_thread(event):
    """Start a thread that sets an event once it has the lock."""

    def work():
        with capture_lock():
            event.set()

    thread = threading.Thread(target=work)
    thread.start()
    return thread


def test_another_thread_waits_for_the_lock():
    came = threading.Event()
    with capture_lock():
        thread = in_another_thread(came)
        assert not came.wait(PATIENCE)
    thread.join()
    assert came.is_set()


def test_a_released_lock_is_taken_by_another_thread_and_comes_back():
    came, late = threading.Event(), threading.Event()
    with capture_lock():
        thread = in_another_thread(came)
        with capture_lock_released():
            assert came.wait(100 * PATIENCE)
            thread.join()
        thread = in_another_thread(late)
        assert not late.wait(PATIENCE)
    thread.join()


def test_a_thread_without_the_lock_releases_none():
    came = threading.Event()
    with capture_lock_released():
        in_another_thread(came).join()
    assert came.is_set()
    with capture_lock():
        pass
