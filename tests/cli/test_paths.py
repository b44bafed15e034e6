"""Paths that lead nowhere: one clear line and the right exit code, never a traceback."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

LONG = "x" * 300
NO_TEXT = os.fsdecode(b"\xff\xfe")


def refused(result, words, code=2):
    """The command ended with this code and one line with these words."""
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    (line,) = result.stderr.splitlines()
    assert words in line


@pytest.mark.parametrize("command", ["run", "plan"])
def test_a_recipe_behind_links_that_lead_in_a_circle_is_refused(cli, tmp_path, command):
    (tmp_path / "a.yaml").symlink_to("b.yaml")
    (tmp_path / "b.yaml").symlink_to("a.yaml")
    refused(cli(command, "a.yaml"), "a.yaml:1:1: cannot be read (Too many levels of symbolic links)")


@pytest.mark.parametrize("command", ["run", "plan"])
def test_a_recipe_with_too_long_a_name_is_refused(cli, command):
    refused(cli(command, f"{LONG}.yaml"), "cannot be read (File name too long)")


def test_an_output_folder_with_too_long_a_name_is_refused(cli, solver, write_recipe):
    refused(cli("run", write_recipe(), "-o", LONG), "cannot write here (File name too long)")
    assert solver.calls == []


def test_an_output_folder_behind_links_that_lead_in_a_circle_is_refused(cli, solver, write_recipe, tmp_path):
    (tmp_path / "loop").symlink_to("loop")
    refused(cli("run", write_recipe(), "-o", "loop/out"), "cannot write here")


def test_an_output_folder_whose_name_is_no_text_is_refused(cli, solver, write_recipe, tmp_path):
    recipe = write_recipe()
    refused(cli("run", recipe, "-o", NO_TEXT), r"\udcff\udcfe: the path is not UTF-8, which USD needs")
    assert [path.name for path in tmp_path.iterdir()] == [recipe.name]


def test_a_recipe_whose_name_is_no_text_is_made(cli, solver, write_recipe):
    recipe = write_recipe(file=f"{NO_TEXT}.yaml")
    result = cli("run", recipe, "-o", "out", "--no-preview")
    assert result.exit_code == 0, result.output
    report = json.loads(Path("out/snake.report.json").read_text(encoding="utf-8"))
    assert report["recipe"].endswith(".yaml")


@pytest.mark.parametrize("stage", [f"{LONG}.usda", os.fsdecode(b"\xff.usda")])
@pytest.mark.parametrize("output", [[], ["-o", "sheet.png"]])
def test_a_stage_with_an_impossible_name_is_refused(cli, stage, output):
    refused(cli("preview", stage, *output), "")


def test_a_kernel_cache_that_cannot_be_made_is_told_with_the_remedy(cli, solver, write_recipe, monkeypatch):
    recipe = write_recipe()
    monkeypatch.setenv("WARP_CACHE_PATH", str(recipe / "below"))
    result = cli("run", recipe, "-o", "out")
    refused(result, "compiled kernels cannot be kept here (Not a directory), set WARP_CACHE")


def test_a_kernel_cache_that_cannot_be_written_is_told_when_kernels_are_compiled(
    cli, solver, write_recipe, monkeypatch, tmp_path
):
    monkeypatch.setenv("WARP_CACHE_PATH", str(tmp_path / "cache"))
    denied = str(tmp_path / "cache" / "1.19.0" / "wp_x")
    solver.trouble = {"snake": PermissionError(13, "Permission denied", denied)}
    result = cli("run", write_recipe(), "-o", "out", "--no-preview")
    assert result.exit_code == 2
    assert result.stderr.splitlines()[-1].startswith(f"{denied}: compiled kernels cannot be kept")


def test_another_failure_of_the_system_is_not_taken_for_it(cli, solver, write_recipe):
    solver.trouble = {"snake": PermissionError(13, "Permission denied", "/elsewhere")}
    result = cli("run", write_recipe(), "-o", "out")
    assert result.exit_code == 1
    assert "PermissionError: [Errno 13] Permission denied: '/elsewhere'" in result.stderr
