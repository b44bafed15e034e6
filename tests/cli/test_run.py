from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from PIL import Image
from pxr import Usd, UsdGeom

ASSET = [
    "snake/payload/draft.usda",
    "snake/payload/draft_finished.usda",
    "snake/payload/draft_geo.usdc",
    "snake/payload/draft_sim.usdc",
    "snake/payload/draft_stress.usdc",
    "snake/payload/materials.usda",
    "snake/snake.usda",
]
REPORT = ["snake.report.json", "snake.report.png"]
LOOSE = """\
format: 1
name: snake
units: cm
fps: 8
balloons:
  main: {size: 260, length: 9.2, tail: 3}
steps:
  - bubbles: {nose: 4}
  - rest: tail
physics: {hold: 1.5}
"""
BURST = ("pinch: nose", 1.25, "the wall is not finite")


def test_a_recipe_becomes_a_stage_a_contact_sheet_and_a_report(cli, solver, write_recipe, left):
    result = cli("run", write_recipe(), "-o", "out", "--device", "cpu")
    assert result.exit_code == 0, result.output
    assert left() == ["snake.png", *REPORT, *ASSET]
    with Image.open("out/snake.png") as sheet:
        assert sheet.width > 1000
    assert "snake" in result.stdout
    assert "6 frames in" in result.stdout


def test_the_stage_says_what_it_shows(cli, solver, write_recipe):
    cli("run", write_recipe(), "-o", "out", "--no-preview")
    stage = Usd.Stage.Open("out/snake/snake.usda")
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 6)
    root = stage.GetDefaultPrim()
    assert list(root.GetAttribute("balloon_usd:bubbles").Get()) == ["nose", "middle", "tail"]
    (mesh,) = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert mesh.GetName() == "main"
    facts = stage.GetRootLayer().customLayerData["balloon_usd"]
    assert facts["recipe"] == "snake.yaml"
    assert root.GetAttribute("balloon_usd:step").Get(1) == "inflate: main"


def test_a_run_tells_of_older_words_once_a_place_also_where_all_is_there_already(cli, solver, write_recipe):
    text = (
        "format: 1\nname: old\nunits: cm\nballoons: {main: {size: 260, tail: 10}}\n"
        "steps:\n  - bubbles: {a: 10}\n  - push: {bubble: a, depth: 1}\n"
    )
    recipe = write_recipe("old", text=text)
    for _ in range(2):
        result = cli("run", recipe, "-o", "out", "--no-preview", "--no-report")
        assert result.exit_code == 0, result.output
        assert result.stderr.count("old.yaml:7:5: push is called press now: press: {...}\n") == 1
    assert "already there and whole" in result.stderr


def test_no_preview_draws_none(cli, solver, write_recipe, left):
    assert cli("run", write_recipe(), "-o", "out", "--no-preview").exit_code == 0
    assert left() == [*REPORT, *ASSET]


def test_no_report_writes_none(cli, solver, write_recipe, left):
    result = cli("run", write_recipe(), "-o", "out", "--no-report", "--no-preview")
    assert result.exit_code == 0
    assert left() == ASSET
    assert "report" not in result.stdout


def test_a_run_tells_what_came_undone_and_makes_the_stage(cli, solver, write_recipe, left):
    solver.trouble = {"snake": "undone"}
    recipe = write_recipe()
    with Path(recipe).open("a", encoding="utf-8") as file:
        file.write("must_hold: planned\n")
    result = cli("run", recipe, "-o", "out", "--no-preview")
    assert result.exit_code == 0
    assert "snake.yaml: caution: step 1: the twist between nose and middle will unwind" in result.stderr
    assert left() == [*REPORT, *ASSET]
    assert "snake: came undone: nose.end, middle.end: lock them, with 2 turns or more" in result.stdout
    undone = json.loads(Path("out/snake.report.json").read_text(encoding="utf-8"))["undone"]
    assert [(entry["joint"], entry["time_code"]) for entry in undone] == [("nose.end", 1), ("middle.end", 1)]


def test_a_real_twist_that_may_come_undone_unwinds_and_is_no_failure(cli, write_recipe, left):
    text = f"{LOOSE}must_hold: planned\n"
    result = cli("run", write_recipe(text=text), "-o", "out", "--no-preview", "--flat", "--device", "cpu")
    assert result.exit_code == 0, result.output
    assert "snake.yaml: caution: step 1: the twist between nose and tail will unwind" in result.stderr
    assert "snake: came undone: nose.end" in result.stdout
    assert left() == [*REPORT, "snake.usdc"]
    (undone,) = json.loads(Path("out/snake.report.json").read_text(encoding="utf-8"))["undone"]
    assert undone["joint"] == "nose.end"


def test_a_run_fails_where_a_joint_comes_undone_that_must_hold(cli, write_recipe, left):
    result = cli(
        "run",
        write_recipe(text=LOOSE),
        "-o",
        "out",
        "--no-preview",
        "--flat",
        "--device",
        "cpu",
    )
    assert result.exit_code == 3
    told = r"snake.yaml: simulation failed at .* hold: nose.end came undone at \d+\.\d s, and must hold: lock twists, wind locks"
    assert re.search(told, result.stderr)
    assert "snake.failed.usdc" in left()
    assert "snake.usdc" not in left()


def test_a_run_does_not_fail_where_another_joint_comes_undone(cli, solver, write_recipe, left):
    solver.trouble = {"snake": "undone"}
    recipe = write_recipe()
    text = Path(recipe).read_text(encoding="utf-8")
    for wanted, code in (("none", 0), ("[tail.end]", 2), ("[middle.end]", 3)):
        Path(recipe).write_text(f"{text}must_hold: {wanted}\n", encoding="utf-8")
        assert cli("run", recipe, "-o", "out", "--no-preview").exit_code == code


def test_a_report_says_what_every_bubble_did(cli, solver, write_recipe):
    result = cli("run", write_recipe(), "-o", "out", "--no-preview", "--detail", "preview")
    assert "report out/snake.report.json" in result.stdout
    report = json.loads(Path("out/snake.report.json").read_text(encoding="utf-8"))
    assert (report["name"], report["recipe"], report["detail"]) == ("snake", "snake.yaml", "preview")
    assert report["solver"] == "latex 35"
    assert report["time_code"] == [1, 2, 3, 4, 5, 6]
    assert [bubble["name"] for bubble in report["bubbles"]] == ["nose", "middle", "tail"]
    assert report["bubbles"][1]["pressure"] == [1000.0] * 6
    with Image.open("out/snake.report.png") as figure:
        assert figure.width > 1000


def test_a_report_shows_the_frames_that_were_written(cli, solver, write_recipe):
    cli("run", write_recipe(), "-o", "out", "--frames", "2:4", "--no-preview", "--flat")
    assert json.loads(Path("out/snake.report.json").read_text())["time_code"] == [2, 3, 4]


def test_every_sculpture_of_a_batch_has_its_report(cli, solver, write_recipe, left):
    cli("run", write_recipe("one"), write_recipe("two", fps=30), "-o", "out", "--no-preview", "--flat")
    assert [file for file in left() if file.endswith("report.json")] == ["one.report.json", "two.report.json"]


def test_a_report_that_cannot_be_written_has_its_own_exit_code(cli, solver, write_recipe, left, monkeypatch):
    monkeypatch.setenv("FAKE_FULL_DISK", "snake.report.json")
    result = cli("run", write_recipe(), "-o", "out", "--no-preview")
    assert result.exit_code == 1
    assert "snake.report.json cannot be written: No space left on device" in result.stderr
    assert left() == ASSET


@pytest.mark.parametrize("name", ["snake.report.json", "snake.report.png", "snake.png"])
def test_a_folder_where_a_file_must_go_is_named_before_the_simulation(
    cli, solver, write_recipe, tmp_path, name
):
    (tmp_path / "out" / name).mkdir(parents=True)
    result = cli("run", write_recipe(), "-o", "out")
    assert result.exit_code == 2
    assert f"{name}: a folder is in the way" in result.stderr
    assert solver.calls == []


def test_flat_writes_one_file(cli, solver, write_recipe, left):
    assert cli("run", write_recipe(), "-o", "out", "--flat").exit_code == 0
    assert left() == ["snake.png", *REPORT, "snake.usdc"]


def test_without_an_output_folder_files_go_here(cli, solver, write_recipe, tmp_path):
    assert cli("run", write_recipe(), "--no-preview").exit_code == 0
    assert (tmp_path / "snake" / "snake.usda").is_file()


def test_many_recipes_and_folders_advance_together(cli, solver, write_recipe, left):
    one = write_recipe("one")
    write_recipe("two", "more/two.yaml")
    write_recipe("three", "more/three.yml")
    result = cli("run", one, "more", "-o", "out", "--no-preview")
    assert result.exit_code == 0, result.output
    assert sorted(solver.calls) == [["one"], ["three"], ["two"]]
    assert [file for file in left() if file.count("/") == 1] == [
        "one/one.usda",
        "three/three.usda",
        "two/two.usda",
    ]
    assert "18 frames in" in result.stdout


def test_recipes_of_another_frame_rate_advance_on_their_own(cli, solver, write_recipe):
    result = cli("run", write_recipe("one"), write_recipe("two", fps=30), "-o", "out", "--no-preview")
    assert result.exit_code == 0, result.output
    assert sorted(solver.calls) == [["one"], ["two"]]


def test_a_file_named_twice_is_made_once(cli, solver, write_recipe, tmp_path):
    write_recipe()
    assert cli("run", "snake.yaml", tmp_path / "snake.yaml", ".", "-o", "out", "--no-preview").exit_code == 0
    assert solver.calls == [["snake"]]


def test_broken_recipes_are_listed_with_all_problems_and_the_rest_is_made(cli, solver, write_recipe, left):
    write_recipe("good")
    broken = write_recipe("broken", text="format: 1\nname: broken\nballoons: {}\nstops: []\n")
    result = cli("run", "good.yaml", broken, "missing.yaml", "-o", "out", "--no-preview", "--flat")
    assert result.exit_code == 2
    lines = result.stderr.splitlines()
    assert sum(line.startswith(f"{broken}:") for line in lines) >= 2
    assert any(line.startswith("missing.yaml:") for line in lines)
    assert not any("good.yaml" in line and "caution" not in line for line in lines)
    assert left() == ["good.report.json", "good.report.png", "good.usdc"]
    assert "1 made, 2 refused" in result.stdout


def test_nothing_is_left_where_all_recipes_are_broken(cli, solver, write_recipe, tmp_path):
    assert cli("run", write_recipe(text="format: 1\n"), "-o", "out").exit_code == 2
    assert not (tmp_path / "out").exists()
    assert solver.calls == []


def test_the_second_of_two_recipes_of_one_name_is_refused(cli, solver, write_recipe, left):
    first, second = write_recipe("snake"), write_recipe("Snake", "other.yaml")
    result = cli("run", first, second, "-o", "out", "--no-preview", "--flat")
    assert result.exit_code == 2
    assert f'{second}: name: "Snake" is taken by {first}' in result.stderr
    assert left() == [*REPORT, "snake.usdc"]


def test_a_folder_without_recipes_is_refused(cli, solver, tmp_path):
    (tmp_path / "empty").mkdir()
    result = cli("run", "empty")
    assert result.exit_code == 2
    assert "empty: no recipes" in result.stderr


def test_an_output_folder_that_cannot_be_written_is_refused_before_the_simulation(cli, solver, write_recipe):
    recipe = write_recipe()
    result = cli("run", recipe, "-o", recipe / "below")
    assert result.exit_code == 2
    assert "cannot write here" in result.stderr
    assert solver.calls == []


@pytest.mark.parametrize("flat", [True, False])
def test_what_is_in_the_way_is_named_before_the_simulation(cli, solver, write_recipe, tmp_path, flat):
    if flat:
        (tmp_path / "out" / "snake.usdc").mkdir(parents=True)
    else:
        (tmp_path / "out").mkdir()
        (tmp_path / "out" / "snake").write_text("mine")
    result = cli("run", write_recipe(), "-o", "out", *(["--flat"] if flat else []))
    assert result.exit_code == 2
    assert "is in the way" in result.stderr
    assert solver.calls == []


def test_a_range_of_frames_is_written_and_nothing_is_simulated_beyond_it(cli, solver, write_recipe):
    assert cli("run", write_recipe(), "-o", "out", "--frames", "2:4", "--no-preview").exit_code == 0
    stage = Usd.Stage.Open("out/snake/snake.usda")
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (2, 4)
    (mesh,) = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert UsdGeom.Mesh(mesh).GetPointsAttr().GetTimeSamples() == [2, 3, 4]
    assert solver.given == [4]


@pytest.mark.parametrize(
    ("frames", "words"),
    [
        ("7:9", "the animation has frames 1 to 6"),
        ("4:2", "begins after its end"),
        ("0:2", "is no range of frames"),
        (":", "is no range of frames"),
        ("x", "is no range of frames"),
    ],
)
def test_a_range_that_makes_no_sense_is_refused(cli, solver, write_recipe, left, frames, words):
    result = cli("run", write_recipe(), "-o", "out", "--frames", frames)
    assert result.exit_code == 2
    assert words in result.stderr
    assert left() == []


def test_a_failed_simulation_says_when_and_why_and_leaves_nothing_under_the_final_name(
    cli, solver, write_recipe, left
):
    solver.trouble = {"snake": BURST}
    result = cli("run", write_recipe(), "-o", "out")
    assert result.exit_code == 3
    assert "simulation failed at 1.25 s, pinch: nose: the wall is not finite" in result.stderr
    assert "stage out/snake.failed/snake.failed.usda" in result.stdout
    assert "contact sheet out/snake.failed.png" in result.stdout
    assert left()
    assert all(file.startswith("snake.failed") for file in left())


def test_one_failed_sculpture_does_not_take_the_others_along(cli, solver, write_recipe, left):
    solver.trouble = {"bad": BURST}
    result = cli("run", write_recipe("bad"), write_recipe("snake"), "-o", "out", "--no-preview")
    assert result.exit_code == 3
    assert [file for file in left() if not file.startswith("bad.failed")] == [*REPORT, *ASSET]
    assert "bad.yaml: simulation failed" in result.stderr
    assert "failed" in result.stdout


def test_an_interrupted_run_leaves_nothing(cli, solver, write_recipe, left, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("balloon_usd.cli.progress._Bar.advance", interrupt)
    result = cli("run", write_recipe(), write_recipe("two"), "-o", "out")
    assert result.exit_code == 130
    assert result.stderr.splitlines()[-1] == "interrupted, nothing half-written is left"
    assert left() == []


def test_an_unforeseen_error_leaves_nothing_and_takes_no_other_recipe_along(cli, solver, write_recipe, left):
    solver.trouble = {"bad": ZeroDivisionError("what?")}
    result = cli("run", write_recipe("bad"), write_recipe(), "-o", "out", "--no-preview", "--flat")
    assert result.exit_code == 1
    assert "ZeroDivisionError: what?" in result.stderr
    assert left() == [*REPORT, "snake.usdc"]


def test_a_stage_that_cannot_be_written_takes_no_other_recipe_along(
    cli, solver, write_recipe, left, monkeypatch
):
    monkeypatch.setenv("FAKE_FULL_DISK", "bad.usdc")
    result = cli("run", write_recipe("bad"), write_recipe(), "-o", "out", "--no-preview", "--flat")
    assert result.exit_code == 1
    assert "bad.yaml: out/bad.usdc could not be written: No space left on device" in result.stderr
    assert left() == [*REPORT, "snake.usdc"]


def test_a_device_that_is_not_there_is_refused_with_those_that_are(cli, solver, write_recipe):
    result = cli("run", write_recipe(), "-o", "out", "--device", "cuda:99")
    assert result.exit_code == 2
    assert 'there is no device "cuda:99", only cpu' in result.stderr
    assert solver.calls == []


def test_a_word_that_is_no_device_is_refused(cli, solver, write_recipe):
    result = cli("run", write_recipe(), "--device", "gpu")
    assert result.exit_code == 2
    assert "expected auto, cpu, cuda or cuda:N, several with commas, or all" in result.stderr


def test_cautions_are_told_and_do_not_stop_the_run(cli, solver, write_recipe):
    text = """\
format: 1
name: snake
units: cm
balloons: {main: {size: 260, tail: 2}}
steps:
  - bubbles: {a: 8, b: 8, c: 8, d: 8, e: 8}
  - rest: tail
"""
    result = cli("run", write_recipe(text=text), "-o", "out", "--no-preview")
    assert result.exit_code == 0, result.output
    assert "snake.yaml: caution: " in result.stderr
