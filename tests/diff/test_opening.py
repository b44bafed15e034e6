"""Stages that cannot be compared are refused in one line; files are left as they are."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.diff import DiffError, Tolerances, compare_files
from balloon_usd.diff.tolerance import Allowed
from tests.diff.damage import DAMAGES

Damage = Callable[[Path], Path]


@pytest.mark.parametrize(("damage", "said"), DAMAGES.values(), ids=DAMAGES.keys())
@pytest.mark.parametrize("turned", [False, True], ids=["first", "second"])
def test_a_stage_that_cannot_be_compared_is_refused_in_one_line(
    damage: Damage, said: str, turned: bool, written: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(written / "dog", tmp_path / "dog")
    bad = damage(tmp_path / "dog")
    pair = (written / "dog", bad) if turned else (bad, written / "dog")
    with pytest.raises(DiffError) as refused:
        compare_files(*pair)
    (line,) = str(refused.value).splitlines()
    assert re.search(said, line), line
    assert capfd.readouterr().err == ""


def test_the_files_are_left_as_they_are(written: Path, tmp_path: Path) -> None:
    shutil.copytree(written, tmp_path, dirs_exist_ok=True)
    files = [file for file in sorted(tmp_path.rglob("*")) if file.is_file()]
    before = [(file.read_bytes(), file.stat().st_mtime_ns) for file in files]
    compare_files(tmp_path / "dog", tmp_path / "dog.usdc", variants=True)
    assert [(file.read_bytes(), file.stat().st_mtime_ns) for file in files] == before
    assert [file for file in sorted(tmp_path.rglob("*")) if file.is_file()] == files


def test_the_folder_one_stands_in_is_a_stage(
    written: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(written / "dog", tmp_path / "dog")
    monkeypatch.chdir(tmp_path / "dog")
    assert compare_files(Path(), written / "dog").same
    assert compare_files(Path("../dog"), written / "dog").same


def test_stages_without_any_mesh_are_compared(tmp_path: Path) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    for file, radius in zip(files, (1.0, 2.0), strict=True):
        stage = Usd.Stage.CreateNew(str(file))
        UsdGeom.Sphere.Define(stage, "/ball").CreateRadiusAttr(radius)
        stage.GetRootLayer().Save()
    assert [str(found) for found in compare_files(*files).differences] == ["/ball.radius: 1 and 2"]


def test_a_tolerance_for_an_attribute_that_is_nowhere_is_refused_with_the_nearest(written: Path) -> None:
    wrong = Tolerances(named={"pionts": Allowed(1e-4)})
    with pytest.raises(DiffError, match=r'^tolerance: unknown attribute "pionts", did you mean "points"\?$'):
        compare_files(written / "dog", written / "dog", tolerances=wrong)


def test_settings_of_the_process_are_left_as_they_are(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("USDC_USE_PREAD", raising=False)
    compare_files(written / "dog", written / "dog")
    assert "USDC_USE_PREAD" not in os.environ
    monkeypatch.setenv("USDC_USE_PREAD", "0")
    compare_files(written / "dog", written / "dog")
    assert os.environ["USDC_USE_PREAD"] == "0"
