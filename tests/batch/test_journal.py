from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from balloon_usd.batch.error import NotKept
from balloon_usd.batch.journal import Journal
from balloon_usd.batch.record import Record, Status
from tests.batch.runs import ROOT


def record(name, status=Status.DONE, recipe=None, **more):
    return Record(recipe or f"{name}.yaml", name, status, **more)


def names(folder):
    return [json.loads(line)["name"] for line in (folder / "batch.jsonl").read_text().splitlines()]


def test_a_record_is_read_as_it_was_written(tmp_path):
    made = record("a", made_of={"sha": "1"}, products={"stage": ("a.usdc",)}, files={"a.usdc": "2"}, size=3)
    Journal(tmp_path).add(made)
    assert Journal(tmp_path).of("a") == made
    assert Journal(tmp_path).of("b") is None


@pytest.mark.parametrize("length", [1, 40, -1])
def test_a_line_that_was_cut_short_counts_for_nothing_and_swallows_no_other(tmp_path, length):
    journal = Journal(tmp_path)
    journal.add(record("a"))
    whole = (tmp_path / "batch.jsonl").read_bytes()
    (tmp_path / "batch.jsonl").write_bytes(whole + record("b").line().encode()[:length])
    again = Journal(tmp_path)
    again.add(record("c"))
    again.put_in_order(["a.yaml", "b.yaml", "c.yaml"])
    # Of a line without its end nothing is missing but that.
    assert names(tmp_path) == (["a", "b", "c"] if length == -1 else ["a", "c"])


@pytest.mark.parametrize(
    "line",
    ["", "null", "[]", "7", '"text"', "{}", '{"name": "b"}', "{" * 2000, "[" * 100_000, "\ud800", "\x00"],
)
def test_lines_from_elsewhere_count_for_nothing(tmp_path, line):
    text = record("a").line() + line + "\n" + record("c").line()
    (tmp_path / "batch.jsonl").write_bytes(text.encode("utf-8", "surrogatepass"))
    journal = Journal(tmp_path)
    assert journal.of("a")
    assert journal.of("c")
    journal.put_in_order([])
    assert names(tmp_path) == ["a", "c"]


@pytest.mark.parametrize(
    ("key", "value"),
    [("recipe", 5), ("recipe", None), ("name", {}), ("files", []), ("files", {"a": 1}), ("status", "fine")],
)
def test_lines_with_something_else_in_them_count_for_nothing(tmp_path, key, value):
    line = json.dumps({**json.loads(record("b").line()), key: value})
    (tmp_path / "batch.jsonl").write_text(record("a").line() + line + "\n")
    journal = Journal(tmp_path)
    assert (journal.of("a") is None, journal.of("b")) == (False, None)
    journal.put_in_order([])
    assert names(tmp_path) == ["a"]


def test_lines_are_in_the_order_of_the_recipes_and_then_those_of_other_runs(tmp_path):
    journal = Journal(tmp_path)
    for name in ("z", "x", "b", "a", "c"):
        journal.add(record(name))
    journal.put_in_order(["c.yaml", "a.yaml", "b.yaml"])
    assert names(tmp_path) == ["c", "a", "b", "x", "z"]


def test_a_recipe_that_is_made_at_last_was_not_refused(tmp_path):
    journal = Journal(tmp_path)
    journal.add(record("", Status.REFUSED, "a.yaml", error="what?"))
    journal.add(record("a"))
    journal.put_in_order(["a.yaml"])
    assert names(tmp_path) == ["a"]


def test_a_stage_that_is_there_is_not_forgotten_when_its_recipe_is_refused_later(tmp_path):
    journal = Journal(tmp_path)
    journal.add(record("a"))
    journal.add(record("a", Status.REFUSED, error="what?"))
    journal.put_in_order(["a.yaml"])
    assert Journal(tmp_path).of("a").status is Status.DONE
    assert names(tmp_path) == ["a", "a"]


def test_names_of_recipes_that_are_no_text_are_kept(tmp_path):
    name = os.fsdecode(b"\xff.yaml")
    Journal(tmp_path).add(record("a", recipe=name))
    assert Journal(tmp_path).of("a").recipe == name


ADD = """
import sys
from pathlib import Path
from balloon_usd.batch.journal import Journal
from balloon_usd.batch.record import Record, Status

journal = Journal(Path(sys.argv[1]))
for number in range(200):
    journal.add(Record(f"{sys.argv[2]}{number}.yaml", f"{sys.argv[2]}{number}", Status.DONE, error="x" * 5000))
    if number % 20 == 0:
        journal.put_in_order([])
"""


def test_two_runs_that_write_at_once_lose_no_line(tmp_path):
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", ADD, tmp_path, run], env={**os.environ, "PYTHONPATH": str(ROOT)}
        )
        for run in "ab"
    ]
    assert [process.wait(60) for process in processes] == [0, 0]
    assert sorted(names(tmp_path)) == sorted(f"{run}{number}" for run in "ab" for number in range(200))
    assert [path.name for path in tmp_path.iterdir()] == ["batch.jsonl"]


def test_a_journal_that_cannot_be_written_is_told(tmp_path):
    journal = Journal(tmp_path / "gone")
    with pytest.raises(NotKept, match=r"gone/batch\.jsonl cannot be written: No such file or directory"):
        journal.add(record("a"))


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
def test_what_is_no_file_is_no_journal_and_is_not_waited_for(tmp_path, make):
    make(tmp_path / "batch.jsonl")
    with pytest.raises(OSError, match="cannot be read, it is no file"):
        Journal(tmp_path)


def test_what_a_killed_run_left_of_its_journal_is_removed(tmp_path):
    (tmp_path / ".batch.jsonl.0123abcd.partial").write_text("{")
    journal = Journal(tmp_path)
    journal.add(record("a"))
    journal.put_in_order(["a.yaml"])
    assert [path.name for path in tmp_path.iterdir()] == ["batch.jsonl"]
