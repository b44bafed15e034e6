from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Usd, UsdGeom, Vt

from balloon_usd.preview import PreviewError, draw_contact_sheet, spread_moments

SMALL = (96, 64)


@pytest.fixture(scope="module")
def stage_path(dog, tmp_path_factory):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, "Z")
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(20)
    points, quads, _ = dog
    mesh = UsdGeom.Mesh.Define(stage, "/dog")
    mesh.CreateFaceVertexCountsAttr([4] * len(quads))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(quads.ravel()))
    mesh.CreateDisplayColorAttr([Gf.Vec3f(0.6, 0.01, 0.02)])
    for time in (1, 20):
        tall = points * np.float32([1, 1, 1 + time / 20])
        mesh.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(tall), time)
    path = tmp_path_factory.mktemp("stage") / "dog.usdc"
    stage.Export(str(path))
    return path


def test_eight_moments_are_spread_up_to_the_last_frame():
    assert spread_moments(1, 161) == (21, 41, 61, 81, 101, 121, 141, 161)
    assert spread_moments(1, 4) == (1, 2, 3, 4)
    assert spread_moments(7, 7) == (7,)


def test_a_sheet_has_a_row_for_every_few_pictures(stage_path, tmp_path):
    path = draw_contact_sheet(
        stage_path, tmp_path / "sheet.png", frames=(1, 10, 20), columns=2, size=SMALL, device="cpu"
    )
    with Image.open(path) as sheet:
        assert sheet.format == "PNG"
        width, height = sheet.size
    assert 2 * 96 < width < 3 * 96
    assert 2 * 64 < height < 5 * 64


def test_the_same_stage_gives_the_same_bytes(stage_path, tmp_path):
    sheets = [
        draw_contact_sheet(stage_path, tmp_path / f"{n}.png", frames=(20,), size=SMALL, device="cpu")
        for n in (1, 2)
    ]
    assert sheets[0].read_bytes() == sheets[1].read_bytes()


def test_moments_differ(stage_path, tmp_path):
    sheet = draw_contact_sheet(
        stage_path, tmp_path / "sheet.png", frames=(1, 20), columns=2, size=SMALL, device="cpu"
    )
    with Image.open(sheet) as image:
        pixels = np.asarray(image).astype(int)
    left, right = pixels[70:134, 24:120], pixels[70:134, 134:230]
    assert np.abs(left - right).max() > 50


def test_a_sheet_that_cannot_be_written_leaves_nothing(stage_path, tmp_path):
    (tmp_path / "taken.png").mkdir()
    with pytest.raises(PreviewError, match="cannot be written"):
        draw_contact_sheet(stage_path, tmp_path / "taken.png", frames=(1,), size=SMALL, device="cpu")
    with pytest.raises(PreviewError, match="cannot be written"):
        draw_contact_sheet(stage_path, tmp_path / "no" / "x.png", frames=(1,), size=SMALL, device="cpu")
    assert [path.name for path in tmp_path.iterdir()] == ["taken.png"]
