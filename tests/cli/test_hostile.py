"""What a hostile or a clumsy user types: one clear line, the exit code, and nothing harmed."""

from __future__ import annotations

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from balloon_usd.diff import compare_files
from balloon_usd.diff.drawing import draw_comparison
from balloon_usd.stage import write_stage
from tests import interruptible
from tests.check.test_hostile_stages import write
from tests.stage.tubes import frames, sculpture


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The dog in one file. Only to be read."""
    folder = tmp_path_factory.mktemp("stages")
    write_stage(sculpture(), frames(2), folder, flat=True)
    return folder


@pytest.fixture
def dog(folder):
    return folder / "dog.usdc"


def refused(result, code=2):
    """The one line with which a command ends."""
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    return line


@pytest.mark.parametrize("option", ["--png", "--html"])
def test_a_picture_never_takes_the_place_of_a_device_or_pipe(option, cli, dog, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert (
        refused(cli("diff", dog, dog, option, pipe)) == f"{pipe} cannot be written: it is a device or a pipe"
    )
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_contact_sheet_never_takes_the_place_of_a_device_or_pipe(cli, dog, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert refused(cli("preview", dog, "-o", pipe)) == f"{pipe} cannot be written: it is a device or a pipe"
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_devices_are_refused_even_where_they_lead_to_files(cli, dog):
    # Nothing stands there, so that nothing is harmed should it be written.
    line = refused(cli("diff", dog, dog, "--html", "/dev/balloon_usd.html"))
    assert line == "/dev/balloon_usd.html cannot be written: it is a device or a pipe"


def test_a_name_that_leaves_no_room_for_a_temporary_one_is_told(cli, dog, tmp_path):
    line = refused(cli("diff", dog, dog, "--html", "x" * 250))
    assert line == f"{'x' * 250} cannot be written: File name too long"
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_picture_leaves_nothing(dog, tmp_path, monkeypatch):
    comparison = compare_files(dog, dog)

    def interrupt(self, target):
        raise KeyboardInterrupt

    monkeypatch.setattr("pathlib.Path.replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        draw_comparison(comparison, html=tmp_path / "page.html", device="cpu")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "words",
    [
        ("check", "--no-nvidia", "{}"),
        ("diff", "{}", "{}"),
        ("preview", "{}"),
        ("golden", "verify", "--stages", "{}"),
        ("blender-extension", "-o", "{}"),
    ],
    ids=lambda words: words[0],
)
def test_control_characters_in_a_name_are_shown_escaped(words, cli):
    line = refused(cli(*(word.format("new\nline.usda") for word in words)))
    assert line == "new\\nline.usda: the path holds control characters, which USD refuses"


@pytest.mark.parametrize("value", ["1_0", "\uff11", "nan", "-inf", "1e400", ""])
def test_only_plain_numbers_are_tolerances(value, cli, dog):
    result = cli("diff", dog, dog, "--abs", value)
    assert result.exit_code == 2
    assert f'"{value}" is no tolerance' in result.stderr


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("format: true\nstages: {}\n", "golden.yaml:1:9: format: expected format: 1"),
        ("format: 1\nstages: {a: {recipe: ''}}\n", "stages.a.recipe: expected the path of a recipe"),
        ('format: 1\nstages: {a: {recipe: "a\\0b"}}\n', "stages.a.recipe: expected the path of a recipe"),
        ('format: 1\nstages: {a: {recipe: "a\\nb"}}\n', "stages.a.recipe: expected the path of a recipe"),
        (f"format: 1\nstages: {{a: {{recipe: x, frames: {10**30}}}}}\n", "is no number of frames"),
        ("format: 1\nstages: {a: &r {recipe: x}}\n", "YAML anchors are not allowed"),
        ("format: 1\nstages:\n  a: {recipe: x}\n  a: {recipe: x}\n", 'key "a" stands here twice'),
    ],
)
def test_a_hostile_list_of_golden_stages_is_refused(text, said, cli, tmp_path):
    (tmp_path / "stages").mkdir()
    (tmp_path / "stages" / "golden.yaml").write_text(text)
    assert said in refused(cli("golden", "verify"))


def test_a_list_of_golden_stages_that_is_a_pipe_is_not_waited_for(cli, tmp_path):
    (tmp_path / "stages").mkdir()
    os.mkfifo(tmp_path / "stages" / "golden.yaml")
    assert refused(cli("golden", "verify")) == "stages/golden.yaml: cannot be read (it is a pipe or a device)"


def test_json_is_one_document_whatever_cannot_be_read(cli, dog):
    result = cli("check", "--json", "--no-nvidia", "", "new\nline.usda", "/dev/zero", dog, "a" * 300)
    assert result.exit_code == 2
    assert result.stderr == ""
    stages = json.loads(result.stdout)["stages"]
    assert [stage["result"] for stage in stages] == [*["unreadable"] * 3, "fine", "unreadable"]


@pytest.mark.parametrize(
    "words", [("check", "--no-nvidia"), ("check", "--no-nvidia", "--json"), ("diff", "DOG"), ("--help",)]
)
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_behind_the_output_is_told_and_is_no_finding(words, unbuffered, dog):
    words = [str(dog) if word == "DOG" else word for word in words]
    with Path("/dev/full").open("w") as full:
        process = subprocess.run(
            [sys.executable, "-m", "balloon_usd", *words, str(dog)],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        )
    assert process.returncode == 2
    assert process.stderr == "nothing more can be said: No space left on device\n"


def test_output_that_nobody_reads_to_its_end_leaves_no_traceback(dog):
    words = [sys.executable, "-m", "balloon_usd", "check", "--no-nvidia", "--json", str(dog)]
    process = interruptible.start(words)
    process.stdout.close()
    process.wait(timeout=60)
    assert process.stderr.read() == ""
    process.stderr.close()


def test_a_run_that_nobody_hears_to_its_end_is_made_and_says_so(write_recipe, tmp_path):
    words = [sys.executable, "-m", "balloon_usd", "run", write_recipe(), "-o", str(tmp_path / "out")]
    process = interruptible.start([*words, "--no-preview", "--no-report", "--frames", "1:3"])
    process.stdout.close()
    process.stderr.read()
    process.stderr.close()
    assert process.wait(timeout=120) == 141
    assert (tmp_path / "out" / "snake" / "snake.usda").exists()


def test_a_folder_that_is_gone_is_told(folder, tmp_path):
    place = tmp_path / "gone"
    place.mkdir()
    code = "import os; os.rmdir(os.getcwd()); from balloon_usd.cli import main; main()"
    process = interruptible.start([sys.executable, "-c", code, "check", "dog.usdc"], cwd=place)
    out, error = process.communicate(timeout=60)
    assert (process.returncode, out) == (2, "")
    assert error == "dog.usdc: No such file or directory\n"


def test_a_stage_that_needs_a_pipe_is_not_drawn_and_not_waited_for(cli, tmp_path):
    os.mkfifo(tmp_path / "pipe.usda")
    inside = '    def "b" (\n        references = @./pipe.usda@\n    )\n    {\n    }\n'
    name = write(tmp_path / "a.usda", inside=inside)
    assert refused(cli("preview", name)).endswith("./pipe.usda, which a.usda needs, is a pipe or a device")


def test_points_that_are_no_numbers_are_not_drawn(cli, tmp_path):
    name = write(tmp_path / "a.usda", "string points = 'x'")
    assert refused(cli("preview", name)) == "/a/m has too few points at time code 1"
