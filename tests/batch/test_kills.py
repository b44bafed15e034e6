"""Processes that are killed: what they were making is made again, and nothing else of the run suffers."""

from __future__ import annotations

import random
import signal
import threading
import time
from types import SimpleNamespace

import pytest

from tests.batch import runs
from tests.batch.conftest import write_recipes_into
from tests.batch.test_resume import SHORT_RECIPE
from tests.command_line import pretend_solver

NAMES = tuple("abcd")
ORDER = ("-o", "out", "--flat")
LONG = pytest.mark.long


def whole(*names):
    """Return the files of sculptures without contact sheets."""
    return sorted(
        [
            "batch.jsonl",
            *(f"{name}{end}" for name in names for end in (".usdc", ".report.json", ".report.png")),
        ]
    )


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """A function that starts runs of some recipes, what a run leaves that nobody disturbs, and how long it takes."""
    folder = tmp_path_factory.mktemp("undisturbed")
    recipes = write_recipes_into(folder / "recipes", "ab")

    def start(folder):
        return runs.start(recipes, *ORDER, cwd=folder)

    with pytest.MonkeyPatch.context() as patch:
        pretend_solver(patch, folder / "solver")
        begin = time.monotonic()
        process = start(folder)
        process.communicate(timeout=runs.PATIENCE)
        assert process.returncode == 0
        yield SimpleNamespace(start=start, tree=runs.tree(folder / "out"), seconds=time.monotonic() - begin)


@LONG
def test_every_process_may_be_killed_once_and_everything_is_made(cli, solver, gpu, write_recipes, tmp_path):
    solver.trouble = {"a": "kill once", "b": "kill writer once", "c": "kill drawer once"}
    result = cli("run", write_recipes(*NAMES), *ORDER)
    assert result.exit_code == 0, result.output
    found = runs.records(tmp_path / "out")
    assert {record["status"] for record in found.values()} == {"done"}
    assert sorted(found) == list(NAMES)
    for role in ("simulator", "writer", "drawer"):
        assert f"a {role} process ended (SIGKILL), its recipes are tried again" in result.stderr
    assert sorted(runs.tree(tmp_path / "out")) == sorted([*whole(*NAMES), *(f"{name}.png" for name in NAMES)])
    # Who loses only the process that draws keeps the stage.
    assert sum("c" in names for names in solver.calls) <= 3
    assert sum(names == ["c"] for names in solver.calls) <= 1


@pytest.mark.parametrize(
    "role", ["simulator", *(pytest.param(role, marks=LONG) for role in ("writer", "drawer"))]
)
def test_a_recipe_that_always_kills_is_given_up_and_all_others_are_made(
    role, cli, solver, gpu, write_recipes, tmp_path
):
    solver.trouble = {"b": {"simulator": "kill"}.get(role, f"kill {role}")}
    sheets = () if role == "drawer" else ("--no-preview",)
    result = cli("run", write_recipes(*"abcdefgh"), *ORDER, *sheets)
    assert result.exit_code == 3
    found = runs.records(tmp_path / "out")
    assert {name for name, record in found.items() if record["status"] == "done"} == set("acdefgh")
    assert found["b"]["status"] == "killed"
    assert found["b"]["error"].endswith(f"b.yaml: the {role} process was killed twice (SIGKILL)")
    assert result.stderr.count("process ended (SIGKILL)") <= 6
    if role == "simulator":
        assert [len(names) for names in solver.calls if "b" in names] == [8, 4, 2, 1, 1]
    assert not [file for file in runs.tree(tmp_path / "out") if file.startswith(".")]


@LONG
def test_two_recipes_that_always_kill_the_one_writer_of_the_cpu_are_found(
    cli, solver, write_recipes, tmp_path
):
    solver.trouble = {"a": "kill writer", "b": "kill writer"}
    result = cli("run", write_recipes(*NAMES), *ORDER, "--no-preview", "--jobs", 2)
    assert result.exit_code == 3, result.output
    found = runs.records(tmp_path / "out")
    assert {name: record["status"] for name, record in found.items()} == {
        "a": "killed",
        "b": "killed",
        "c": "done",
        "d": "done",
    }
    assert sorted(runs.tree(tmp_path / "out")) == whole("c", "d")


def killed_in_between(run, folder, moment, role):
    """Kill one worker of a run after some seconds; return whether there was one."""
    process = run.start(folder)
    heard = []
    listener = threading.Thread(target=lambda: heard.append(process.communicate(timeout=runs.PATIENCE)))
    listener.start()
    time.sleep(moment)
    found = runs.workers(process.pid, role)
    if found:
        runs.kill(found[-1])
    listener.join()
    return process, heard[0], bool(found)


@pytest.mark.parametrize(("count", "seed"), [(1, 1), pytest.param(20, 2, marks=LONG)])
@pytest.mark.parametrize("role", ["simulator", "writer"])
def test_a_worker_killed_at_any_moment_changes_nothing(role, count, seed, undisturbed, tmp_path):
    chance = random.Random(seed)
    hits = 0
    for number in range(count):
        folder = tmp_path / str(number)
        folder.mkdir()
        moment = chance.uniform(0.1, undisturbed.seconds)
        process, heard, hit = killed_in_between(undisturbed, folder, moment, role)
        assert process.returncode == 0, (moment, heard)
        assert runs.tree(folder / "out") == undisturbed.tree, moment
        assert runs.all_gone(process.pid)
        hits += hit
    assert hits


def killed_whole(start, folder, moment, ending=signal.SIGKILL):
    process = start(folder)
    time.sleep(moment)
    process.send_signal(ending)
    _, err = process.communicate(timeout=runs.PATIENCE)
    assert runs.all_gone(process.pid), f"workers outlived a run that was killed after {moment:.2f} s"
    return process.returncode, err


@pytest.mark.parametrize(("count", "seed"), [(1, 3), pytest.param(20, 4, marks=LONG)])
def test_a_run_killed_at_any_moment_goes_on_with_the_same_command(count, seed, undisturbed, tmp_path):
    chance = random.Random(seed)
    for number in range(count):
        folder = tmp_path / str(number)
        folder.mkdir()
        moment = chance.uniform(0.2, 1.0) * undisturbed.seconds
        killed_whole(undisturbed.start, folder, moment)
        again = undisturbed.start(folder)
        _, err = again.communicate(timeout=runs.PATIENCE)
        assert again.returncode == 0, err
        assert runs.tree(folder / "out") == undisturbed.tree, moment


@LONG
def test_a_run_of_the_real_solver_killed_at_any_moment_goes_on(tmp_path):
    recipes = write_recipes_into(tmp_path / "recipes", "ab", SHORT_RECIPE)

    def start(folder):
        folder.mkdir(exist_ok=True)
        return runs.start(recipes, *ORDER, "--frames", ":4", "--device", "cpu", cwd=folder)

    def finish(folder):
        process = start(folder)
        _, err = process.communicate(timeout=600)
        assert process.returncode == 0, err
        return runs.tree(folder / "out")

    begin = time.monotonic()
    expected = finish(tmp_path / "first")
    seconds = time.monotonic() - begin
    assert finish(tmp_path / "second") == expected
    chance = random.Random(5)
    for number in range(6):
        folder = tmp_path / str(number)
        killed_whole(start, folder, chance.uniform(0.2, 1.0) * seconds)
        assert finish(folder) == expected


@pytest.mark.parametrize(("count", "seed"), [(1, 6), pytest.param(20, 7, marks=LONG)])
@pytest.mark.parametrize(
    ("ending", "code"), [(signal.SIGINT, 130), pytest.param(signal.SIGTERM, 143, marks=LONG)]
)
def test_a_run_ended_by_hand_at_any_moment_leaves_whole_files_only(
    ending, code, count, seed, undisturbed, tmp_path
):
    chance = random.Random(seed)
    for number in range(count):
        folder = tmp_path / str(number)
        folder.mkdir()
        # Python itself ends without a word until the command has begun.
        moment = chance.uniform(0.4, 0.9) * undisturbed.seconds
        found, err = killed_whole(undisturbed.start, folder, moment, ending)
        left = set(runs.tree(folder / "out")) if (folder / "out").exists() else set()
        assert left <= set(undisturbed.tree), moment
        # A run that is over ends as Python does at that moment.
        assert found in (code, 0) or left == set(undisturbed.tree), err
        assert "Traceback" not in err
