"""Stages that nobody should write can still be compared, or are refused."""

from __future__ import annotations

import json
import os
import warnings
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.diff import DiffError, compare_files, two_files
from balloon_usd.diff.report import diff_json, diff_text
from tests.check.test_hostile_stages import POINTS, write

USUAL = f"point3f[] points = {POINTS}"


@pytest.mark.parametrize(
    "points",
    [
        f"point3f[] points.timeSamples = {{1: {POINTS}, 2: [(0, 0, 0), (1, 1, 1)], 3: []}}",
        f"point3f[] points.timeSamples = {{1: None, 2: {POINTS}, 3: None}}",
        f"point3f[] points.timeSamples = {{-inf: {POINTS}, nan: {POINTS}, inf: {POINTS}}}",
        "point3f[] points = [(inf, 0, 0), (nan, 0, 0), (3e38, 0, 0), (-3e38, 0, 1)]",
        "point3f[] points = []",
        "string points = 'x'",
        f"double3[] points = {POINTS}",
    ],
    ids=["other counts", "blocked samples", "endless times", "beyond numbers", "none", "text", "doubles"],
)
def test_points_beyond_sense_are_a_difference(points: str, tmp_path: Path) -> None:
    pair = Path(write(tmp_path / "one.usda", USUAL)), Path(write(tmp_path / "other.usda", points))
    for first, second in (pair, pair[::-1]):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = compare_files(first, second)
        assert not found.same
        assert diff_text(found)
        json.dumps(diff_json(found), allow_nan=False)


@pytest.mark.parametrize("metre", ["inf", "nan", "1e308", "0", "-1"])
def test_units_beyond_sense_are_a_difference(metre: str, tmp_path: Path) -> None:
    first, second = (write(tmp_path / f"{unit}.usda", metre=unit) for unit in ("1", metre))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = compare_files(Path(first), Path(second))
    assert str(found.differences[0]).startswith("metersPerUnit: 1 and ")


def test_a_type_that_is_not_the_schemas_is_a_difference(tmp_path: Path) -> None:
    pair = [
        write(tmp_path / f"{kind}.usda", f"{kind}[] points = {POINTS}") for kind in ("point3f", "double3")
    ]
    (found,) = compare_files(*map(Path, pair)).differences
    assert str(found) == "/a/m.points: of type point3f[] and double3[]"


def test_a_layer_that_is_a_pipe_is_refused_instead_of_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.usda")
    inside = '    def "b" (\n        payload = @./pipe.usda@\n    )\n    {\n    }\n'
    file = Path(write(tmp_path / "a.usda", inside=inside))
    with pytest.raises(
        DiffError, match=r"/a\.usda is not whole: \./pipe\.usda, which a\.usda needs, is a pipe"
    ):
        compare_files(file, file)


def many_variants(file: Path, size: float) -> Path:
    """Write a stage with 64 selections of variants, the last of which has another size."""
    stage = Usd.Stage.CreateNew(str(file))
    root = UsdGeom.Sphere.Define(stage, "/a").GetPrim()
    stage.SetDefaultPrim(root)
    for number in range(6):
        variants = root.GetVariantSets().AddVariantSet(f"set_{number}")
        for name in ("one", "other"):
            variants.AddVariant(name)
        variants.SetVariantSelection("other")
    with variants.GetVariantEditContext():
        UsdGeom.Sphere(root).CreateRadiusAttr(size)
    variants.SetVariantSelection("one")
    stage.GetRootLayer().Save()
    return file


def test_variants_that_multiply_are_never_the_same_when_some_were_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    same, other = many_variants(tmp_path / "a.usda", 1.0), many_variants(tmp_path / "b.usda", 2.0)
    assert compare_files(same, same, variants=True).same
    monkeypatch.setattr(two_files, "MOST", 10)
    with pytest.raises(DiffError, match=r"^no difference in the first 10 selections of variants, the others"):
        compare_files(same, same, variants=True)
    found = compare_files(same, other, variants=True)
    assert "of the first 10 selections of variants, the others were not compared" in diff_text(found)
