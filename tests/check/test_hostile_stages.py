"""Stages that nobody should write: they get faults or one clear line, soon, and never a crash."""

from __future__ import annotations

import os
import shutil
import warnings
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.check import check_file, document_of, text_of

HEAD = """#usda 1.0
(
    defaultPrim = "a"
    metersPerUnit = {metre}
    startTimeCode = 1
    endTimeCode = 3
    timeCodesPerSecond = {rate}
)
"""
FACES = """
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
"""
POINTS = "[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]"


def write(file: Path, points: str = f"point3f[] points = {POINTS}", inside: str = "", **head: str) -> str:
    """Write a stage with a tetrahedron, and return its name."""
    whole = HEAD.format(**{"metre": "1", "rate": "24", **head})
    mesh = f'    def Mesh "m"\n    {{{FACES}        {points}\n    }}\n'
    file.write_text(f'{whole}def Xform "a"\n{{\n{mesh}{inside}}}\n')
    return str(file)


def refused(name: str) -> str:
    """The line with which a stage is refused, without its folder."""
    why = check_file(name, nvidia=False).unreadable
    assert why
    assert why.isprintable()
    return why.removeprefix(f"{Path(name).parent}/")


@pytest.mark.parametrize(
    "points",
    [
        f"point3f[] points.timeSamples = {{1: None, 2: {POINTS}, 3: None}}",
        f"point3f[] points.timeSamples = {{1: {POINTS}, 2: [(0, 0, 0)], 3: []}}",
        f"point3f[] points.timeSamples = {{1.25: {POINTS}, 1.2500001: {POINTS}, nan: {POINTS}}}",
        f"point3f[] points.timeSamples = {{-inf: {POINTS}, 2: {POINTS}, inf: {POINTS}}}",
        f"point3f[] points.timeSamples = {{1: {POINTS}, 1000000000: {POINTS}}}",
        "point3f[] points = [(nan, 0, 0), (inf, 0, 0), (3e38, 0, 0), (-3e38, 0, 1)]",
    ],
    ids=["blocked samples", "other counts", "odd times", "endless times", "far apart", "beyond numbers"],
)
@pytest.mark.parametrize(
    "head", [{}, {"metre": "1e308"}, {"metre": "-inf"}, {"rate": "1e308"}, {"rate": "inf"}]
)
def test_numbers_beyond_sense_are_faults(points: str, head: dict[str, str], tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = check_file(write(tmp_path / "a.usda", points, **head), nvidia=False)
    assert report.unreadable == ""
    assert report.found
    assert text_of(report)
    assert document_of([report])


@pytest.mark.parametrize("points", ["rel points = </a>", "string points = 'x'"])
def test_points_that_are_none_are_told_in_one_line_or_as_faults(points: str, tmp_path: Path) -> None:
    report = check_file(write(tmp_path / "a.usda", points), nvidia=False)
    assert report.unreadable.isprintable()
    assert report.unreadable or any(fault.rule == "20" for fault in report.found)


@pytest.mark.parametrize("where", ["reference", "texture"])
def test_a_stage_that_needs_a_pipe_is_refused_instead_of_waited_for(where: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.usda")
    inside = {
        "reference": '    def "b" (\n        references = @./pipe.usda@\n    )\n    {\n    }\n',
        "texture": "    asset picture = @./pipe.usda@\n",
    }
    name = write(tmp_path / "a.usda", inside=inside[where])
    assert refused(name) == "a.usda: ./pipe.usda, which a.usda needs: is a pipe or a device, expected a file"


def test_a_package_without_its_end_is_truncated(stages: Path, tmp_path: Path) -> None:
    whole = (stages / "dog.usdz").read_bytes()
    (tmp_path / "dog.usdz").write_bytes(whole[:-1])
    assert refused(str(tmp_path / "dog.usdz")) == "dog.usdz: no USD file, or a truncated one"


@pytest.mark.parametrize("name", ["new\nline.usda", "ta\tb.usda", "nu\0ll.usda", "esc\x1b[31m.usda"])
def test_a_name_with_control_characters_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    assert refused(str(tmp_path / name)).endswith(": the path holds control characters, which USD refuses")


@pytest.mark.parametrize(
    "name", ["sp ace", "ha#sh", 'quo"te', "[br]", "per%20cent", "日本", "col:on", "at@sign"]
)
def test_any_other_name_will_do(name: str, stages: Path, tmp_path: Path) -> None:
    shutil.copytree(stages / "dog", tmp_path / name)
    (tmp_path / name / "dog.usda").rename(tmp_path / name / f"{name}.usda")
    assert check_file(str(tmp_path / name), nvidia=False).unreadable == ""


def test_variants_that_multiply_are_looked_at_up_to_a_number_and_that_is_said(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(write(tmp_path / "a.usda"))
    for number in range(20):
        variants = stage.GetDefaultPrim().GetVariantSets().AddVariantSet(f"set_{number}")
        for name in ("one", "other"):
            variants.AddVariant(name)
    stage.GetRootLayer().Save()
    report = check_file(str(tmp_path / "a.usda"), nvidia=False)
    assert len(report.selections) == 100
    assert "the first 100 selections of variants, others were not looked at" in text_of(report)
    assert document_of([report])["stages"][0]["variants_left_out"] is True


def test_a_stage_of_instances_alone_shows_something(tmp_path: Path) -> None:
    write(tmp_path / "thing.usda")
    stage = Usd.Stage.CreateNew(str(tmp_path / "crowd.usda"))
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/crowd").GetPrim())
    for number in range(300):
        prim = UsdGeom.Xform.Define(stage, f"/crowd/thing_{number}").GetPrim()
        prim.GetReferences().AddReference("./thing.usda")
        prim.SetInstanceable(True)
    stage.GetRootLayer().Save()
    assert check_file(str(tmp_path / "crowd.usda"), nvidia=False).unreadable == ""
