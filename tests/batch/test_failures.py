"""Simulations that fail: the frames before that are kept under a name of their own."""

from __future__ import annotations

import json
import random
import time
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from tests.batch import runs
from tests.batch.conftest import write_recipes_into
from tests.batch.test_kills import LONG, killed_whole
from tests.command_line import pretend_solver

TEAR = ("pinch: nose", 0.08, "the wall is torn", 3)
CAUSE = "at 0.08 s (frame 3), pinch: nose: the wall is torn"
REPORT = ["snake.failed.report.json", "snake.failed.report.png"]
LAYERS = [
    "snake.failed/payload/draft.usda",
    "snake.failed/payload/draft_finished.usda",
    "snake.failed/payload/draft_geo.usdc",
    "snake.failed/payload/draft_sim.usdc",
    "snake.failed/payload/draft_stress.usdc",
    "snake.failed/payload/materials.usda",
    "snake.failed/snake.failed.usda",
]
ONLY_STAGE = ("-o", "out", "--no-preview", "--no-report")


@pytest.fixture
def fails(solver):
    """The recipe "snake" fails in frame 3."""
    solver.trouble = {"snake": TEAR}


def facts_of(stage):
    return stage.GetRootLayer().customLayerData["balloon_usd"]


def test_a_simulation_that_fails_leaves_all_frames_before_that(cli, fails, write_recipe, left):
    result = cli("run", write_recipe(), "-o", "out")
    assert result.exit_code == 3
    assert left() == ["snake.failed.png", *REPORT, *LAYERS]
    opened = "out/snake.failed/snake.failed.usda"
    last = result.stderr.splitlines()[-1]
    assert last.endswith(f"snake.yaml: simulation failed {CAUSE}; the 2 frames before are in {opened}")
    stage = Usd.Stage.Open(opened)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 2)
    (mesh,) = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert UsdGeom.Mesh(mesh).GetPointsAttr().GetTimeSamples() == [1, 2]
    assert stage.GetDefaultPrim().GetName() == "snake"
    facts = facts_of(stage)
    assert (facts["failed"], facts["last_good_frame"], facts["recipe"]) == (CAUSE, 2, "snake.yaml")
    report = json.loads(Path("out/snake.failed.report.json").read_text(encoding="utf-8"))
    assert report["failed"] == {"cause": CAUSE, "last_good_frame": 2, "time": round(1 / 24, 6)}
    assert report["time_code"] == [1, 2]
    record = runs.records(Path("out"))["snake"]
    assert (record["status"], record["frames"]) == ("simulation failed", 2)
    assert sorted(record["files"]) == left()


@pytest.mark.parametrize(
    ("form", "files"),
    [
        pytest.param(("--flat",), ["snake.failed.usdc"], marks=LONG),
        (("--usdz",), ["snake.failed.usdz"]),
        pytest.param(("--flat", "--shot"), ["snake.failed.usdc", "snake.failed_shot.usda"], marks=LONG),
        (("--shot", "--look", "stress"), ["snake.failed/snake.failed.usda", "snake.failed_shot.usda"]),
    ],
)
def test_what_a_failure_leaves_has_the_form_that_was_asked_for(form, files, cli, fails, write_recipe, left):
    assert cli("run", write_recipe(), *ONLY_STAGE, *form).exit_code == 3
    assert [file for file in left() if "payload" not in file] == files
    for file in files:
        checked = cli("check", "--no-nvidia", f"out/{file}")
        assert checked.exit_code == 0, checked.output
    stage = Usd.Stage.Open(f"out/{files[0]}")
    facts = facts_of(stage)
    assert (facts["failed"], facts["last_good_frame"]) == (CAUSE, 2)
    assert stage.GetDefaultPrim().GetAssetInfo()["identifier"].path == f"./{Path(files[0]).name}"


def test_a_failure_before_the_first_frame_that_is_written_leaves_nothing(cli, fails, write_recipe, left):
    result = cli("run", write_recipe(), "-o", "out", "--frames", "3:")
    assert result.exit_code == 3
    assert result.stderr.splitlines()[-1].endswith(f"snake.yaml: simulation failed {CAUSE}")
    assert left() == []


def test_a_range_that_is_over_before_the_failure_is_made(cli, fails, write_recipe, left):
    assert cli("run", write_recipe(), *ONLY_STAGE, "--flat", "--frames", ":2").exit_code == 0
    assert left() == ["snake.usdc"]


@pytest.mark.parametrize("form", [pytest.param((), marks=LONG), ("--flat",)])
def test_an_earlier_stage_stays_as_it_was_when_the_recipe_fails(form, cli, solver, write_recipe, tmp_path):
    recipe = write_recipe()
    assert cli("run", recipe, "-o", "out", *form).exit_code == 0
    before = runs.tree(tmp_path / "out")
    recipe.write_text(recipe.read_text() + "# changed\n")
    solver.trouble = {"snake": TEAR}
    result = cli("run", recipe, "-o", "out", *form)
    assert result.exit_code == 3
    stage = "out/snake.usdc" if form else "out/snake/snake.usda"
    assert result.stderr.splitlines()[-1].endswith(f"; {stage} stays as an earlier run made it")
    after = runs.tree(tmp_path / "out")
    assert [record["status"] for record in after.pop("batch.jsonl")] == ["done", "simulation failed"]
    kept = {name: content for name, content in after.items() if not name.startswith("snake.failed")}
    assert kept == {name: content for name, content in before.items() if name != "batch.jsonl"}


def test_a_failed_recipe_is_tried_again_and_what_it_left_goes_once_it_is_made(
    cli, solver, fails, write_recipe, left
):
    recipe = write_recipe()
    cli("run", recipe, "-o", "out", "--shot")
    first = left()
    assert cli("run", recipe, "-o", "out", "--shot").exit_code == 3, "it is tried again"
    assert left() == first
    # In another form: what the last failure has left is all that there is.
    cli("run", recipe, *ONLY_STAGE, "--flat")
    assert left() == ["snake.failed.usdc"]
    cli("run", recipe, *ONLY_STAGE)
    solver.trouble = {}
    assert cli("run", recipe, *ONLY_STAGE, "--flat").exit_code == 0
    assert left() == ["snake.usdc"]
    assert len(solver.calls) == 5


def test_a_folder_of_that_name_that_is_no_stage_is_left_alone(cli, solver, write_recipe, tmp_path, left):
    (tmp_path / "out" / "snake.failed").mkdir(parents=True)
    (tmp_path / "out" / "snake.failed" / "notes.txt").write_text("mine")
    assert cli("run", write_recipe(), *ONLY_STAGE, "--flat").exit_code == 0
    assert left() == ["snake.failed/notes.txt", "snake.usdc"]


def test_frames_that_find_no_room_on_the_disk_are_told_beside_the_failure(
    cli, fails, write_recipe, left, monkeypatch
):
    monkeypatch.setenv("FAKE_FULL_DISK", "snake.failed.usdc")
    result = cli("run", write_recipe(), "-o", "out", "--flat")
    assert result.exit_code == 3
    full = "out/snake.failed.usdc could not be written: No space left on device"
    assert f"simulation failed {CAUSE}; the frames before that are not kept: {full}" in result.stderr
    assert left() == []


def test_a_contact_sheet_that_cannot_be_drawn_leaves_the_failure_a_failure(
    cli, fails, write_recipe, left, tmp_path
):
    (tmp_path / "out" / "snake.failed.png").mkdir(parents=True)
    result = cli("run", write_recipe(), "-o", "out", "--flat", "--no-report")
    assert result.exit_code == 3
    assert f"simulation failed {CAUSE}; the 2 frames before are in out/snake.failed.usdc; " in result.stderr
    assert "snake.failed.png" in result.stderr
    assert left() == ["snake.failed.usdc"]


def test_others_of_the_batch_are_made_whatever_befalls_it(cli, solver, gpu, write_recipes, tmp_path):
    solver.trouble = {"a": "kill once", "b": TEAR, "c": "kill writer once"}
    result = cli("run", write_recipes(*"abcd"), *ONLY_STAGE, "--flat")
    assert result.exit_code == 3, result.output
    found = {name: record["status"] for name, record in runs.records(tmp_path / "out").items()}
    assert found == {"a": "done", "b": "simulation failed", "c": "done", "d": "done"}
    names = ["a.usdc", "b.failed.usdc", "batch.jsonl", "c.usdc", "d.usdc"]
    assert sorted(runs.tree(tmp_path / "out")) == names


@pytest.mark.parametrize(("count", "seed"), [(1, 8), pytest.param(20, 9, marks=LONG)])
def test_a_run_with_a_failure_killed_at_any_moment_goes_on_to_the_same_files(
    count, seed, tmp_path, monkeypatch
):
    recipes = write_recipes_into(tmp_path / "recipes", "ab")
    solver = pretend_solver(monkeypatch, tmp_path / "solver")
    solver.trouble = {"b": TEAR}

    def start(folder):
        folder.mkdir(exist_ok=True)
        return runs.start(recipes, "-o", "out", "--flat", cwd=folder)

    def finish(folder):
        process = start(folder)
        _, err = process.communicate(timeout=runs.PATIENCE)
        assert process.returncode == 3, err
        return runs.tree(folder / "out")

    begin = time.monotonic()
    expected = finish(tmp_path / "undisturbed")
    seconds = time.monotonic() - begin
    assert "b.failed.usdc" in expected
    assert "b.failed.png" in expected
    chance = random.Random(seed)
    for number in range(count):
        folder = tmp_path / str(number)
        moment = chance.uniform(0.2, 1.0) * seconds
        killed_whole(start, folder, moment)
        assert finish(folder) == expected, moment
