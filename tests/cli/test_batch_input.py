"""Bad input of batches: all of it is told, in lines, and everything that can be made is made."""

from __future__ import annotations

import errno
import os
import socket
import subprocess
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.batch import runs
from tests.command_line import RECIPE

ORDER = ("-o", "out", "--flat", "--no-preview", "--no-report")
BROKEN = (
    "",
    "format: 1\n",
    "format: 2\nname: x\n",
    "{{{{",
    "\x00\x01\x02",
    "- a\n- b\n",
    "format: 1\nname: ../x\nballoons: {}\nsteps: []\n",
    "format: 1\nname: a b\nballoons: {main: {size: 260}}\nsteps: [{rest: tail}]\n",
    "[" * 5000,
    "a: &a [*a]\n",
    "null",
    "7",
    RECIPE.format(name="x", fps=0),
    RECIPE.format(name="x", fps=24).replace("nose: 8", "nose: 8000"),
    RECIPE.format(name="x", fps=24).replace("260", "261"),
    RECIPE.format(name="x", fps=24) + "step: 1\n",
    RECIPE.format(name="x", fps=24).replace("red", "rad"),
)


@pytest.mark.parametrize(
    "count", [24, pytest.param(300, marks=pytest.mark.long), pytest.param(10_000, marks=pytest.mark.long)]
)
def test_broken_recipes_among_many_are_all_told_and_the_others_made(
    count, cli, solver, write_recipe, tmp_path
):
    good = [f"r{number:05}" for number in range(count - len(BROKEN))]
    for name in good:
        write_recipe(name, f"recipes/{name}.yaml")
    for number, text in enumerate(BROKEN):
        write_recipe(file=f"recipes/broken{number:02}.yaml", text=text or "\n")
    result = cli("run", "recipes", *ORDER, "--frames", ":2")
    assert result.exit_code == 2, result.stderr[-3000:]
    for number in range(len(BROKEN)):
        assert f"recipes/broken{number:02}.yaml:" in result.stderr
    assert "Traceback" not in result.stderr
    assert f"{len(BROKEN)} refused, {len(good)} made" in result.stdout
    left = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert left == sorted(["batch.jsonl", *(f"{name}.usdc" for name in good)])
    assert len((tmp_path / "out" / "batch.jsonl").read_text().splitlines()) == count


def test_names_that_a_file_system_takes_for_one_are_told_apart(cli, solver, write_recipe, tmp_path):
    write_recipe("dog", "recipes/a.yaml")
    write_recipe("DOG", "recipes/b.yaml")
    for number, name in enumerate(("caf\u00e9", "cafe\u0301")):
        write_recipe(f"cafe{number}", f"recipes/{name}.yaml")
    write_recipe("caf\u00e9", "recipes/z.yaml")
    result = cli("run", "recipes", *ORDER)
    assert result.exit_code == 2
    assert 'recipes/b.yaml: name: "DOG" is taken by recipes/a.yaml' in result.stderr
    assert 'recipes/z.yaml:2:7: name: "caf\u00e9" is no name, expected letters, digits and _' in result.stderr
    left = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert left == ["batch.jsonl", "cafe0.usdc", "cafe1.usdc", "dog.usdc"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--jobs", "0"), "0 is not in the range 1<=x<=4096"),
        (("--device", "cuda:0,cuda:0"), '"cuda:0,cuda:0" names a device twice'),
        (
            ("--device", "cuda:0,cpu"),
            '"cuda:0,cpu" is no device, expected auto, cpu, cuda or cuda:N, several',
        ),
        (("--device", ","), '"," is no device'),
        (("--address", "127.0.0.1:6379"), "--address: only with --engine ray"),
        (
            ("--engine", "ray", "--address", "nonsense"),
            "nonsense: no address of a cluster, expected HOST:PORT",
        ),
    ],
)
def test_options_that_make_no_sense_are_refused_before_anything_is_started(
    words, told, cli, solver, write_recipe, tmp_path
):
    result = cli("run", write_recipe(), *ORDER, *words)
    assert result.exit_code == 2
    assert told in result.stderr
    assert not (tmp_path / "out").exists()


def test_all_devices_of_a_machine_without_any_are_refused(cli, solver, write_recipe):
    result = cli("run", write_recipe(), *ORDER, "--device", "all")
    assert result.exit_code == 2
    assert result.stderr.splitlines()[-1] == 'there is no device "cuda", only cpu'


def test_nobody_at_the_address_of_a_cluster_is_told_soon_in_one_line(cli, solver, write_recipe):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    begin = time.monotonic()
    result = cli("run", write_recipe(), *ORDER, "--engine", "ray", "--address", f"127.0.0.1:{port}")
    assert time.monotonic() - begin < 5
    assert result.exit_code == 2
    assert result.stderr.splitlines() == [f"127.0.0.1:{port}: no Ray cluster answers (Connection refused)"]


def meanwhile(action, solver, folder, name="log"):
    """Do something once the first recipe is simulated, or a file of another name is in the folder; then let
    what pauses go on.
    """

    def wait():
        end = time.monotonic() + 60
        while time.monotonic() < end and not any(folder.glob(name)):
            time.sleep(0.01)
        action()
        solver.go_on()

    thread = threading.Thread(target=wait)
    thread.start()
    return thread


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (
            lambda recipe: recipe.write_text(recipe.read_text() + "# more\n"),
            "the recipe was changed during the run",
        ),
        (Path.unlink, "cannot be read (No such file or directory)"),
        (lambda recipe: recipe.write_text("format: 1\n"), "expected"),
    ],
    ids=["changed", "deleted", "broken"],
)
def test_a_recipe_that_is_another_one_when_it_is_simulated_is_not_made(
    change, told, cli, solver, write_recipe, tmp_path
):
    solver.trouble = {"first": "pause"}
    write_recipe("first", "recipes/a.yaml")
    last = write_recipe("last", "recipes/b.yaml")
    watcher = meanwhile(lambda: change(last), solver, solver.folder)
    result = cli("run", "recipes", *ORDER, "--jobs", 1)
    watcher.join()
    assert result.exit_code == 1, result.output
    (line,) = [line for line in result.stderr.splitlines() if told in line and "recipes/b.yaml" in line][:1]
    assert line.count("recipes/b.yaml") == 1
    found = runs.records(tmp_path / "out")
    assert {name: record["status"] for name, record in found.items()} == {
        "first": "done",
        "last": "not written",
    }
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["batch.jsonl", "first.usdc"]


def test_an_output_folder_that_is_deleted_during_the_run_is_told(cli, solver, write_recipe, tmp_path):
    solver.trouble = {"first": "pause"}
    write_recipe("first", "recipes/a.yaml")
    write_recipe("last", "recipes/b.yaml")

    def delete():
        (tmp_path / "out").rename(tmp_path / "gone")

    # A folder that is not there yet when the file of a stage is begun is made anew.
    watcher = meanwhile(delete, solver, tmp_path / "out", ".first.*.writing/*.usdc")
    result = cli("run", "recipes", *ORDER, "--jobs", 1)
    watcher.join()
    assert result.exit_code == 1, result.output
    assert "Traceback" not in result.output
    assert "recipes/a.yaml: out/first.usdc could not be written" in result.stderr


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
def test_a_journal_that_is_no_file_is_told_and_not_waited_for(make, cli, solver, write_recipe, tmp_path):
    (tmp_path / "out").mkdir()
    make(tmp_path / "out" / "batch.jsonl")
    result = cli("run", write_recipe(), *ORDER)
    assert result.exit_code == 2
    assert result.stderr.splitlines()[-1] == "out/batch.jsonl: cannot be read, it is no file"
    assert solver.calls == []


def test_a_recipe_that_is_no_file_takes_no_other_along(cli, solver, write_recipe, tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "loop.yaml").symlink_to(tmp_path / "loop.yaml")
    (tmp_path / "long.yaml").symlink_to("/dev/zero")
    result = cli("run", write_recipe(), "pipe.yaml", "loop.yaml", "long.yaml", "x" * 300 + ".yaml", *ORDER)
    assert result.exit_code == 2
    assert "1 made" in result.stdout
    assert "4 refused" in result.stdout
    assert "Traceback" not in result.stderr
    for name in ("pipe.yaml:", "loop.yaml:", "long.yaml:", "xxx.yaml:"):
        assert any(name in line for line in result.stderr.splitlines()), name


@contextmanager
def small_disk(folder):
    """Mount a disk with room for little; who may not mount has one that is full for one stage."""
    folder.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", "size=128k", "tmpfs", str(folder)]
    if os.geteuid() == 0 and subprocess.run(words, capture_output=True, check=False).returncode == 0:
        try:
            yield
        finally:
            subprocess.run(["umount", str(folder)], check=True)
    else:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("FAKE_FULL_DISK", "s7.usdc")
            yield


def test_a_disk_that_is_full_is_told_and_nothing_half_written_is_left(cli, solver, write_recipe, tmp_path):
    for number in range(8):
        write_recipe(f"s{number}", f"recipes/s{number}.yaml")
    with small_disk(tmp_path / "out"):
        result = cli("run", "recipes", *ORDER)
        assert result.exit_code == 1, result.output
        assert "Traceback" not in result.output
        assert os.strerror(errno.ENOSPC) in result.stderr
        left = [path.name for path in (tmp_path / "out").rglob("*")]
        assert not [name for name in left if name.startswith(".")]
