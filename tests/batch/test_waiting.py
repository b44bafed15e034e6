from __future__ import annotations

import pytest

from balloon_usd.batch.facts import Facts
from balloon_usd.batch.job import Job
from balloon_usd.batch.record import Record, Status
from balloon_usd.batch.waiting import Waiting


def job(number, frames=10, group="g", vertices=100):
    return Job(number, f"{number}.yaml", Facts(f"j{number}", {}, 24, frames, frames, vertices, group))


def numbers(jobs):
    return [each.number for each in jobs]


def test_the_longest_come_first_and_equal_ones_in_their_order():
    waiting = Waiting([job(0, 5), job(1, 20), job(2, 5), job(3, 10)])
    assert numbers(waiting.take(3)) == [1, 3, 0]
    assert numbers(waiting.take(3)) == [2]
    assert waiting.take(3) == []
    assert len(waiting) == 0


def test_only_jobs_of_one_group_are_taken_together():
    waiting = Waiting([job(0, 5, "a"), job(1, 9, "b"), job(2, 7, "a"), job(3, 8, "b")])
    assert numbers(waiting.take(9)) == [1, 3]
    assert waiting.vertices == 100
    assert numbers(waiting.take(9)) == [2, 0]


def test_what_is_tried_again_comes_first_in_the_parts_that_it_was_given_back_in():
    jobs = [job(number) for number in range(6)]
    waiting = Waiting(jobs)
    first = waiting.take(4)
    waiting.retry(first[:2])
    waiting.retry(first[2:])
    assert len(waiting) == 6
    assert [numbers(waiting.take(1)) for _ in range(2)] == [[0], [1]]
    assert numbers(waiting.take(9)) == [2, 3]
    assert numbers(waiting.take(9)) == [4, 5]


def test_what_is_over_meanwhile_is_not_tried_again():
    jobs = [job(number) for number in range(3)]
    waiting = Waiting(jobs)
    waiting.retry(waiting.take(3))
    jobs[1].record = Record("1.yaml", "j1", Status.NOT_WRITTEN)
    assert numbers(waiting.take(9)) == [0, 2]


def test_one_that_is_to_be_tried_alone_waits_for_all_others():
    jobs = [job(number) for number in range(3)]
    waiting = Waiting(jobs)
    suspect, other, _ = waiting.take(3)
    waiting.retry_alone(suspect)
    waiting.retry_alone(other)
    waiting.retry(jobs[2:])
    assert waiting.take_alone() == []
    assert numbers(waiting.take(9)) == [2]
    assert waiting.take(9) == []
    suspect.record = Record("0.yaml", "j0", Status.KILLED)
    assert len(waiting) == 2
    assert numbers(waiting.take_alone()) == [1]
    assert len(waiting) == 0


def test_nothing_waits_any_more_after_all_is_given_up():
    waiting = Waiting([job(0), job(1), job(2)])
    waiting.retry(waiting.take(1))
    waiting.retry_alone(waiting.take(1)[0])
    waiting.clear()
    assert len(waiting) == 0
    assert waiting.vertices == 1


@pytest.mark.parametrize(("tries", "news"), [([4, 2], [4, 0]), ([4, 6], [4, 2]), ([10], [10])])
def test_progress_counts_a_frame_once_however_often_it_is_simulated(tries, news):
    one = job(0)
    found = []
    for frames in tries:
        one.frames = 0
        found.append(sum(one.advance(1) for _ in range(frames)))
    assert found == news
