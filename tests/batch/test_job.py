from __future__ import annotations

import pytest

from balloon_usd.batch.job import BatchRun, Job
from balloon_usd.batch.messages import Frames, Part


@pytest.fixture
def run():
    """A batch of three sculptures: 0 and 1 at the writer "one", 2 at "two"; the last one ends after 5 frames."""
    parts = [Part(job, 7, job, f"{job}.yaml", {}, 5 if job == 2 else 10) for job in range(3)]
    return BatchRun(7, "simulator", {"one": parts[:2], "two": parts[2:]})


def frames(slot=0, first=1, count=4, **more):
    return Frames(7, slot, first, count, "pinch", **more)


def test_a_slot_is_free_when_all_writers_have_given_it_back(run):
    assert run.lent(frames(slot=3)) == {"one", "two"}
    assert not run.given_back(3, "one")
    assert not run.given_back(3, "one"), "twice is once"
    assert run.given_back(3, "two")
    assert not run.given_back(3, "two"), "it is free already"
    assert not run.given_back(5, "one"), "it was never lent"


def test_a_writer_that_has_nothing_left_to_write_gets_no_more_slots(run):
    del run.writer[2]
    assert run.lent(frames()) == {"one"}
    assert run.given_back(0, "one")
    run.writer.clear()
    assert run.lent(frames(slot=1)) == set()
    assert not run.given_back(1, "one")


def test_slots_of_a_writer_that_is_gone_are_free_unless_others_need_them(run):
    run.lent(frames(slot=0))
    run.lent(frames(slot=1))
    run.given_back(0, "two")
    assert run.without("one") == ([0, 1], [0])
    assert run.writers == {"two"}
    assert run.given_back(1, "two")


@pytest.mark.parametrize(
    ("job", "told", "news"),
    [
        (0, frames(), 4),
        (0, frames(first=9, count=4), 2),
        (2, frames(first=5, count=3), 1),
        (2, frames(first=6, count=3), 0),
        (1, frames(first=5, count=4, failed={1: (7, "why")}), 2),
        (1, frames(first=5, count=4, failed={0: (7, "why")}), 4),
    ],
)
def test_a_job_advances_by_the_frames_that_it_wants_and_has(run, job, told, news):
    assert run.advance(job, told) == news


def test_a_job_that_fails_has_its_last_frame_before_that_whatever_others_do(run):
    job = Job(1, "1.yaml", frames=6)
    assert not run.has_all_frames(job)
    assert run.advance(1, frames(first=5, count=4, failed={1: (7, "why")})) == 2
    assert run.advance(1, frames(first=9, count=2)) == 0
    assert run.has_all_frames(job)
