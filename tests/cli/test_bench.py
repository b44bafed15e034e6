"""The command `bench`, as a user types it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.bench import first_frame, peers
from balloon_usd.bench.pinch_task import PinchRun


def rows_of(result):
    """Words of every line after title and heads."""
    assert result.exit_code == 0, result.output
    return [line.split() for line in result.stdout.splitlines()[2:]]


def test_the_title_names_the_device_and_its_cores(cli, solver):
    title = cli("bench", "--frames", 4, "--device", "cpu").stdout.splitlines()[0]
    assert re.fullmatch(r"classic dog, latex, draft on cpu \(.+, \d+ cores?\)", title)


def test_throughput_stands_beside_that_of_one_copy(cli, solver):
    rows = rows_of(cli("bench", "--copies", 1, "--copies", 3, "--frames", 5, "--device", "cpu"))
    rates, times = ([float(row[k]) for row in rows] for k in (7, 12))
    assert times[0] == 1.0
    # It is told with two digits after the point, of which a busy machine makes few.
    assert times[1] == pytest.approx(rates[1] / rates[0], rel=0.02, abs=0.005)


def test_without_one_copy_there_is_nothing_to_compare_with(cli, solver):
    ((*_, times),) = rows_of(cli("bench", "--copies", 2, "--frames", 4, "--device", "cpu"))
    assert times == "-"


def test_a_promise_stands_beside_what_was_measured(cli, solver):
    ((*_, word),) = rows_of(cli("bench", "--frames", 4, "--device", "cpu"))
    assert word in ("kept", "missed")
    assert ">= 48 frames/s" in cli("bench", "--frames", 4, "--device", "cpu").stdout


def test_different_recipes_together_are_held_against_each_alone(cli, solver):
    result = cli("bench", "--mixed", "--frames", 4, "--device", "cpu")
    *rows, last = rows_of(result)
    assert [row[:2] for row in rows] == [["dog", "1"], ["mouse", "1"], ["pair", "1"], ["together", "3"]]
    assert int(rows[3][2]) == sum(int(row[2]) for row in rows[:3])
    assert last[:2] == ["together", "they"]
    assert "<= 1.1 x parts" in result.stdout


def test_processes_side_by_side_are_held_against_one(cli):
    rows = rows_of(cli("bench", "--processes", 2, "--frames", 3, "--device", "cpu"))
    assert [row[0] for row in rows] == ["1", "2"]
    assert all(float(row[1]) > 0.0 for row in rows)
    assert float(rows[1][2]) == pytest.approx(float(rows[1][1]) / float(rows[0][1]), rel=0.05)


def test_a_process_that_ends_too_early_is_told_in_one_line(cli, monkeypatch):
    monkeypatch.setattr("balloon_usd.bench.processes.CLASSIC_DOG", "format: 7")
    result = cli("bench", "--processes", 2, "--device", "cpu")
    assert result.exit_code == 3
    assert "ended with 1: " in result.stderr
    assert len(result.stderr.splitlines()) == 1


DETAILS = []
"""Details that processes were started with."""


class Start:
    """A process that compiles what is not in its folder yet and starts at once."""

    def __init__(self, task, cache):
        DETAILS.append(task.detail)
        recompiled = "draft" if "mouse" not in task.recipes[0] else "mouse"
        (Path(cache) / f"wp_{recompiled}").mkdir(exist_ok=True)

    def first_frame(self):
        return 1.5

    def end(self):
        pass


def test_the_first_frame_is_measured_cold_and_warm_and_tells_what_was_compiled_again(cli, monkeypatch):
    monkeypatch.setattr(first_frame, "Child", Start)
    result = cli("bench", "--first-frame", "--device", "cpu")
    lines = result.stdout.splitlines()[2:]
    assert result.exit_code == 0, result.output
    assert [re.split(r"\s{2,}", line.strip())[2] for line in lines] == ["1", "0", "1", "0", "0"]
    assert "<= 15 s: kept" in lines[0]
    assert "<= 2 s: kept, compiled nothing again" in lines[1]
    assert "compiled 1 modules again" in lines[2]
    assert DETAILS == ["draft", "draft", "draft", "draft", "preview"]


def test_a_peer_that_is_not_installed_is_told_in_one_line_with_the_remedy(cli, monkeypatch):
    monkeypatch.setattr(peers, "find_spec", lambda name: None)
    result = cli("bench", "--peer", "newton,blender", "--device", "cpu")
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr == "newton and blender are not installed: pip install 'balloon-usd[peers]'\n"


def test_one_ring_can_be_pinched_instead_and_the_same_is_promised_of_it(cli):
    result = cli("bench", "--peer", "none", "--pinch", "one ring", "--device", "cpu")
    rows = rows_of(result)
    assert result.stdout.startswith("pinch by one ring and one turn, 1602 vertices")
    assert [row[0] for row in rows] == ["balloon_usd", "twice"]
    assert [row[-1] for row in rows] == ["kept", "0"]
    assert rows[1][-2] == "1.00"


@pytest.mark.long
def test_stages_are_written_checked_and_compared(cli):
    result = cli("bench", "--stage", "--frames", 3)
    assert re.match(r"stages of 39674 vertices and 3 frames on cpu \(", result.stdout)
    told = rows_of(result)
    assert ["check", "with", "NVIDIA's"] in [row[:3] for row in told]
    rows = {row[0]: row for row in told if row[1] != "with"}
    assert [*rows] == ["plain", "write", "check", "diff"]
    assert "x plain" in " ".join(rows["write"])
    assert rows["diff"].count("kept") + rows["diff"].count("kept,") == 2
    # Two stages are read for one comparison.
    assert int(rows["diff"][2]) == pytest.approx(2 * int(rows["check"][2]), abs=1)


def test_an_unknown_peer_is_bad_input(cli):
    result = cli("bench", "--peer", "houdini")
    assert result.exit_code == 2
    assert '"houdini" is no peer, expected newton or blender or none' in result.stderr


def test_two_measurements_at_once_are_bad_input(cli):
    result = cli("bench", "--mixed", "--processes", 2)
    assert result.exit_code == 2
    assert "one at a time" in result.stderr


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (("--model", "kosaka", "--mixed"), "--model: not used with --mixed\n"),
        (("--peer", "none", "--frames", 5, "--copies", 7), "--copies, --frames: not used with --peer\n"),
        (("--first-frame", "--frames", 3), "--frames: not used with --first-frame\n"),
        (("--vertices", 6402), "--vertices: not used without --peer\n"),
    ],
)
def test_options_that_would_be_ignored_are_bad_input(cli, asked, told):
    result = cli("bench", *asked)
    assert result.exit_code == 2
    assert result.stderr == told


def test_peers_do_the_task_of_ours_and_are_measured_alike(cli, monkeypatch):
    monkeypatch.setattr(peers, "find_spec", lambda name: name)
    tubes = []

    def leave_alone(peer, task):
        tubes.append(task)
        points = task.mesh.points.astype(np.float64)
        return PinchRun(points, points, 7, 1.0, 2.0)

    monkeypatch.setattr(peers.Peer, "pinch", leave_alone)
    rows = rows_of(cli("bench", "--peer", "blender", "--device", "cpu"))
    assert [row[0] for row in rows] == ["balloon_usd", "twice", "Blender"]
    assert "kept" in rows[0][-1]
    assert rows[2][2:] == ["7", "1.00", "2.00", "1.0000", "0.00", "0.00", "0"]
    assert tubes[0].vertices == len(tubes[0].mesh.points) == 1602
