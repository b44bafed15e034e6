from __future__ import annotations

import io

from balloon_usd.farm import TaskLog


def told(*texts):
    stream = io.StringIO()
    log = TaskLog(stream)
    for text in texts:
        log.write(text)
    log.close()
    return stream.getvalue().splitlines()


def test_progress_is_told_as_a_percentage_and_a_status():
    assert told("progress 5/20 fold: nose\n") == ["openjd_progress: 25", "openjd_status: fold: nose"]


def test_what_has_been_told_is_not_told_again():
    lines = [f"progress {frame}/1000 wait\n" for frame in range(1, 13)]
    assert told(*lines) == ["openjd_progress: 0", "openjd_status: wait", "openjd_progress: 1"]


def test_other_lines_pass_in_their_place_also_in_pieces():
    pieces = ["dog.yaml: cau", "tion: soft\nprog", "ress 1/1 done", "\nlast"]
    passed = ["dog.yaml: caution: soft", "openjd_progress: 100", "openjd_status: done", "last"]
    assert told(*pieces) == passed


def test_nothing_to_do_is_all_done():
    assert told("progress 0/0 getting ready\n") == ["openjd_progress: 0", "openjd_status: getting ready"]
