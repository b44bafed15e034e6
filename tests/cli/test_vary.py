from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import balloon_usd
from tests import interruptible

ROOT = Path(balloon_usd.__file__).parents[1]


def refused(result, code=2):
    """The lines with which a command ends."""
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    return result.stderr.splitlines()


def test_a_sweep_can_be_planned_as_it_is_written(cli, write_recipe, left):
    write_recipe()
    words = ["--set", "balloons.main.color=red,blue", "--set", "balloons.main.tail=20..22/2"]
    result = cli("vary", "snake.yaml", *words, "-o", "out")
    assert result.exit_code == 0, result.output
    assert result.stdout == (
        "snake.yaml: 4 of 4 variations written to out: snake_red_20.yaml to snake_blue_22.yaml\n"
    )
    assert len(left()) == 4
    planned = cli("plan", "out")
    assert planned.exit_code == 0
    assert planned.stdout.count("A small snake (snake_") == 4


def test_a_crowd_is_run_as_it_is_written(cli, solver, write_recipe, left):
    write_recipe()
    result = cli(
        "vary", "snake.yaml", "--set", "balloons.main.tail=18..22", "--random", 3, "--seed", 7, "-o", "crowd"
    )
    assert result.exit_code == 0, result.output
    assert left("crowd") == ["snake_1.yaml", "snake_2.yaml", "snake_3.yaml"]
    assert cli("run", "crowd", "-o", "out", "--no-preview", "--no-report", "--flat").exit_code == 0
    assert left() == ["snake_1.usdc", "snake_2.usdc", "snake_3.usdc"]


def test_what_is_left_out_is_told_with_its_reason(cli, write_recipe, left):
    write_recipe()
    result = cli(
        "vary", "snake.yaml", "--set", "balloons.main.tail=20,80,90", "--set", "fps=8,300", "-o", "out"
    )
    assert result.exit_code == 0, result.output
    first, *reasons = result.stdout.splitlines()
    assert first == "snake.yaml: 1 of 6 variations written to out: snake_20_8.yaml"
    assert reasons[0].startswith(
        "3 left out, such as snake_20_300 (balloons.main.tail 20, fps 300): fps: 300 is out"
    )
    assert reasons[1].startswith(
        "2 left out, such as snake_80_8 (balloons.main.tail 80, fps 8): balloons.main.tail: "
    )
    assert left() == ["snake_20_8.yaml"]


def test_where_nothing_can_be_made_the_command_fails_and_writes_nothing(cli, write_recipe, left):
    write_recipe()
    lines = refused(cli("vary", "snake.yaml", "--set", "balloons.main.tail=80,90", "-o", "out"))
    assert lines[0] == "snake.yaml: none of 2 variations can be made, nothing is written"
    assert len(lines) == 2
    assert left("") == ["snake.yaml"]


def test_all_problems_are_told_one_a_line(cli, write_recipe, left):
    write_recipe()
    words = ["--set", "balloons.man.tail=14..8/2", "--set", "fps", "--set", "steps.9=1", "--seed", 1]
    assert refused(cli("vary", "snake.yaml", *words, "-o", "snake.yaml")) == [
        "balloons.man.tail: 14..8/2 goes down, expected the lower end first",
        'balloons.man.tail: unknown balloon "man", did you mean "main"?',
        "fps: no value, expected some such as red,blue or a range such as 8..14/2",
        "steps.9: steps has no place 9, expected 0 to 1",
        "a seed chooses among random variations, expected their number, too: --random N",
        "snake.yaml: a file is in the way of the folder",
    ]
    assert left("") == ["snake.yaml"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["missing.yaml", "-o", "out"], "missing.yaml:1:1: cannot be read (No such file or directory), expected a recipe file"),
        ([".", "-o", "out"], ".:1:1: is a folder, expected a recipe file"),
        (["bad.yaml", "-o", "out"], "bad.yaml:3:1: not valid YAML"),
        (["new\nline.yaml", "-o", "out"], "new\\nline.yaml: the path holds control characters, which USD refuses"),
        (["snake.yaml", "-o", "o\x1but"], "o\\x1but: the path holds control characters, which USD refuses"),
        (["snake.yaml", "-o", "\udc80"], "\\udc80: the path is not UTF-8, which USD needs"),
        (["snake.yaml", "-o", "/dev/null/out"], "/dev/null: a file is in the way of the folder"),
        (["snake.yaml", "-o", "out", "--random", "0"], "0 variations cannot be drawn, expected 1 to 100000"),
        (["snake.yaml", "-o", "out", "--set", "=1"], '"": no path, expected keys such as'),
        (["snake.yaml", "-o", "out", "--set", "ti\x1btle=x"], 'ti\\x1btle: unknown key "ti\\x1btle", did you mean "title"?'),
        (["snake.yaml", "-o", "out", "--set", "fps=9]\n"], "fps: "),
    ],
)  # fmt: skip
def test_bad_input_is_told_in_one_line(words, said, cli, write_recipe, left):
    write_recipe()
    write_recipe("bad", text="format: 1\nname: [x\n")
    before = left("")
    (line,) = refused(cli("vary", *words, "--set", "units=cm,mm"))
    assert line.startswith(said)
    assert left("") == before


def test_the_billion_combinations_are_counted_and_not_made(cli, write_recipe):
    write_recipe()
    words = [
        word
        for key in ("fps", "balloons.main.tail", "steps[0].bubbles.nose")
        for word in ("--set", f"{key}=1..1000/1")
    ]
    (line,) = refused(cli("vary", "snake.yaml", *words, "-o", "out"))
    assert line == "1000000000 variations are too many, expected at most 100000: fewer values, or --random N"


def test_files_that_are_there_are_replaced_by_force_only(cli, write_recipe, tmp_path):
    write_recipe()
    words = ["vary", "snake.yaml", "--set", "balloons.main.tail=20", "-o", "."]
    assert cli(*words).exit_code == 0
    assert cli(*words).exit_code == 0
    file = tmp_path / "snake_20.yaml"
    file.write_text("mine")
    assert refused(cli(*words)) == [
        "snake_20.yaml: is there already and differs, expected another folder, or --force to replace it"
    ]
    assert file.read_text() == "mine"
    assert cli(*words, "--force").exit_code == 0
    assert file.read_text() != "mine"


def test_a_folder_that_may_not_be_written_is_bad_input(cli, write_recipe):
    write_recipe()
    (line,) = refused(cli("vary", "snake.yaml", "--set", "fps=8", "-o", "/proc/out"))
    assert line.startswith("/proc/out: cannot write here (")


def test_a_full_disk_has_its_own_exit_code(cli, write_recipe, left, monkeypatch):
    def full(self, *_):
        raise OSError(28, os.strerror(28))

    write_recipe()
    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    (line,) = refused(cli("vary", "snake.yaml", "--set", "fps=8", "-o", "out"), code=1)
    assert line == "snake_8.yaml cannot be written: No space left on device"
    assert left("") == ["snake.yaml"]


def test_ctrl_c_ends_with_130_and_leaves_nothing(write_recipe, tmp_path):
    write_recipe()
    code = (
        "import time, balloon_usd.variation.vary as vary;"
        "vary.plan = lambda recipe: (print('asleep', flush=True), time.sleep(60));"
        "from balloon_usd.cli import main; main()"
    )
    words = [sys.executable, "-c", code, "vary", "snake.yaml", "--set", "fps=8,9", "-o", "out"]
    process = interruptible.start(words, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert process.stdout.readline().strip() == "asleep"
    process.send_signal(subprocess.signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "Traceback" not in err
    assert [path.name for path in tmp_path.iterdir()] == ["snake.yaml"]


def test_every_option_is_explained(cli):
    text = cli("vary", "--help").stdout
    for word in (
        "--set PATH=VALUES",
        "--random N",
        "--seed S",
        "-o, --output DIR",
        "--force",
        "2    bad input",
    ):
        assert word in text
