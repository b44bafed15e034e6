from __future__ import annotations

import json
from pathlib import Path

import pytest

COMMANDS = ["run", "plan", "schema", "preview", "bench"]


@pytest.mark.parametrize("command", [[], *([command] for command in COMMANDS)])
def test_every_help_page_documents_the_exit_codes(cli, command):
    result = cli(*command, "--help")
    assert result.exit_code == 0
    for code in ("0    done", "1    a result", "2    bad input", "3    the simulation", "130  interrupted"):
        assert code in result.stdout


def test_an_unknown_option_is_bad_input(cli):
    result = cli("run", "x.yaml", "--detial", "full")
    assert result.exit_code == 2
    assert "--detail" in result.stderr


def test_plan_shows_lengths_and_tail(cli, write_recipe):
    result = cli("plan", write_recipe())
    assert result.exit_code == 0
    assert "nose" in result.stdout
    assert "of flat tail" in result.stdout


def test_plan_prints_one_json_object_a_recipe(cli, write_recipe):
    result = cli("plan", write_recipe("one"), write_recipe("two"), "--json")
    assert [json.loads(line)["name"] for line in result.stdout.splitlines()] == ["one", "two"]


def test_older_words_are_told_once_a_place_and_the_exit_code_stays_0(cli, write_recipe):
    text = (
        "format: 1\nname: old\nunits: cm\nballoons: {main: {size: 260, tail: 10}}\n"
        "steps:\n  - bubbles: {a: 10}\n  - push: {bubble: a, depth: 1}\n  - push: {bubble: a, depth: 2}\n"
    )
    result = cli("plan", write_recipe("old", text=text), "--json")
    assert result.exit_code == 0
    told = [line.partition("old.yaml:")[2] for line in result.stderr.splitlines()]
    assert told == [f"{line}:5: push is called press now: press: {{...}}" for line in (7, 8)]
    notices = json.loads(result.stdout)["notices"]
    assert [(notice["line"], notice["column"]) for notice in notices] == [(7, 5), (8, 5)]


def test_plan_draws_an_svg(cli, write_recipe, tmp_path):
    assert cli("plan", write_recipe(), "--svg", "snake.svg").exit_code == 0
    assert "<svg" in (tmp_path / "snake.svg").read_text(encoding="utf-8")


def test_plan_draws_only_one_recipe(cli, write_recipe):
    result = cli("plan", write_recipe("one"), write_recipe("two"), "--svg", "both.svg")
    assert result.exit_code == 2
    assert "one recipe, not 2" in result.stderr


def test_a_drawing_that_cannot_be_written_has_its_own_exit_code(cli, write_recipe):
    result = cli("plan", write_recipe(), "--svg", "missing/snake.svg")
    assert result.exit_code == 1
    assert "cannot be written" in result.stderr


def test_plan_refuses_what_no_balloon_can_give(cli, write_recipe):
    text = (
        "format: 1\nname: long\nunits: cm\nballoons: {main: {size: 260, tail: 10}}\n"
        "steps:\n  - bubbles: {a: 100, b: 100}\n"
    )
    result = cli("plan", write_recipe("long", text=text))
    assert result.exit_code == 2
    assert "long.yaml:" in result.stderr


def test_schema_prints_a_json_schema_of_recipes(cli):
    schema = json.loads(cli("schema").stdout)
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert "steps" in schema["properties"]


def test_preview_draws_a_stage_and_puts_the_sheet_beside_it(cli, solver, write_recipe, left):
    cli("run", write_recipe(), "-o", "out", "--no-preview")
    result = cli("preview", "out/snake", "--size", 48, 32, "--columns", 2)
    assert result.exit_code == 0, result.output
    assert "snake.png" in left()


def test_preview_draws_the_frames_that_are_asked_for(cli, solver, write_recipe, left):
    cli("run", write_recipe(), "-o", "out", "--flat", "--no-preview", "--no-report")
    for frames in ("1,3,6", "2:4"):
        result = cli("preview", "out/snake.usdc", "-o", "out/a.png", "--frames", frames, "--size", 48, 32)
        assert result.exit_code == 0, result.output
    assert left() == ["a.png", "snake.usdc"]


@pytest.mark.parametrize("frames", ["1,99", "50:60", "one", "5:2"])
def test_preview_refuses_frames_that_are_not_there(cli, solver, write_recipe, frames):
    cli("run", write_recipe(), "-o", "out", "--flat", "--no-preview")
    result = cli("preview", "out/snake.usdc", "--frames", frames)
    assert result.exit_code == 2
    assert result.stderr


@pytest.mark.parametrize("frames", [[], ["--frames", "1:2"]])
def test_preview_refuses_what_is_no_stage(cli, write_recipe, frames):
    result = cli("preview", write_recipe(), *frames)
    assert result.exit_code == 2
    assert "is not a USD file" in result.stderr


def test_bench_measures_several_batches(cli, solver):
    result = cli("bench", "--copies", 1, "--copies", 3, "--frames", 4, "--device", "cpu")
    assert result.exit_code == 0, result.output
    rows = [line.split() for line in result.stdout.splitlines()[2:]]
    assert [row[:2] for row in rows] == [["dog", "1"], ["dog", "3"]]
    assert [row[6] for row in rows] == ["2", "2"]
    assert int(rows[1][2]) == 3 * int(rows[0][2])


def test_bench_measures_the_experiment_of_the_thesis_up_to_a_whole_balloon(cli, solver):
    result = cli("bench", "--model", "kosaka", "--frames", 4, "--device", "cpu")
    assert result.exit_code == 0, result.output
    rows = [line.split() for line in result.stdout.splitlines()[2:]]
    assert [row[0] for row in rows] == ["20", "40", "80", "150"]
    assert rows[0][3] == "1602"


def test_plan_shows_what_is_made_after_a_step(cli, write_recipe):
    result = cli("plan", write_recipe(), "--step", "1")
    assert result.exit_code == 0
    assert "after step 1 of" in result.stdout
    assert "left: " in result.stdout


def test_a_step_beyond_the_last_is_refused_before_anything_is_told(cli, write_recipe):
    result = cli("plan", write_recipe(), "--step", "99")
    assert result.exit_code == 2
    assert "has no step 99, expected 1 to " in result.stderr
    assert result.stdout == ""


@pytest.mark.parametrize("words", [("plan", "--svg"), ("farm-template", "-o")])
def test_no_recipe_is_replaced_by_what_is_made_of_it(cli, write_recipe, words):
    recipe = write_recipe()
    before = Path(recipe).read_text(encoding="utf-8")
    command, option = words
    result = cli(command, recipe, option, recipe)
    assert result.exit_code == 2
    assert "expected" in result.stderr
    assert Path(recipe).read_text(encoding="utf-8") == before


def test_a_drawing_that_cannot_be_written_whole_leaves_the_one_before(
    cli, write_recipe, tmp_path, monkeypatch
):
    (tmp_path / "snake.svg").write_text("before")

    def fails(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", fails)
    result = cli("plan", write_recipe(), "--svg", "snake.svg")
    assert result.exit_code == 1
    assert (tmp_path / "snake.svg").read_text() == "before"
    assert sorted(file.name for file in tmp_path.glob(".snake*")) == []


@pytest.mark.parametrize("name", ["stage.usda", "sheet.jpg"])
def test_a_contact_sheet_is_called_as_what_it_is(cli, name):
    result = cli("preview", "stage.usda", "-o", name)
    assert result.exit_code == 2
    assert result.stderr == f"{name}: expected a name that ends in .png\n"
