from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from balloon_usd.batch.leftovers import remove_leftovers
from balloon_usd.files.lock import hold, is_held, remove_unheld
from balloon_usd.files.whole_file import write_whole
from tests.batch.runs import ROOT


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_files_are_written_together_and_replace_what_was_there(tmp_path):
    (tmp_path / "a").write_text("before")
    write_whole({tmp_path / "a": b"1", tmp_path / "b": b"2"})
    assert [(tmp_path / name).read_bytes() for name in "ab"] == [b"1", b"2"]
    assert names(tmp_path) == ["a", "b"]


def test_nothing_is_half_written_when_the_second_file_cannot_be(tmp_path):
    (tmp_path / "a").write_text("before")
    with pytest.raises(FileNotFoundError) as raised:
        write_whole({tmp_path / "a": b"1", tmp_path / "gone" / "b": b"2"})
    assert raised.value.filename == str(tmp_path / "gone" / "b")
    assert (tmp_path / "a").read_text() == "before"
    assert names(tmp_path) == ["a"]


def test_nothing_is_half_written_on_a_full_disk(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OSError, match="No space left") as raised:
        write_whole({tmp_path / "a": b"1"})
    assert raised.value.filename == str(tmp_path / "a")
    assert names(tmp_path) == []


WRITE = """
import os, signal, sys
from pathlib import Path
from balloon_usd.files.whole_file import write_whole

def pause(*_):
    print("written", flush=True)
    sys.stdin.read()

Path.replace = pause
write_whole({Path(sys.argv[1]): b"x" * 100})
"""


def test_what_a_killed_process_left_is_swept_and_what_a_living_one_writes_is_not(tmp_path):
    words = [sys.executable, "-c", WRITE, str(tmp_path / "a.png")]
    process = subprocess.Popen(
        words,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    process.stdout.readline()
    (partial,) = names(tmp_path)
    remove_leftovers(tmp_path, "a")
    assert names(tmp_path) == [partial]
    process.kill()
    process.communicate()
    remove_leftovers(tmp_path, "b")
    assert names(tmp_path) == [partial]
    remove_leftovers(tmp_path, "a")
    assert names(tmp_path) == []


def test_leftovers_of_a_folder_that_is_not_there_are_none(tmp_path):
    remove_leftovers(tmp_path / "gone", "a")
    assert names(tmp_path) == []


def test_a_lock_is_held_until_its_file_is_closed(tmp_path):
    lock = tmp_path / "lock"
    with hold(lock):
        assert is_held(lock)
        remove_unheld(lock)
        assert lock.exists()
    assert not is_held(lock)
    remove_unheld(lock)
    assert not lock.exists()
    remove_unheld(lock)


RACE = """
import sys
from pathlib import Path
from balloon_usd.files.lock import remove_unheld
from balloon_usd.files.whole_file import write_whole

folder, role = Path(sys.argv[1]), sys.argv[2]
for number in range(400):
    if role == "write":
        write_whole({folder / f"file{number % 3}": b"x" * 1000})
    else:
        for partial in folder.glob(".*.partial"):
            remove_unheld(partial)
print("done")
"""


def test_a_file_that_is_being_written_is_never_swept(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", RACE, tmp_path, role], env=environment, stdout=subprocess.PIPE
        )
        for role in ("write", "sweep", "write", "sweep")
    ]
    assert [process.communicate(timeout=60)[0] for process in processes] == [b"done\n"] * 4
    assert names(tmp_path) == ["file0", "file1", "file2"]
