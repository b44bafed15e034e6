"""The command `balloon-usd preview`, as a user types it."""

from __future__ import annotations

import shutil

import pytest
from click.testing import CliRunner
from PIL import Image
from pxr import Usd, UsdGeom

from balloon_usd.cli import main

SMALL = ("--size", 48, 32, "--frames", "1,8", "--device", "cpu")


@pytest.fixture
def preview(tmp_path, monkeypatch, springs):
    """Type the command in a folder that holds the stage of springs and air."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(springs.parent, tmp_path, dirs_exist_ok=True)

    def type_command(*words):
        return CliRunner().invoke(main, ["preview", *map(str, words)], prog_name="balloon-usd")

    return type_command


def refused(result, code=2):
    """The one line with which a command ended as documented, without a traceback."""
    assert result.exit_code == code, result.output
    assert result.exception is None or isinstance(result.exception, SystemExit)
    (line,) = result.stderr.strip().splitlines()
    return line


@pytest.mark.parametrize("look", ["recipe", "stress", "thesis"])
def test_a_look_can_be_chosen(look, preview, tmp_path):
    assert preview("capsule.usda", "-o", "own.png", *SMALL).exit_code == 0
    assert preview("capsule.usda", "-o", "asked.png", "--look", look, *SMALL).exit_code == 0
    same = (tmp_path / "own.png").read_bytes() == (tmp_path / "asked.png").read_bytes()
    assert same is (look == "thesis")


def test_a_look_that_is_not_there_is_refused_with_those_that_are(preview):
    line = refused(preview("capsule.usda", "--look", "wood"))
    assert line == 'capsule.usda has no look "wood", only chrome, clay, clear, print, recipe, stress, thesis'


def test_a_slip_of_the_pen_in_a_look_is_told_the_nearest(preview):
    line = refused(preview("capsule.usda", "--look", "chome"))
    assert line == 'capsule.usda has no look "chome", did you mean "chrome"?'


def test_no_stage_is_refused(preview):
    assert refused(preview("")) == '"" is no stage, expected a USD file or a folder'
    assert refused(preview("/")) == '"/" is no stage, expected a USD file or a folder'


def test_a_folder_without_a_stage_is_refused(preview, tmp_path):
    for name in (".", "..", "empty"):
        (tmp_path / "empty").mkdir(exist_ok=True)
        assert refused(preview(name)).endswith(".usda is not a file")


def test_the_folder_one_stands_in_can_be_drawn(preview, tmp_path, monkeypatch):
    (tmp_path / "capsule").mkdir()
    stage = Usd.Stage.Open("capsule.usda")
    stage.Export(str(tmp_path / "capsule" / "capsule.usda"))
    monkeypatch.chdir(tmp_path / "capsule")
    result = preview(".", *SMALL)
    assert result.exit_code == 0, result.output
    with Image.open(tmp_path / "capsule.png") as sheet:
        assert sheet.format == "PNG"


def test_an_output_that_is_a_folder_is_refused_before_anything_is_drawn(preview, tmp_path, monkeypatch):
    def never(*_, **__):
        raise AssertionError

    monkeypatch.setattr("balloon_usd.preview.contact_sheet.Painter", never)
    (tmp_path / "taken.png").mkdir()
    line = refused(preview("capsule.usda", "-o", "taken.png"))
    assert line == "taken.png cannot be written: a folder is in the way"


FULL_DISK = """
import pathlib

def full(*_):
    raise OSError(28, "No space left on device")

pathlib.Path.replace = full
"""
"""What the interpreter runs at its start where it is found."""


def test_a_full_disk_has_its_own_exit_code(preview, monkeypatch, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(FULL_DISK)
    monkeypatch.syspath_prepend(tmp_path)
    line = refused(preview("capsule.usda", "-o", "x.png", *SMALL), code=1)
    assert line == "x.png cannot be written: No space left on device"


@pytest.mark.parametrize("frames", [(), ("--frames", "1:2")])
def test_a_stage_that_is_not_right_is_refused(frames, preview):
    stage = Usd.Stage.CreateNew("bad.usda")
    mesh = UsdGeom.Mesh.Define(stage, "/mesh")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    stage.SetTimeCodesPerSecond(0)
    stage.Save()
    assert refused(preview("bad.usda", *frames)) == "bad.usda has 0 time codes per second"
