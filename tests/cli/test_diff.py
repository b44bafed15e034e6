"""`balloon-usd diff`, as a user types it."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdGeom, Vt

from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

MAIN = "/dog/geo/render/main"


@pytest.fixture(scope="module")
def stages(tmp_path_factory):
    """A folder with the dog in one/dog, and with one moved vertex in other/dog. Only to be read."""
    folder = tmp_path_factory.mktemp("stages")
    moved = list(frames(6))
    moved[3].points[0][25, 2] += np.float32(0.003)
    write_stage(sculpture(), frames(6), folder / "one")
    write_stage(sculpture(), iter(moved), folder / "other")
    return folder


@pytest.fixture
def diff(cli, stages, tmp_path):
    """Type the command in a folder that holds both."""
    shutil.copytree(stages, tmp_path, dirs_exist_ok=True)
    return lambda *words: cli("diff", *words)


def refused(result):
    """The one line with which the command said that it cannot compare."""
    assert result.exit_code == 2, result.output
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    return result.stderr.strip().splitlines()[-1]


@pytest.mark.parametrize("options", [(), ("--variants",)])
def test_a_stage_is_the_same_as_itself(diff, options):
    result = diff("one/dog", "one/dog", *options)
    assert (result.exit_code, result.output) == (0, "no difference\n")


def test_a_moved_vertex_is_told_with_bubble_time_code_and_distance(diff):
    result = diff("one/dog", "other/dog/dog.usda")
    assert result.exit_code == 1
    prim, moved, points = result.stdout.splitlines()
    assert prim == MAIN
    assert moved.startswith("  left_ear moved 3 mm at 4 (largest, vertex 25), rms ")
    assert points == "  points: differ by up to 0.003 at 4; at 1 of 6 time codes"
    assert result.stderr == ""


@pytest.mark.parametrize("allowed", [("--tol", "points=4e-3"), ("--abs", "0.004"), ("--rel", "0.9")])
def test_a_tolerance_makes_them_the_same(diff, allowed):
    assert diff("one/dog", "other/dog", *allowed).exit_code == 0


def test_a_tolerance_of_an_attribute_goes_before_that_of_all(diff):
    assert diff("one/dog", "other/dog", "--abs", "1", "--tol", "points=1e-3").exit_code == 1
    assert diff("one/dog", "other/dog", "--abs", "1", "--rms", "1e-5").exit_code == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--tol", "pionts=1e-4"), 'tolerance: unknown attribute "pionts", did you mean "points"?'),
        (("--tol", "points"), '"points" is no tolerance, expected NAME=AMOUNT'),
        (("--tol", "points=-1"), 'points: "-1" is no tolerance, expected a number in the unit'),
        (("--tol", "points=nan"), 'points: "nan" is no tolerance, expected a number in the unit'),
        (("--abs", "-1"), '"-1" is no tolerance, expected a number such as 1e-4'),
        (("--rel", "nan"), '"nan" is no tolerance'),
        (("--rms", "inf"), '"inf" is no tolerance'),
        (("--rms", "small"), '"small" is no tolerance'),
        (("--png", "none/d.png"), "none/d.png cannot be written: none is not a folder"),
        (
            ("--png", "one/dog/dog.usda"),
            "one/dog/dog.usda would replace a stage, expected a name that ends in",
        ),
        (("--png", "d.png", "--html", "d.png"), "d.png cannot be both picture and page"),
        (("--html", "one"), "one cannot be written: a folder is in the way"),
    ],
)
def test_a_wrong_option_is_refused_in_one_line(diff, options, said):
    assert said in refused(diff("one/dog", "other/dog", *options))


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("", "payload/payload.usda is not a file"),
        ("nothing.usda", "nothing.usda is not a file"),
        ("one", "one/one.usda is not a file"),
        ("noise.usda", "noise.usda is not a USD file"),
        ("\udcff.usda", "the path is not UTF-8, which USD needs"),
    ],
)
def test_what_cannot_be_compared_is_told_in_one_line(diff, tmp_path, monkeypatch, name, said):
    (tmp_path / "noise.usda").write_bytes(bytes(range(256)))
    if not name:
        monkeypatch.chdir(tmp_path / "one" / "dog" / "payload")
    here = diff(name, tmp_path / "one" / "dog")
    assert said in refused(here)
    assert len(here.stderr.splitlines()) == 1


def test_a_missing_payload_is_told_in_one_line(diff, tmp_path):
    (tmp_path / "other/dog/payload/draft.usda").unlink()
    result = diff("one/dog", "other/dog")
    assert "other/dog/dog.usda is not whole: Could not open asset" in refused(result)
    assert len(result.stderr.splitlines()) == 1


def test_json_has_every_difference_and_the_measures_of_every_time_code(diff):
    result = diff("one/dog", "other/dog", "--json")
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert (told["format"], told["same"]) == (1, False)
    assert (told["first"], told["second"]) == ("one/dog/dog.usda", "other/dog/dog.usda")
    moved, points = told["differences"]
    assert (points["prim"], points["name"]) == (MAIN, "points")
    assert points["by"] == pytest.approx(0.003, rel=1e-3)
    assert points["spread"] == {"worst": 4.0, "first": 4.0, "last": 4.0, "count": 1, "compared": 6}
    assert moved["movement"]["bubble"] == "left_ear"
    (moment,) = moved["movement"]["moments"]
    assert (moment["time_code"], moment["vertex"]) == (4.0, 25)
    assert moment["distance"] == pytest.approx(0.003, rel=1e-3)
    assert moment["volumes"][0] == pytest.approx(moment["volumes"][1], rel=0.05)
    same = json.loads(diff("one/dog", "one/dog", "--json").stdout)
    assert (same["same"], same["differences"]) == (True, [])


def test_not_a_number_is_told_and_is_null_in_json(diff, tmp_path):
    stage = Usd.Stage.Open(str(tmp_path / "other/dog/dog.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    attribute = UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr()
    points = np.array(attribute.Get(4))
    points[26] = np.nan
    attribute.Set(Vt.Vec3fArray.FromNumpy(points), 4)
    stage.Export(str(tmp_path / "nan.usda"))
    assert "0 and 3 values are NaN" in diff("other/dog", "nan.usda").stdout
    told = json.loads(diff("other/dog", "nan.usda", "--json").stdout, parse_constant=pytest.fail)
    *_, points = (found for found in told["differences"] if found["name"] == "points")
    assert points["by"] is None


def test_a_picture_and_a_page_are_written(diff, tmp_path):
    result = diff("one/dog", "other/dog", "--png", "d.png", "--html", "d.html", "--device", "cpu")
    assert result.exit_code == 1
    with Image.open(tmp_path / "d.png") as picture:
        assert picture.format == "PNG"
    assert "left_ear" in (tmp_path / "d.html").read_text(encoding="utf-8")
    assert diff("one/dog", "one/dog", "--html", "same.html", "--device", "cpu").exit_code == 0
    assert "The stages are the same" in (tmp_path / "same.html").read_text(encoding="utf-8")


def test_many_differences_are_cut_short(diff, tmp_path):
    for name, value in (("a", 1), ("b", 2)):
        stage = Usd.Stage.CreateNew(str(tmp_path / f"{name}.usda"))
        for number in range(250):
            UsdGeom.Sphere.Define(stage, f"/ball_{number}").CreateRadiusAttr(value)
        stage.GetRootLayer().Save()
    lines = diff("a.usda", "b.usda").stdout.splitlines()
    assert len(lines) == 201
    assert lines[-1] == "50 more, which --json has"
