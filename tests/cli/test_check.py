"""The command `balloon-usd check`, as a user types it."""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
from dataclasses import replace

import numpy as np
import pytest
from pxr import Sdf, Usd

from balloon_usd.stage import write_stage
from tests import interruptible
from tests.stage.tubes import frames, sculpture


@pytest.fixture(scope="module")
def stages(tmp_path_factory):
    """The dog in layers, in one file and as a package. Only to be read."""
    folder = tmp_path_factory.mktemp("stages")
    write_stage(sculpture(), frames(6), folder)
    write_stage(sculpture(), frames(6), folder, flat=True)
    write_stage(sculpture(), frames(6), folder, usdz=True)
    return folder


@pytest.fixture
def check(cli, stages, tmp_path):
    """Type the command in a folder that holds copies of the stages; NVIDIA's validator is not asked."""
    shutil.copytree(stages, tmp_path, dirs_exist_ok=True)
    return lambda *words: cli("check", "--no-nvidia", *words)


def break_extent(file):
    """Make one extent loose."""
    layer = Sdf.Layer.FindOrOpen(str(file))
    path = "/dog/geo/render/main.extent"
    layer.SetTimeSample(path, 3.0, type(layer.QueryTimeSample(path, 3.0))([(-1, -1, -1), (1, 1, 1)]))
    layer.Save()


def refused(result):
    """The one line with which a stage that cannot be read ends the command, without a traceback."""
    assert result.exit_code == 2, result.output
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    (line,) = result.stderr.strip().splitlines()
    return line


@pytest.mark.parametrize("name", ["dog", "dog/", "./dog/dog.usda", "dog.usdc", "dog.usdz"])
def test_a_good_stage_is_fine(name, check):
    result = check(name)
    assert result.exit_code == 0, result.output
    kind = "package" if name.endswith("usdz") else "asset"
    assert result.stdout.splitlines()[0].startswith(f"{name}: fine ({kind}, ")
    assert result.stderr == ""


def test_the_folder_one_stands_in_can_be_checked(check, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path / "dog")
    assert check(".").exit_code == 0


def test_a_fault_is_told_with_place_time_and_remedy(check, tmp_path):
    break_extent(tmp_path / "dog.usdc")
    result = check("dog.usdc")
    assert result.exit_code == 1
    lines = result.stdout.splitlines()
    assert lines[0].startswith("dog.usdc: 2 faults (asset, ")
    place = lines.index("  property 14: Extent per sample, enclosing and tight.")
    assert lines[place + 1].startswith("    /dog/geo/render/main at time code 3: extent is loose, by ")
    assert lines[place + 2].startswith("    remedy: author extent as ")


def test_json_has_all_faults_of_all_stages(check, tmp_path):
    break_extent(tmp_path / "dog.usdc")
    result = check("--json", "dog.usdc", "dog", "gone.usda")
    assert result.exit_code == 2
    assert result.stderr == ""
    document = json.loads(result.stdout)
    assert document["format"] == 1
    assert [stage["result"] for stage in document["stages"]] == ["faults", "fine", "unreadable"]
    rules = [fault["rule"] for fault in document["stages"][0]["faults"]]
    assert rules == ["10", "14"]
    assert document["stages"][0]["faults"][1]["time_code"] == 3.0


def test_all_stages_are_checked_and_the_worst_result_counts(check, tmp_path):
    break_extent(tmp_path / "dog.usdc")
    assert check("dog.usdc", "dog").exit_code == 1
    result = check("gone.usda", "dog.usdc", "dog")
    assert result.exit_code == 2
    assert [line.split(":")[0] for line in result.stdout.splitlines() if not line.startswith(" ")] == [
        "dog.usdc",
        "dog",
    ]
    assert result.stderr == '"gone.usda": no such file or folder\n'


BAD = {
    "truncated": ("dog.usdc", lambda whole: whole[: len(whole) // 2], "no USD file, or a truncated one"),
    "truncated package": (
        "dog.usdz",
        lambda whole: whole[: len(whole) // 2],
        "no USD file, or a damaged one",
    ),
    "garbage": ("dog.usdc", lambda _: np.random.default_rng(7).bytes(4000), "no USD file, or a damaged one"),
    "garbage for text": ("dog/dog.usda", lambda _: b"\xff\x00 dog", "no USD file, or a damaged one"),
    "empty": ("dog.usdc", lambda _: b"", "the file is empty"),
    "other text": ("dog/dog.usda", lambda _: b"format: 1\nname: dog\n", "no USD file, or a damaged one"),
    "wrong text": (
        "dog/dog.usda",
        lambda whole: whole.replace(b'kind = "component"', b"kind = component"),
        "wrong text at line 42, column 12",
    ),
    "no prims": ("dog/dog.usda", lambda _: b"#usda 1.0\n", "shows no mesh"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_file_that_is_no_stage_is_refused_in_one_line(kind, check, tmp_path):
    name, change, why = BAD[kind]
    file = tmp_path / name
    data = change(file.read_bytes())
    file.unlink()
    file.write_bytes(data)
    assert refused(check(name)) == f"{name}: {why}"
    assert file.read_bytes() == data


def test_a_file_that_is_named_otherwise_is_refused(check, tmp_path):
    (tmp_path / "dog.yaml").write_text("format: 1\n")
    assert refused(check("dog.yaml")) == "dog.yaml: no USD file, expected one of .usd, .usda, .usdc, .usdz"


def test_a_stage_without_frames_is_refused(check, tmp_path):
    stage = Usd.Stage.Open(str(tmp_path / "dog.usdc"))
    stage.SetEndTimeCode(0)
    stage.GetRootLayer().Save()
    assert refused(check("dog.usdc")) == "dog.usdc: has no frames, its time codes are 1 to 0"


@pytest.mark.parametrize("name", ["", "gone", "gone.usda", "a" * 300, "gone\x00.usda"])
def test_what_is_not_there_is_refused(name, check):
    assert refused(check(name))


def test_a_folder_without_stage_is_refused(check, tmp_path):
    (tmp_path / "empty").mkdir()
    assert refused(check("empty")) == "empty: no stage in this folder, expected empty.usda in it"


@pytest.mark.parametrize("missing", ["draft.usda", "draft_sim.usdc", "draft_geo.usdc", "draft_finished.usda"])
def test_a_missing_layer_of_any_variant_is_told_with_the_layer_that_needs_it(missing, check, tmp_path):
    (tmp_path / "dog" / "payload" / missing).unlink()
    line = refused(check("dog"))
    assert line.startswith("dog/dog.usda: ./")
    assert f"{missing}, which " in line
    assert line.endswith(" needs: the file is missing")


def test_a_truncated_layer_is_told_by_its_name(check, tmp_path):
    file = tmp_path / "dog" / "payload" / "draft_sim.usdc"
    data = file.read_bytes()
    file.unlink()
    file.write_bytes(data[:2000])
    line = refused(check("dog"))
    assert line == "dog/dog.usda: ./draft_sim.usdc, which draft.usda needs: no USD file, or a truncated one"


def test_a_path_that_is_no_text_is_refused(check):
    line = refused(check(os.fsdecode(b"d\xffg.usda")))
    assert line == "d\\udcffg.usda: the path is not UTF-8, which USD needs"


def test_no_stage_at_all_is_a_mistake(check):
    result = check()
    assert result.exit_code == 2
    assert "Missing argument 'STAGE...'" in result.stderr


def test_a_process_ends_with_the_exit_code_and_without_warnings_of_usd(stages, tmp_path):
    shutil.copytree(stages / "dog", tmp_path / "dog")
    (tmp_path / "dog" / "payload" / "draft.usda").unlink()
    words = [sys.executable, "-m", "balloon_usd", "check", str(tmp_path / "dog"), str(stages / "dog.usdc")]
    process = interruptible.start(words)
    out, error = process.communicate(timeout=60)
    assert process.returncode == 2
    assert len(error.splitlines()) == 1
    assert out.splitlines()[0].startswith(f"{stages / 'dog.usdc'}: fine")


def test_crossings_are_counted_in_the_frames_that_are_asked_for_and_are_a_fault(check, tmp_path):
    # The second tube is down in the first one in frame 3.
    moved = [
        replace(
            f, points=(f.points[0], f.points[1] - np.float32([0, 0.003, 0.085 if f.time_code == 3 else 0]))
        )
        for f in frames(5)
    ]
    write_stage(sculpture(name="crossed"), moved, tmp_path, flat=True)
    result = check("--crossings", "dog", "crossed.usdc")
    assert result.exit_code == 1, result.output
    fine, line = result.stdout.splitlines()
    assert fine == "dog: 0 crossings in 6 frames"
    assert re.match(
        r"crossed.usdc: \d+ crossings in frame 3, the worst of 5 frames, 0 in the last one, ", line
    )
    for asked, counted in (("4:", [4, 5]), ("1,5", [1, 5])):
        result = check("--crossings", "--frames", asked, "--json", "crossed.usdc")
        assert result.exit_code == 0, result.output
        (stage,) = json.loads(result.stdout)["stages"]
        assert (stage["result"], stage["crossings"]["time_code"]) == ("fine", counted)


def test_frames_that_a_stage_has_not_and_frames_without_crossings_are_refused(check):
    assert "dog.usdc: has frames 1 to 6 only" in refused(check("--crossings", "--frames", "7:", "dog.usdc"))
    assert refused(check("--frames", "2:", "dog")) == "--frames: not used without --crossings"
